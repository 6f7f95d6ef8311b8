//! Gallery: the telegrams of the manuals, each opened in Read by a click.

use std::sync::LazyLock;

use leptos::prelude::*;

use super::search::Search;
use super::state::{LearnState, Part};
use crate::address::{View, href};
use crate::components::button::Button;
use crate::components::choose::{Choose, choices};
use crate::components::icon::{Glyph, Icon};
use buslens::field::{Direction, count, hex};
use buslens::tool::gallery::{Said, Sample, Slip, samples};

/// The heads of the vectors, gathered by build.rs.
const LIST: &str = include_str!(concat!(env!("OUT_DIR"), "/gallery.txt"));

/// All samples with what they say, read once.
pub static SAMPLES: LazyLock<Vec<(Sample, Said)>> = LazyLock::new(|| {
    let read = |sample: Sample| sample.said().map(|said| (sample, said));
    samples(LIST).into_iter().filter_map(read).collect()
});

/// What the list is narrowed to, as it stands in links: manual, kind, function, text.
#[derive(Clone, Debug, Default, PartialEq)]
struct Narrowed {
    manual: String,
    kind: String,
    function: String,
    typed: String,
}

/// What a telegram is, to choose by.
const KINDS: [(&str, &str); 5] = [
    ("request", "Requests"),
    ("response", "Responses"),
    ("exception", "Exceptions"),
    ("misprint", "Misprinted"),
    ("printed", "Printed in a manual"),
];

/// The manuals by their keys in links, and what they are called here.
const MANUALS: [(&str, &str, &str); 3] = [
    ("memograph-rsg45", "Memograph M RSG45 Modbus supplement", "Memograph M RSG45"),
    ("keb-f5-profibus", "KEB COMBIVERT F5 PROFIBUS-DP operator", "KEB COMBIVERT F5 on PROFIBUS-DP"),
    ("keb-f5-modbus", "KEB COMBIVERT F5 Modbus operator", "KEB COMBIVERT F5 on Modbus"),
];

/// The key of what is of no device.
const STANDARDS: &str = "standards";

/// What sections of the manuals are about, by the key of the manual.
const SECTIONS: &[(&str, &str, &str)] = &[
    ("memograph-rsg45", "2.6.1", "Universal channels are written"),
    ("memograph-rsg45", "2.6.2", "Digital inputs are written"),
    ("memograph-rsg45", "2.6.3", "Universal channels are read"),
    ("memograph-rsg45", "2.6.3 and 3", "A value or a status by itself"),
    ("memograph-rsg45", "2.6.4", "Maths channels are read"),
    ("memograph-rsg45", "2.6.5", "Digital inputs are read"),
    ("memograph-rsg45", "2.6.6", "Totals of digital inputs"),
    ("memograph-rsg45", "2.6.7", "Totals of universal channels"),
    ("memograph-rsg45", "2.6.8", "Totals of maths channels"),
    ("memograph-rsg45", "2.6.9", "Relays are read"),
    ("memograph-rsg45", "2.6.10", "A relay is switched"),
    ("memograph-rsg45", "2.6.11", "Limits are changed, step by step, and read back"),
    ("memograph-rsg45", "2.6.12", "A text for the event list"),
    ("memograph-rsg45", "2.6.13", "Batches are started, named and stopped"),
    ("memograph-rsg45", "2.6.14", "What the status of a value says"),
    ("keb-f5-profibus", "6.1", "Commands to all slaves of a group"),
    ("keb-f5-profibus", "6.3", "Data exchange"),
    ("keb-f5-profibus", "6.3 and 7.4", "Inputs and outputs are looked at"),
    ("keb-f5-profibus", "7.1", "Start-up: parameters"),
    ("keb-f5-profibus", "7.2", "Start-up: configuration"),
    ("keb-f5-profibus", "7.3", "Start-up: diagnosis"),
    ("keb-f5-profibus", "7.4", "Jobs of the parameter channel"),
    ("keb-f5-profibus", "7.4.1 and 7.4.3", "Values of 2 and of 4 bytes"),
    ("keb-f5-profibus", "7.5.1", "A sequence of jobs: one is rejected, one written, one read"),
    ("keb-f5-profibus", "9.1", "Parameters of the operator"),
    ("keb-f5-profibus", "9.1.1", "What process data carry"),
    ("keb-f5-profibus", "12.4", "Errors"),
    ("keb-f5-modbus", "2.3", "Registers through the mapping lists"),
    ("keb-f5-modbus", "2.3 and 3", "Registers through the mapping lists"),
    ("keb-f5-modbus", "2.4", "Functions 100 and 101"),
    ("keb-f5-modbus", "2.4 and 4.2", "Exceptions of its own"),
    ("keb-f5-modbus", "2.5 and 3", "Watchdog"),
    ("keb-f5-modbus", "3", "Parameters of the operator"),
    (STANDARDS, "2.5.2", "Modbus ASCII"),
    (STANDARDS, "3.1.3", "Modbus TCP"),
    (STANDARDS, "4.1", "A PDU by itself"),
    (STANDARDS, "7", "Exceptions"),
];

impl Narrowed {
    fn of(place: &str) -> Self {
        let mut parts = place.splitn(4, '.').map(str::to_owned);
        let mut next = || parts.next().unwrap_or_default();
        Self { manual: next(), kind: next(), function: next(), typed: next() }
    }

    fn place(&self) -> String {
        let Self { manual, kind, function, typed } = self;
        let place = format!("{manual}.{kind}.{function}.{typed}");
        if typed.is_empty() { place.trim_end_matches('.').to_owned() } else { place }
    }

    fn has(&self, sample: &Sample, said: &Said) -> bool {
        let manual = self.manual.is_empty() || key_of(sample) == self.manual;
        let kind = match self.kind.as_str() {
            "request" => said.direction == Direction::Request,
            "response" => said.direction == Direction::Response && !said.is_exception,
            "exception" => said.is_exception,
            "misprint" => said.misprint.is_some(),
            "printed" => sample.printed,
            _ => true,
        };
        let function =
            self.function.is_empty() || said.function.is_some_and(|own| own.to_string() == self.function);
        manual && kind && function && self.says(sample, said)
    }

    /// Whether every word that was typed is in what the telegram says, or the bytes are.
    fn says(&self, sample: &Sample, said: &Said) -> bool {
        let typed = self.typed.trim().to_ascii_lowercase();
        let bytes = hex(&said.bytes).to_ascii_lowercase();
        if typed.is_empty() || typed.len() > 1 && bytes.contains(&typed) {
            return true;
        }
        let text =
            format!("{} {} {} {} {}", said.sentence, said.kind, sample.title, sample.section, sample.place);
        let text = text.to_ascii_lowercase();
        typed.split_whitespace().all(|word| text.contains(word))
    }
}

fn key_of(sample: &Sample) -> &'static str {
    MANUALS.iter().find(|(_, manual, _)| *manual == sample.manual).map_or(STANDARDS, |(key, ..)| key)
}

#[component]
pub fn Gallery() -> impl IntoView {
    let state = expect_context::<LearnState>();
    let narrowed = Memo::new(move |_| Narrowed::of(&state.place(Part::Gallery)));
    // A list that narrows `part` of it.
    let list = move |label, otherwise, options, part: fn(&mut Narrowed) -> &mut String| {
        let value = Signal::derive(move || part(&mut narrowed.get()).clone());
        let on_choose = Callback::new(move |key| {
            let mut to = narrowed.get_untracked();
            *part(&mut to) = key;
            state.go_to(Part::Gallery, to.place());
        });
        view! { <Choose label otherwise options value on_choose /> }
    };
    let typed = Signal::derive(move || narrowed.with(|narrowed| narrowed.typed.clone()));
    let on_type = Callback::new(move |typed| {
        let to = Narrowed { typed, ..narrowed.get_untracked() };
        state.type_to(Part::Gallery, to.place());
    });
    let found = Memo::new(move |_| {
        narrowed.with(|narrowed| {
            let all = SAMPLES.iter().enumerate();
            all.filter(|(_, (sample, said))| narrowed.has(sample, said)).map(|(at, _)| at).collect::<Vec<_>>()
        })
    });
    let mut functions: Vec<(u8, &str)> = Vec::new();
    for (_, said) in SAMPLES.iter().filter(|(_, said)| !said.is_exception) {
        let Some(function) = said.function else { continue };
        let at = functions.partition_point(|(other, _)| *other < function);
        if functions.get(at).is_none_or(|(other, _)| *other != function) {
            functions.insert(at, (function, &said.kind));
        }
    }
    let manuals = MANUALS.map(|(key, _, label)| (key, label));
    let manuals = choices(manuals.into_iter().chain([(STANDARDS, "Standards")]));
    let functions = functions.into_iter().map(|(code, label)| (code.to_string(), format!("{code}: {label}")));
    let clear = move |()| state.go_to(Part::Gallery, String::new());
    let none = move || {
        found.with(Vec::is_empty).then(|| {
            view! {
                <p class="nothing">
                    "No telegram is like that. " <Button class="link" label="Show all" on_press=clear />
                </p>
            }
            .into_any()
        })
    };
    view! {
        <section class="gallery" aria-label="Telegrams">
            <header>
                <h3>"Telegrams of the manuals"</h3>
                <p class="note">
                    "Every telegram that the three manuals print, and one of each function and service. A click opens it in \
                     Read, with its device and what came before it on the line."
                </p>
            </header>
            <div class="tools" role="search" aria-label="Telegrams">
                <Search
                    label="Words or bytes of a telegram"
                    placeholder="Words or bytes, such as: limit, or 00 C8"
                    typed
                    on_type
                />
                {list("Of", "all manuals", manuals, |it| &mut it.manual)}
                {list("Kind", "all", choices(KINDS), |it| &mut it.kind)}
                {list("Function", "all", functions.collect(), |it| &mut it.function)}
                <span class="end" role="status">{move || count(found.with(Vec::len), "telegram")}</span>
            </div>
            {move || groups(&found.get())}
            {move || none()}
        </section>
    }
}

/// The telegrams below their manuals and sections.
fn groups(found: &[usize]) -> Vec<AnyView> {
    let mut shown = Vec::new();
    let same = |one: &usize, other: &usize| {
        let (one, other) = (&SAMPLES[*one].0, &SAMPLES[*other].0);
        (&one.manual, &one.section) == (&other.manual, &other.section)
    };
    let mut manual = "";
    for group in found.chunk_by(same) {
        let sample = &SAMPLES[group[0]].0;
        if sample.manual != manual {
            manual = &sample.manual;
            shown.push(view! { <h4 class="manual">{manual}</h4> }.into_any());
        }
        let title = title(group);
        let rows = group.iter().map(|at| row(&SAMPLES[*at].0, &SAMPLES[*at].1)).collect_view();
        let section = sample.section.clone();
        let heading = (!section.is_empty()).then(|| {
            view! {
                <h5>
                    <span class="number">{section}</span>
                    {title}
                </h5>
            }
        });
        shown.push(view! { {heading} <ul class="samples">{rows}</ul> }.into_any());
    }
    shown
}

/// What a section is about: as it is called here, or the kind that all its telegrams are of.
fn title(group: &[usize]) -> Option<&'static str> {
    let (sample, first) = &SAMPLES[*group.first()?];
    let named =
        SECTIONS.iter().find(|(key, section, _)| *key == key_of(sample) && *section == sample.section);
    let alike = group.iter().all(|at| SAMPLES[*at].1.kind == first.kind);
    named.map(|(.., title)| *title).or_else(|| alike.then_some(first.kind.as_str()))
}

fn row(sample: &'static Sample, said: &'static Said) -> AnyView {
    let (arrow, word) = match said.direction {
        _ if said.is_exception => ("✕", "exception"),
        Direction::Request => ("→", "request"),
        Direction::Response => ("←", "response"),
    };
    let kind = match said.function {
        Some(function) => format!("function {function}"),
        None => said.kind.clone(),
    };
    let protocol = match said.protocol.key {
        "modbus-rtu" | "profibus-fdl" | "profibus-parameter-channel" => "",
        _ => said.protocol.label,
    };
    let about = [kind, protocol.to_owned(), sample.place.clone()];
    let about = about.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · ");
    let misprinted = said.misprint.is_some();
    view! {
        <li class:misprinted=misprinted>
            <a href=href(View::Read, &sample.link()) title=sample.title.as_str()>
                <span class="arrow" aria-hidden="true">{arrow}</span>
                <span class="unseen">{word}</span>
                <span class="says">{said.sentence.as_str()}</span>
                <span class="about">{about}</span>
                <code>{hex(&said.bytes)}</code>
            </a>
            {said.misprint.as_ref().map(|slip| slipped(sample, slip))}
        </li>
    }
    .into_any()
}

/// What is wrong with it in print, and how it should be.
fn slipped(sample: &Sample, slip: &Slip) -> AnyView {
    view! {
        <p class="slip">
            <span class="state warn">
                <Icon glyph=Glyph::Warning />
                "misprinted"
            </span>
            <span>{capital(&slip.what)} ". Corrected:"</span>
            <a href=href(View::Read, &sample.corrected(slip)) title="Open the corrected telegram in Read">
                <code>{hex(&slip.right)}</code>
            </a>
        </p>
    }
    .into_any()
}

fn capital(text: &str) -> String {
    let mut text = text.to_owned();
    if let Some(first) = text.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_leads_back() {
        for place in ["", "memograph-rsg45", "..16", "keb-f5-modbus.misprint", "...Sy.52 = 3."] {
            assert_eq!(Narrowed::of(place).place(), place);
        }
        assert_eq!(Narrowed::of("...a.b").typed, "a.b");
    }

    #[test]
    fn every_printed_telegram_is_in_it() {
        let printed = |key: &str| SAMPLES.iter().filter(|(it, _)| it.printed && key_of(it) == key).count();
        assert_eq!((printed("memograph-rsg45"), printed("keb-f5-profibus")), (71, 15));
        let of_devices = SAMPLES.iter().filter(|(it, _)| key_of(it) != STANDARDS);
        let named = |it: &Sample| {
            SECTIONS.iter().any(|(key, section, _)| *key == key_of(it) && *section == it.section)
        };
        for (sample, _) in of_devices {
            assert!(named(sample), "{}, {} has no title", sample.manual, sample.section);
        }
        let narrowed = Narrowed::of(".misprint");
        assert_eq!(SAMPLES.iter().filter(|(sample, said)| narrowed.has(sample, said)).count(), 15);
    }
}

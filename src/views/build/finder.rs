//! The search for what to build.

use leptos::prelude::*;

use super::state::BuildState;
use crate::components::combobox::Combobox;
use crate::components::icon::{Glyph, Icon};
use buslens::field::Direction;
use buslens::tool::{Found, Offer};

/// Something that was found, with what was typed.
#[derive(Clone)]
struct Hit {
    found: Found,
    typed: String,
    /// What a sentence means says its telegram best: what it would say, and with what.
    told: Option<(String, String)>,
}

#[component]
pub fn Finder() -> impl IntoView {
    /// More are not read by anybody: a letter more finds fewer.
    const SHOWN: usize = 60;
    let state = expect_context::<BuildState>();
    let hits = Signal::derive(move || {
        let typed = state.query.get();
        let found = state.found().into_iter().take(SHOWN);
        found.map(|found| Hit { told: state.told(&found), typed: typed.clone(), found }).collect::<Vec<_>>()
    });
    view! {
        <section class="finder" role="search" aria-label="What to build">
            <Icon glyph=Glyph::Search />
            <Combobox
                label="What do you want to do? A name, a function code, an address"
                value=state.query
                on_input=Callback::new(move |typed| state.query.set(typed))
                options=hits
                draw=hit
                on_choose=Callback::new(move |hit: Hit| state.choose(&hit.found))
                nothing="No match. Try a part of the name, a function code such as 16, or an address such as 0x5F00."
                placeholder="What do you want to do? Such as: write 123.456 good to channel 6"
            />
        </section>
    }
}

fn hit(Hit { found, typed, told }: &Hit) -> AnyView {
    let device = found.device.map_or("any device", |device| device.label);
    let about = match found.offer {
        Offer::Telegram(kind) => format!("function {}", kind.function),
        Offer::Service(kind) => match kind.sap {
            Some(sap) => format!("PROFIBUS, SAP {sap}"),
            None => "PROFIBUS".to_owned(),
        },
        Offer::Task(_) => String::new(),
    };
    // What the words fill in, and why it was found where the label does not show it.
    let filled = found.entries.iter().map(|(path, text)| {
        let name = path.rsplit('.').next().unwrap_or_default().replace('_', " ");
        format!("{name} {text}")
    });
    let facts = filled.chain([found.reason.to_string(), about]).filter(|fact| !fact.is_empty());
    let facts = facts.collect::<Vec<_>>().join(", ");
    let (label, facts) = told.clone().unwrap_or_else(|| (found.label().sentence(), facts));
    let arrow = match found.offer {
        Offer::Telegram(kind) if kind.direction == Direction::Response => Glyph::Back,
        Offer::Service(kind) if kind.direction == Direction::Response => Glyph::Back,
        _ => Glyph::ChevronRight,
    };
    view! {
        <Icon glyph=arrow />
        <b>{marked(&label, typed)}</b>
        <span class="device">{device}</span>
        <span class="facts">{facts}</span>
    }
    .into_any()
}

/// The label, with the words of what was typed marked in it.
fn marked(label: &str, typed: &str) -> Vec<AnyView> {
    pieces(label, typed)
        .into_iter()
        .map(|(piece, lit)| {
            let piece = piece.to_owned();
            if lit { view! { <mark>{piece}</mark> }.into_any() } else { piece.into_any() }
        })
        .collect()
}

/// The label in pieces, and whether each was typed.
fn pieces<'a>(label: &'a str, typed: &str) -> Vec<(&'a str, bool)> {
    let lower = label.to_ascii_lowercase();
    let mut lit = vec![false; label.len()];
    for word in typed.to_ascii_lowercase().split_whitespace() {
        if let Some(at) = lower.find(word) {
            lit[at..at + word.len()].fill(true);
        }
    }
    let mut pieces = Vec::new();
    let mut from = 0;
    for to in 1..=label.len() {
        if (to == label.len() || lit[to] != lit[from]) && label.is_char_boundary(to) {
            pieces.push((&label[from..to], lit[from]));
            from = to;
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::pieces;

    #[test]
    fn words_are_marked_where_they_stand() {
        assert_eq!(
            pieces("Write Universal channel", "channel wr"),
            [("Wr", true), ("ite Universal ", false), ("channel", true)]
        );
        assert_eq!(pieces("", "a"), []);
        assert_eq!(pieces("Größe", "größe"), [("Größe", true)]);
    }
}

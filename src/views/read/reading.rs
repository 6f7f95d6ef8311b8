//! How the input was read, and how it is to be read.

use leptos::prelude::*;

use super::ReadState;
use super::state::Mode;
use crate::components::choose::{Choose, choices};
use buslens::field::{Direction, count, grouped, many};
use buslens::tool::log::{Seen, seen};
use buslens::tool::{PROFILES, PROTOCOLS, Report, proposals};

/// The line that says how the text was read.
#[component]
pub fn ReadAs() -> impl IntoView {
    let read = expect_context::<ReadState>();
    move || {
        let report = read.report();
        let summary = report.summary();
        let style = report.style.map(|style| style.name());
        if read.mode() == Mode::Start {
            return None;
        }
        if summary.telegrams == 0 {
            // What there is instead is said below.
            return Some(
                view! {
                    <p class="read-as">
                        <strong class="bad">"No telegram found."</strong>
                    </p>
                }
                .into_any(),
            );
        }
        let mut said = vec![count(summary.telegrams, "telegram")];
        if summary.pairs > 0 {
            said.push(format!("{} answered", summary.pairs));
        }
        if summary.unchecked > 0 {
            said.push(format!("{} too short to check", summary.unchecked));
        }
        let (failed, class) = match summary.check_failed {
            0 if summary.checked == 0 => (String::new(), ""),
            0 if summary.telegrams == 1 => ("checksum valid".to_owned(), "good"),
            0 if summary.checked == summary.telegrams => ("all checksums valid".to_owned(), "good"),
            0 => (String::new(), ""),
            n => (count(n, "wrong checksum"), "bad"),
        };
        let comma = if failed.is_empty() { "" } else { ", " };
        Some(
            view! {
                <p class="read-as">
                    "Read as "
                    {style.map(|style| view! { {style} ", " })}
                    <strong>{protocol_name(&report)}</strong>
                    ": "
                    {said.join(", ")}
                    {comma}
                    <strong class=class>{failed}</strong>
                    "."
                </p>
            }
            .into_any(),
        )
    }
}

/// What the text tells beside its telegrams, or in their place.
#[component]
pub fn Beside() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let seen = Memo::new(move |_| read.with_settled(|text| seen(text, read.options())));
    view! {
        <Show when=move || seen.with(|seen| !seen.is_empty())>
            <SeenList seen=seen.get() />
        </Show>
    }
}

/// What lines tell that hold no telegram.
#[component]
pub fn SeenList(seen: Vec<Seen>) -> impl IntoView {
    let item = |seen: Seen| {
        let place = match (seen.count, &seen.lines[..]) {
            (count, []) => many(count, "piece"),
            (1, [line, ..]) => format!("Line {line}"),
            (count, lines) => {
                let named: Vec<String> = lines.iter().map(u32::to_string).collect();
                let more = if count > lines.len() {
                    format!(" and {} more", grouped(count - lines.len()))
                } else {
                    String::new()
                };
                format!("Lines {}{more}", named.join(", "))
            }
        };
        view! {
            <li>
                <span class="soft">{place} ": "</span>
                {seen.text}
            </li>
        }
    };
    view! { <ul class="seen note">{seen.into_iter().map(item).collect_view()}</ul> }
}

/// The device whose manual the telegrams read well by, where none is chosen, with the reason.
#[component]
pub fn ProposedDevice() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let proposed = Memo::new(move |_| {
        let best = proposals(&read.report()).into_iter().max_by_key(|proposal| proposal.bits)?;
        Some((best.device.key, best.text.sentence()))
    });
    move || {
        let (key, reason) = proposed.get()?;
        let use_it = move |_| read.read_as(|choices| choices.device = key.to_owned());
        Some(view! {
            <p class="read-as">
                {reason}
                ". "
                <button type="button" class="button low" on:click=use_it>
                    "Use it"
                </button>
            </p>
        })
    }
}

/// The protocol of all telegrams, if they have the same.
fn protocol_name(report: &Report) -> &'static str {
    let mut labels = report.telegrams.iter().map(|telegram| telegram.choice.protocol.label);
    match labels.next() {
        Some(first) if labels.all(|label| label == first) => first,
        _ => "several protocols",
    }
}

/// The lists that say how the input is to be read.
#[component]
pub fn ReadingChoices() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let devices = choices(PROFILES.iter().map(|it| (it.key, it.label)));
    let protocols = choices(PROTOCOLS.iter().map(|it| (it.key, it.label)));
    let directions = || {
        choices([
            (Direction::Request.key(), "All are requests"),
            (Direction::Response.key(), "All are responses"),
        ])
    };
    view! {
        <div class="reading-choices">
            <Choose
                label="Device"
                otherwise="Any"
                options=devices
                value=Signal::derive(move || read.choices().device)
                on_choose=Callback::new(move |key| read.read_as(|choices| choices.device = key))
            />
            <Choose
                label="Protocol"
                otherwise="Detect from the bytes"
                options=protocols
                value=Signal::derive(move || read.choices().protocol)
                on_choose=Callback::new(move |key| read.read_as(|choices| choices.protocol = key))
            />
            <Show when=move || read.mode() == Mode::Telegrams>
                <Choose
                    label="Direction"
                    otherwise="Detect from the bytes"
                    options=directions()
                    value=Signal::derive(move || read.choices().direction)
                    on_choose=Callback::new(move |key| read.read_as(|choices| choices.direction = key))
                />
            </Show>
        </div>
    }
}

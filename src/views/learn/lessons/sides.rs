//! A conversation as two sides that take turns, one telegram after another.

use leptos::prelude::*;

use super::walk::{Lit, Said, stops};
use crate::components::byte_strip::{ByteStrip, blocks};
use crate::components::telegram::Shown;
use buslens::field::{Direction, hex};
use buslens_trainer::lesson::Step;

#[component]
pub fn Sides(step: Step, shown: Vec<Shown>) -> impl IntoView {
    let all = stops(&step, &shown);
    let of: Vec<usize> = all.iter().map(|stop| stop.telegram).collect();
    let lit = Lit::new(shown.len(), all);
    // The telegram that is being spoken of.
    let current = Memo::new(move |before: Option<&usize>| {
        lit.at().and_then(|at| of.get(at).copied()).or(before.copied()).unwrap_or(0)
    });
    // What was sent already stays in sight; what comes is not known yet.
    let latest = Memo::new(move |before: Option<&usize>| current.get().max(before.copied().unwrap_or(0)));
    let rows: Vec<_> = shown
        .iter()
        .cloned()
        .enumerate()
        .filter_map(|(index, shown)| {
            let lights = lit.of(index)?;
            let request = shown.telegram.guess.direction == Direction::Request;
            let said = shown.detail.meaning().sentence();
            let bytes = hex(shown.bytes());
            let strip = blocks(&shown.detail, shown.bytes());
            let content = move || {
                if current.get() == index {
                    view! { <ByteStrip blocks=strip.clone() lights size="small" /> }.into_any()
                } else {
                    view! { <code>{bytes.clone()}</code> }.into_any()
                }
            };
            Some(view! {
                <li
                    class=if request { "asks" } else { "answers" }
                    class:current=move || current.get() == index
                    hidden=move || latest.get() < index
                >
                    <span class="unseen">{if request { "Sent: " } else { "Came back: " }}</span>
                    {move || content()}
                    <span class="note">{said}</span>
                </li>
            })
        })
        .collect();
    let profibus = shown.first().is_some_and(|it| it.telegram.choice.protocol.key.starts_with("profibus"));
    let (asks, answers) = if profibus { ("Master", "Slave") } else { ("Client", "Server") };
    view! {
        <div class="walk sides">
            <p class="heads" aria-hidden="true">
                <b>{asks}</b>
                <b>{answers}</b>
            </p>
            <ol>{rows}</ol>
            <Said lit shown />
        </div>
    }
}

//! The telegrams of the input, a row each. Only the rows in sight exist.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use super::{Drawn, drawn};
use crate::app::browser::{self, LIST};
use crate::app::state::State;
use buslens::field::Direction;
use buslens::tool::{Certainty, Report, Verdict};

/// The height of a row in pixels; the stylesheet has the same.
const ROW: usize = 48;
/// How many rows are in sight at most.
const SIGHT: usize = 10;

#[component]
pub fn Telegrams(state: State) -> impl IntoView {
    let empty: Drawn<bool> =
        Box::new(move || state.decoded.with(|decoded| decoded.report.telegrams.is_empty()));
    let current: Drawn =
        Box::new(move || state.decoded.with(|decoded| format!("telegram-{}", decoded.index())));
    let rows = drawn(move || {
        let scrolled = state.scrolled.get();
        state.decoded.with(|decoded| rows(&decoded.report, scrolled / ROW, decoded.index()))
    });
    view! {
        <section class="card telegrams" aria-labelledby="telegrams" hidden=empty>
            <div inner_html=head().into_string()></div>
            <div
                id=LIST
                class="window"
                role="listbox"
                tabindex="0"
                aria-labelledby="telegrams"
                aria-activedescendant=current
                inner_html=rows
            ></div>
        </section>
    }
}

pub fn hear(state: State, kind: &str, event: &Event) {
    let Some(list) = browser::closest(event, "#list") else { return };
    match kind {
        "click" => {
            if let Some(index) = browser::attribute(event, "data-telegram").and_then(|at| at.parse().ok()) {
                state.select(index);
            }
        }
        "keydown" => go(state, event),
        "scroll" => state.scrolled.set(list.scroll_top().max(0) as usize),
        _ => {}
    }
}

fn go(state: State, event: &Event) {
    let (at, of) = state.decoded.with_untracked(|decoded| (decoded.index(), decoded.report.telegrams.len()));
    if let Some(to) = aim(event, at, of) {
        state.select(to);
    }
}

/// The row that a key leads to from row `at` of `of`.
pub fn aim(event: &Event, at: usize, of: usize) -> Option<usize> {
    let last = of.saturating_sub(1);
    let to = match browser::key(event).as_str() {
        "ArrowDown" => at + 1,
        "ArrowUp" => at.saturating_sub(1),
        "PageDown" => at + SIGHT,
        "PageUp" => at.saturating_sub(SIGHT),
        "Home" => 0,
        "End" => last,
        _ => return None,
    };
    event.prevent_default();
    Some(to.min(last))
}

fn head() -> Markup {
    html! {
        h2.title id="telegrams" { "Telegrams" }
        div.row.head aria-hidden="true" {
            @for title in ["#", "", "Unit", "What it says", "Check"] { span { (title) } }
        }
    }
}

/// The rows around `top`, as many as can be in sight, in a space as high as all of them.
fn rows(report: &Report, top: usize, current: usize) -> Markup {
    let first = top.saturating_sub(2);
    let total = report.telegrams.len();
    let last = (first + SIGHT + 5).min(total);
    html! {
        // The space above and below belongs to rows that do not exist at the moment.
        (space(first.min(last) * ROW))
        @for index in first..last { (row(report, index, index == current)) }
        (space((total - last) * ROW))
    }
}

/// So many pixels of nothing.
pub fn space(height: usize) -> Markup {
    html! { svg.space width="1" height=(height) aria-hidden="true" {} }
}

fn row(report: &Report, index: usize, selected: bool) -> Markup {
    let (Some(telegram), Some(detail)) = (report.telegrams.get(index), report.detail(index)) else {
        return html! {};
    };
    let (arrow, direction) = match (telegram.guess.certainty, telegram.guess.direction) {
        (Certainty::Open, _) => ("↔", "direction open"),
        (_, Direction::Request) => ("→", "request"),
        (_, Direction::Response) => ("←", "response"),
    };
    let (mark, class) = match telegram.verdict {
        Verdict::Right => ("✓", "good"),
        Verdict::Wrong => ("✗", "error"),
        Verdict::Unchecked => ("…", "open"),
        Verdict::NoCheck => ("–", "open"),
    };
    let check = telegram.verdict.words();
    html! {
        div.row role="option" id={ "telegram-" (index) } data-telegram=(index) aria-selected=(selected)
            aria-setsize=(report.telegrams.len()) aria-posinset=(index + 1) {
            span.number { (index + 1) }
            span.direction title=(direction) {
                span aria-hidden="true" { (arrow) }
                span.unseen { (direction) }
            }
            span.unit { @if let Some(unit) = detail.unit { (unit) } }
            span.said { (detail.said.sentence()) }
            span class={ "check " (class) } title=(check) {
                span aria-hidden="true" { (mark) }
                span.unseen { (check) }
            }
        }
    }
}

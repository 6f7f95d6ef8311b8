//! The telegrams of the input, a row each. Only the rows in sight exist.

use leptos::html::Div;
use leptos::prelude::*;

use crate::app::state::State;
use crate::field::Direction;
use crate::tool::{Certainty, Verdict};

/// The height of a row in pixels; the stylesheet has the same.
const ROW: usize = 48;
/// How many rows are in sight at most.
const SIGHT: usize = 10;

#[component]
pub fn Telegrams() -> impl IntoView {
    let state = State::here();
    let scrolled = RwSignal::new(0);
    let window = NodeRef::<Div>::new();
    let total = Memo::new(move |_| state.report.with(|report| report.telegrams.len()));
    let current = Memo::new(move |_| state.selected.get().min(total.get().saturating_sub(1)));
    // The chosen row is always in sight.
    Effect::new(move |_| {
        let top = (current.get() * ROW) as i32;
        if let Some(window) = window.get() {
            let bottom = top + ROW as i32 - window.client_height();
            let at = window.scroll_top();
            if at > top {
                window.set_scroll_top(top);
            } else if at < bottom {
                window.set_scroll_top(bottom);
            }
        }
    });
    let go = move |event: web_sys::KeyboardEvent| {
        let last = total.get_untracked().saturating_sub(1);
        let at = current.get_untracked();
        let to = match event.key().as_str() {
            "ArrowDown" => at + 1,
            "ArrowUp" => at.saturating_sub(1),
            "PageDown" => at + SIGHT,
            "PageUp" => at.saturating_sub(SIGHT),
            "Home" => 0,
            "End" => last,
            _ => return,
        };
        event.prevent_default();
        state.selected.set(to.min(last));
    };
    let rows = move || {
        let first = (scrolled.get() / ROW).saturating_sub(2);
        let last = (first + SIGHT + 5).min(total.get());
        (first..last).map(|index| row(state, current, index)).collect_view()
    };
    view! {
        <section class="card telegrams" aria-labelledby="telegrams" hidden=move || total.get() == 0>
            <h2 id="telegrams" class="title">"Telegrams"</h2>
            <div class="row head" aria-hidden="true">
                <span>"#"</span>
                <span></span>
                <span>"Unit"</span>
                <span>"What it says"</span>
                <span>"Check"</span>
            </div>
            <div
                class="window"
                role="listbox"
                tabindex="0"
                aria-labelledby="telegrams"
                aria-activedescendant=move || format!("telegram-{}", current.get())
                node_ref=window
                on:keydown=go
                on:scroll:target=move |event| scrolled.set(event.target().scroll_top().max(0) as usize)
            >
                <div class="space" role="presentation" style:height=move || format!("{}px", total.get() * ROW)>
                    {rows}
                </div>
            </div>
        </section>
    }
}

fn row(state: State, current: Memo<usize>, index: usize) -> Option<impl IntoView> {
    let (telegram, said, unit, total) = state.report.with(|report| {
        let telegram = report.telegrams.get(index)?;
        let detail = report.detail(index)?;
        let unit = detail.unit.map(|unit| unit.to_string()).unwrap_or_default();
        Some((telegram.clone(), detail.said.sentence(), unit, report.telegrams.len()))
    })?;
    let (arrow, direction) = match (telegram.guess.certainty, telegram.guess.direction) {
        (Certainty::Open, _) => ("↔", "direction open"),
        (_, Direction::Request) => ("→", "request"),
        (_, Direction::Response) => ("←", "response"),
    };
    let (mark, check, class) = match telegram.verdict {
        Verdict::Right => ("✓", "check right", "good"),
        Verdict::Wrong => ("✗", "check failed", "error"),
        Verdict::Unchecked => ("…", "too short to check", "open"),
    };
    Some(view! {
        <div
            class="row"
            role="option"
            id=format!("telegram-{index}")
            aria-selected=move || (current.get() == index).to_string()
            aria-setsize=total
            aria-posinset=index + 1
            style:top=format!("{}px", index * ROW)
            on:click=move |_| state.selected.set(index)
        >
            <span class="number">{index + 1}</span>
            <span class="direction" title=direction>
                <span aria-hidden="true">{arrow}</span>
                <span class="unseen">{direction}</span>
            </span>
            <span class="unit">{unit}</span>
            <span class="said">{said}</span>
            <span class=format!("check {class}") title=check>
                <span aria-hidden="true">{mark}</span>
                <span class="unseen">{check}</span>
            </span>
        </div>
    })
}

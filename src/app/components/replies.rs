//! What can come back to what is built, each to be opened and changed in turn.

use std::ops::Range;

use leptos::prelude::*;
use maud::{Markup, html};

use super::{Drawn, drawn};
use crate::app::address::fragment;
use crate::app::making::{Made, Making};
use crate::app::state::State;
use buslens::field::{Direction, Message, hex};
use buslens::tool::Options;
use buslens::tool::link::Link;

#[component]
pub fn Replies(making: Making, state: State) -> impl IntoView {
    let none: Drawn<bool> = Box::new(move || making.outcome.with(|outcome| outcome.replies.is_empty()));
    let healthy = drawn(move || replies(making, state, 0..1));
    let refusals = drawn(move || replies(making, state, 1..usize::MAX));
    let no_refusals: Drawn<bool> = Box::new(move || making.outcome.with(|outcome| outcome.replies.len() < 2));
    view! {
        <section class="card replies" aria-label="What can come back" hidden=none>
            <h2>"What can come back"</h2>
            <div inner_html=healthy></div>
            <details hidden=no_refusals>
                <summary>"Or a refusal"</summary>
                <div inner_html=refusals></div>
            </details>
            <p class="note">
                "Each opens as a form of its own, where its values can be set; “back” in the browser returns to the request."
            </p>
        </section>
    }
}

/// Some of the replies; the first is a healthy device's.
fn replies(making: Making, state: State, some: Range<usize>) -> Markup {
    making.outcome.with(|outcome| {
        making.now(|made| {
            let replies = outcome.replies.iter().take(some.end).skip(some.start);
            html! { @for it in replies { (reply(it, made, state)) } }
        })
    })
}

fn reply((label, bytes): &(Message, Vec<u8>), made: &Made, state: State) -> Markup {
    let options = Options {
        protocol: Some(made.protocol),
        direction: Some(Direction::Response),
        device: made.device,
        settings: state.settings(),
    };
    let link = Link::to(hex(bytes), options);
    html! {
        a.reply href={ "#" (fragment(&link)) } {
            span { (label.sentence()) }
            code { (hex(bytes)) }
        }
    }
}

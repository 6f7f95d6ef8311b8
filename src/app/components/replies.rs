//! What can come back to what is built, each to be opened and changed in turn.

use leptos::prelude::*;
use maud::{Markup, html};

use super::{Drawn, drawn};
use crate::app::address::fragment;
use crate::app::making::{Made, Making};
use crate::app::state::State;
use crate::field::{Direction, Message, hex};
use crate::tool::Options;
use crate::tool::link::Link;

#[component]
pub fn Replies(making: Making, state: State) -> impl IntoView {
    let none: Drawn<bool> = Box::new(move || making.with(|made| made.replies.is_empty()));
    let replies = drawn(move || making.with(|made| replies(made, state)));
    view! { <section class="card replies" aria-label="What can come back" hidden=none inner_html=replies></section> }
}

fn replies(made: &Made, state: State) -> Markup {
    let Some((first, others)) = made.replies.split_first() else { return html! {} };
    html! {
        h2 { "What can come back" }
        (reply(first, made, state))
        @if !others.is_empty() {
            details {
                summary { "Or a refusal" }
                @for other in others { (reply(other, made, state)) }
            }
        }
        p.note { "Each opens as a form of its own, where its values can be set; “back” in the browser returns to the request." }
    }
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

//! What can be built, found by typing a part of its name, its function code or an address.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use super::drawn;
use super::settings::list;
use crate::app::browser::{self, DEVICE, PROTOCOL};
use crate::app::making::{Made, Making};
use crate::app::state::State;
use buslens::field::count;
use buslens::tool::{Editor, PROFILES, PROTOCOLS, Profile, Protocol};

#[component]
pub fn Finder(making: Making) -> impl IntoView {
    let found = drawn(move || making.with(found));
    view! {
        <section class="card finder" aria-label="What to build">
            <div inner_html=content().into_string()></div>
            <div id=OFFERS class="offers" inner_html=found></div>
        </section>
    }
}

pub fn hear(making: Making, state: State, kind: &str, event: &Event) {
    let id = browser::id(event);
    match (kind, id.as_str()) {
        ("input", FIND) => making.find(browser::value(event)),
        ("change", DEVICE) => {
            making.ask_device(state, Profile::of(&browser::value(event)));
        }
        ("change", PROTOCOL) => {
            if let Some(protocol) = Protocol::of(&browser::value(event)) {
                making.carry_by(state, protocol);
            }
        }
        ("click", _) => {
            if let Some(index) = browser::attribute(event, "data-offer").and_then(|index| index.parse().ok())
            {
                making.choose(state, index);
            }
        }
        _ => {}
    }
}

const FIND: &str = "find";
const OFFERS: &str = "offers";

fn content() -> Markup {
    html! {
        div.settings {
            (list(DEVICE, "Device", Some("Any"), PROFILES.iter().map(|it| (it.key, it.label))))
            (list(PROTOCOL, "Protocol", None, PROTOCOLS.iter().map(|it| (it.key, it.label))))
        }
        label.title for=(FIND) { "What should it do? A name, a function code or an address" }
        input id=(FIND) type="search" autocomplete="off" spellcheck="false" aria-controls=(OFFERS)
            placeholder="write channel, 16, 0x5F00";
    }
}

/// The first of what fits.
fn found(made: &Made) -> Markup {
    /// More are not read by anybody: a letter more finds fewer.
    const SHOWN: usize = 100;
    let offers = made.offers();
    let chosen = made.editor.as_ref().map(Editor::label);
    html! {
        @if offers.is_empty() {
            p.more { "Nothing is called so. Try a part of the name, a function code such as 16, or an address such as 0x5F00." }
        }
        ul {
            @for (index, offer) in offers.iter().enumerate().take(SHOWN) {
                @let label = offer.label();
                li {
                    button type="button" data-offer=(index) aria-pressed=(Some(&label) == chosen.as_ref()) {
                        (label.sentence())
                    }
                }
            }
        }
        @if offers.len() > SHOWN { p.more { "and " (count(offers.len() - SHOWN, "more")) } }
    }
}

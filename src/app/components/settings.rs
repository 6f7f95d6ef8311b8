//! How the input is to be read, and the examples to put there.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use super::examples;
use crate::app::browser::{self, DEVICE, DIRECTION, FILE, PROTOCOL};
use crate::app::state::State;
use buslens::field::Direction;
use buslens::tool::{PROFILES, PROTOCOLS, Profile, Protocol};

#[component]
pub fn Settings() -> impl IntoView {
    view! { <div class="settings" inner_html=content().into_string()></div> }
}

pub fn hear(state: State, kind: &str, event: &Event) {
    match kind {
        "change" => choose(state, event),
        "click" if browser::attribute(event, "data-clear").is_some() => state.load(""),
        _ => {}
    }
}

fn content() -> Markup {
    let directions = [("request", "All are requests"), ("response", "All are responses")];
    html! {
        (list(PROTOCOL, "Protocol", Some("As the bytes tell"), PROTOCOLS.iter().map(|it| (it.key, it.label))))
        (list(DIRECTION, "Direction", Some("As the bytes tell"), directions.into_iter()))
        (list(DEVICE, "Device", Some("Any"), PROFILES.iter().map(|it| (it.key, it.label))))
        details.menu id="examples" {
            summary { "Examples" }
            div.examples { (examples::examples()) }
        }
        input.unseen id=(FILE) type="file";
        label.quiet for=(FILE) { "Open file" }
        button.quiet type="button" data-clear="" { "Clear" }
        a.quiet href="sheet.html" { "Print, export" }
    }
}

/// A list to choose from: what counts where nobody chooses, if that may be, then the others, each with its
/// key.
pub fn list(
    id: &str,
    label: &str,
    otherwise: Option<&str>,
    others: impl Iterator<Item = (&'static str, &'static str)>,
) -> Markup {
    html! {
        label {
            span { (label) }
            select id=(id) {
                @if let Some(otherwise) = otherwise { option value="" { (otherwise) } }
                @for (key, label) in others {
                    option value=(key) { (label) }
                }
            }
        }
    }
}

fn choose(state: State, event: &Event) {
    let list = browser::id(event);
    if ![PROTOCOL, DEVICE, DIRECTION].contains(&list.as_str()) {
        return;
    }
    let key = browser::value(event);
    state.read_as(|options| match list.as_str() {
        PROTOCOL => options.protocol = Protocol::of(&key),
        DEVICE => options.device = Profile::of(&key),
        _ => options.direction = Direction::of(&key),
    });
}

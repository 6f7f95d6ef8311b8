//! Decode: paste telegrams, read what they say.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use crate::app::components::{detail, examples, header, input, list, menu, settings};
use crate::app::state::{Shown, State};
use buslens::field::hex;

/// An event of the page, for the part that it concerns.
pub fn hear(state: State, event: &Event) {
    let kind = event.type_();
    match kind.as_str() {
        "click" if examples::load(state, event) => menu::close(event),
        _ => {
            menu::hear(&kind, event);
            header::hear(&kind, event);
            settings::hear(state, &kind, event);
            input::hear(state, &kind, event);
            list::hear(state, &kind, event);
            detail::hear(state, &kind, event);
        }
    }
}

/// What can be done with a telegram here.
fn actions(shown: &Shown, link: &str) -> Markup {
    html! {
        a.quiet href={ "build.html#" (link) } { "Edit in Build" }
        button.quiet type="button" data-copy=(hex(shown.bytes())) { "Copy as hex" }
    }
}

#[component]
pub fn Decode(state: State) -> impl IntoView {
    view! {
        <header::Header here="." />
        <main id="main" class="panes" tabindex="-1">
            <div class="column">
                <input::Input state />
                <list::Telegrams state />
            </div>
            <detail::Telegram state actions />
        </main>
    }
}

//! Decode: paste telegrams, read what they say.

use leptos::prelude::*;
use web_sys::Event;

use crate::app::components::{detail, examples, header, input, list, settings};
use crate::app::state::State;

/// An event of the page, for the part that it concerns.
pub fn hear(state: State, event: &Event) {
    let kind = event.type_();
    match kind.as_str() {
        "click" if examples::load(state, event) => settings::close_menu(event),
        _ => {
            header::hear(&kind, event);
            settings::hear(state, &kind, event);
            input::hear(state, &kind, event);
            list::hear(state, &kind, event);
            detail::hear(state, &kind, event);
        }
    }
}

const BUILD: detail::Other = detail::Other { document: "build.html", label: "Edit in Build" };

#[component]
pub fn Decode(state: State) -> impl IntoView {
    view! {
        <header::Header here="." />
        <main id="main" class="views" tabindex="-1">
            <div class="column">
                <input::Input state />
                <list::Telegrams state />
            </div>
            <detail::Telegram state other=BUILD />
        </main>
    }
}

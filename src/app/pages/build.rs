//! Build: choose a telegram, fill it in, take its bytes.

use leptos::prelude::*;
use web_sys::Event;

use crate::app::components::{detail, finder, header, made};
use crate::app::making::Making;
use crate::app::state::State;

/// An event of the page, for the part that it concerns.
pub fn hear(making: Making, state: State, event: &Event) {
    let kind = event.type_();
    header::hear(&kind, event);
    finder::hear(making, state, &kind, event);
    made::hear(making, state, &kind, event);
    detail::hear(state, &kind, event);
}

const DECODE: detail::Other = detail::Other { document: ".", label: "Open in Decode" };

#[component]
pub fn Build(making: Making, state: State) -> impl IntoView {
    view! {
        <header::Header here="build.html" />
        <main id="main" class="views" tabindex="-1">
            <div class="column">
                <finder::Finder making />
                <made::Form making />
            </div>
            <detail::Telegram state other=DECODE />
        </main>
    }
}

//! Build: choose a telegram, fill it in, take its bytes.

use leptos::prelude::*;
use web_sys::Event;

use crate::app::components::{detail, finder, form, header};
use crate::app::making::Making;
use crate::app::state::State;

/// An event of the page, for the part that it concerns.
pub fn hear(making: Making, state: State, event: &Event) {
    let kind = event.type_();
    header::hear(&kind, event);
    finder::hear(making, state, &kind, event);
    form::hear(making, state, &kind, event);
    detail::hear(state, &kind, event);
}

#[component]
pub fn Build(making: Making, state: State) -> impl IntoView {
    view! {
        <header::Header here="build.html" />
        <main id="main" class="views" tabindex="-1">
            <div class="column">
                <finder::Finder making />
                <form::Form making />
            </div>
            <detail::Telegram state />
        </main>
    }
}

//! Sheet: what Decode shows, made for paper, and as files.

use leptos::prelude::*;
use web_sys::Event;

use crate::app::components::{exports, header, sheet};
use crate::app::state::State;

/// An event of the page, for the part that it concerns.
pub fn hear(state: State, event: &Event) {
    let kind = event.type_();
    header::hear(&kind, event);
    exports::hear(state, &kind, event);
}

#[component]
pub fn Sheet(state: State) -> impl IntoView {
    view! {
        <header::Header here="sheet.html" />
        <main id="main" class="panes single" tabindex="-1">
            <exports::Exports />
            <sheet::Telegrams state />
        </main>
    }
}

//! Build: choose a telegram, fill it in, take its bytes.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use crate::app::components::{copies, detail, finder, header, made, menu, replies};
use crate::app::making::Making;
use crate::app::state::{Shown, State};

/// An event of the page, for the part that it concerns.
pub fn hear(making: Making, state: State, event: &Event) {
    let kind = event.type_();
    header::hear(&kind, event);
    menu::hear(&kind, event);
    copies::hear(state, &kind, event);
    finder::hear(making, state, &kind, event);
    made::hear(making, state, &kind, event);
    detail::hear(state, &kind, event);
}

/// What can be done with a telegram here.
fn actions(shown: &Shown, link: &str) -> Markup {
    html! {
        a.quiet href={ ".#" (link) } { "Open in Decode" }
        (copies::copies(shown))
    }
}

#[component]
pub fn Build(making: Making, state: State) -> impl IntoView {
    view! {
        <header::Header here="build.html" />
        <main id="main" class="panes" tabindex="-1">
            <div class="column">
                <finder::Finder making />
                <made::Form making />
                <replies::Replies making state />
            </div>
            <detail::Telegram state actions />
        </main>
    }
}

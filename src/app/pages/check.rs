//! Check: how a check is worked out, step by step.

use leptos::prelude::*;
use web_sys::Event;

use crate::app::components::{header, stepper};
use crate::app::stepping::Stepping;

/// An event of the page, for the part that it concerns.
pub fn hear(stepping: Stepping, event: &Event) {
    let kind = event.type_();
    header::hear(&kind, event);
    stepper::hear(stepping, &kind, event);
}

#[component]
pub fn Check(stepping: Stepping) -> impl IntoView {
    view! {
        <header::Header here="check.html" />
        <main id="main" class="panes single" tabindex="-1">
            <stepper::Stepper stepping />
        </main>
    }
}

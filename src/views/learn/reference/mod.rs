//! Reference: registers, parameters, codes and telegrams, to look up.

use leptos::prelude::*;

#[component]
pub fn Reference() -> impl IntoView {
    view! { <section aria-label="Reference"></section> }
}

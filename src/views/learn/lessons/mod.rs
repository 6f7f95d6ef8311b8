//! Lessons: short lessons, each ending with something to do.

use leptos::prelude::*;

#[component]
pub fn Lessons() -> impl IntoView {
    view! { <section aria-label="Lessons"></section> }
}

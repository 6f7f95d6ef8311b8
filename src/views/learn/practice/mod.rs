//! Practice: tasks without end, made from a seed.

use leptos::prelude::*;

#[component]
pub fn Practice() -> impl IntoView {
    view! { <section aria-label="Practice"></section> }
}

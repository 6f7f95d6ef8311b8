//! A log.
use leptos::prelude::*;

#[component]
pub fn LogView() -> impl IntoView {
    view! { <p>"log"</p> }
}

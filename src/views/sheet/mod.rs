//! Sheet: what is read, made for paper.

use leptos::prelude::*;

#[component]
pub fn Sheet() -> impl IntoView {
    view! { <p>"Sheet"</p> }
}

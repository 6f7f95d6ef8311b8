//! Gallery: the telegrams of the manuals, each opened in Read by a click.

use leptos::prelude::*;

#[component]
pub fn Gallery() -> impl IntoView {
    view! { <section aria-label="Gallery"></section> }
}

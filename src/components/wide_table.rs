//! A table that may be wider than the page: it scrolls by itself, by keyboard, too.

use leptos::prelude::*;

#[component]
pub fn WideTable(
    #[prop(into)] label: String,
    #[prop(into, optional)] class: String,
    /// Its head and its body.
    children: Children,
) -> impl IntoView {
    view! {
        <div class="wide" tabindex="0" role="region" aria-label=label>
            <table class=format!("table {class}")>{children()}</table>
        </div>
    }
}

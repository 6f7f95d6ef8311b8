//! Check.

mod state;

use leptos::prelude::*;

pub use state::CheckState;

#[component]
pub fn Check() -> impl IntoView {
    view! { <p>"Check"</p> }
}

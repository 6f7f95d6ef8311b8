//! Build.

mod state;

use leptos::prelude::*;

pub use state::BuildState;

#[component]
pub fn Build() -> impl IntoView {
    view! { <p>"Build"</p> }
}

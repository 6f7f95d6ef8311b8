//! Read: paste, type, drop or open anything of any size.

mod state;

use leptos::prelude::*;

pub use state::ReadState;

#[component]
pub fn Read() -> impl IntoView {
    view! { <p>"Read"</p> }
}

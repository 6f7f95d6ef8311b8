//! Build: find a telegram, fill it in, take its bytes.

mod finder;
mod making;
mod search;
mod sides;
mod state;

use leptos::prelude::*;

use finder::Finder;
use making::Making;
use sides::{Dock, ReplySide, RequestSide};
pub use state::BuildState;

#[component]
pub fn Build() -> impl IntoView {
    view! {
        <div class="build">
            <h2 class="unseen">"Build a telegram"</h2>
            <Finder />
            <div class="columns">
                <Making />
                <RequestSide />
                <ReplySide />
            </div>
            <Dock />
        </div>
    }
}

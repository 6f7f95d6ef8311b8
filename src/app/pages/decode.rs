//! Decode: paste telegrams, read what they say.

use leptos::prelude::*;

use crate::app::components::{detail, input, list};
use crate::app::state::State;

#[component]
pub fn Decode(state: State) -> impl IntoView {
    view! {
        <main class="decode">
            <div class="column">
                <input::Input state />
                <list::Telegrams state />
            </div>
            <detail::Telegram state />
        </main>
    }
}

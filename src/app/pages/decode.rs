//! Decode: paste telegrams, read what they say.

use leptos::prelude::*;

use crate::app::components::{detail, input, list};

#[component]
pub fn Decode() -> impl IntoView {
    view! {
        <main class="decode">
            <div class="column">
                <input::Input />
                <list::Telegrams />
            </div>
            <detail::Telegram />
        </main>
    }
}

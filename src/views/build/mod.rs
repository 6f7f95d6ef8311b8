//! Build: find a telegram, fill it in, take its bytes.

mod finder;
mod making;
mod sides;
mod state;

use leptos::prelude::*;

use crate::components::toast::Toasts;
use finder::Finder;
use making::Making;
use sides::{Dock, ReplySide, RequestSide};
pub use state::BuildState;

#[component]
pub fn Build() -> impl IntoView {
    let built = expect_context::<BuildState>().built();
    let toasts = expect_context::<Toasts>();
    // Told at a pause: not at each keystroke.
    let said = Memo::new(move |_| {
        built.with(|built| match (built.impossible.as_ref().or(built.refused.as_ref()), &built.telegram) {
            (Some(why), _) => why.sentence(),
            (None, Some(telegram)) => telegram.detail.meaning().sentence(),
            (None, None) => String::new(),
        })
    });
    Effect::new(move |before: Option<()>| {
        let said = said.get();
        if before.is_some() {
            toasts.announce(said);
        }
    });
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

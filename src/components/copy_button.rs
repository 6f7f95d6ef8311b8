//! A button that copies a text.

use std::time::Duration;

use leptos::prelude::*;
use leptos::task::spawn_local;

use super::icon::{Glyph, Icon};
use super::toast::Toasts;
use crate::browser::clipboard;

/// Copies `text`, and says so where the browser did it.
#[component]
pub fn CopyButton(
    /// Asked for when the button is pressed.
    #[prop(into)]
    text: Signal<String>,
    /// What stands on the button.
    #[prop(into)]
    label: Signal<String>,
    /// The label is for screen readers; others see the sign.
    #[prop(optional)]
    icon_only: bool,
    #[prop(into, optional)] class: String,
) -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    let copied = RwSignal::new(false);
    let copy = move |_| {
        let text = text.get_untracked();
        spawn_local(async move {
            if copy(toasts, text).await {
                toasts.announce("Copied.");
                copied.set(true);
                set_timeout(move || copied.set(false), SHOWN);
            }
        });
    };
    let shown = move || if copied.get() { "Copied".to_owned() } else { label.get() };
    view! {
        <button type="button" class=format!("button {class}") class:icon-only=icon_only on:click=copy>
            {move || {
                let glyph = if copied.get() { Glyph::Tick } else { Glyph::Copy };
                view! { <Icon glyph /> }
            }}
            <span class:unseen=icon_only>{move || shown()}</span>
        </button>
    }
}

/// How long a button says what it did.
const SHOWN: Duration = Duration::from_secs(2);

/// Puts `text` on the clipboard; whoever asked for it says so. Where the browser refuses, the person is told how
/// to do it by hand.
pub async fn copy(toasts: Toasts, text: String) -> bool {
    let done = clipboard::write(&text).await.is_ok();
    if !done {
        toasts.say("The browser does not let Buslens copy. Select the text and copy it with Ctrl+C.");
    }
    done
}

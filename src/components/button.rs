//! Buttons, and links that look like them: a sign and a word.

use leptos::prelude::*;

use super::icon::{Glyph, Icon};

/// A button with a word, and a sign before it; what leads on has its sign behind the word.
#[component]
pub fn Button(
    #[prop(into)] label: Signal<String>,
    #[prop(into)] on_press: Callback<()>,
    #[prop(into, optional)] glyph: Option<Glyph>,
    /// With `icon-only`, the word is for screen readers.
    #[prop(default = "button")]
    class: &'static str,
    #[prop(into, optional)] disabled: Signal<bool>,
    #[prop(into, optional)] hidden: Signal<bool>,
) -> AnyView {
    let icon_only = class.contains("icon-only");
    view! {
        <button
            type="button"
            class=class
            prop:disabled=disabled
            hidden=hidden
            on:click=move |_| on_press.run(())
        >
            {signed(glyph, view! { <span class:unseen=icon_only>{label}</span> }.into_any())}
        </button>
    }
    .into_any()
}

/// A link that looks like a button, or as `class` says.
#[component]
pub fn ButtonLink(
    #[prop(into)] label: String,
    to: String,
    #[prop(into, optional)] glyph: Option<Glyph>,
    #[prop(default = "button")] class: &'static str,
) -> AnyView {
    view! {
        <a class=class href=to>
            {signed(glyph, label.into_any())}
        </a>
    }
    .into_any()
}

/// The word with its sign.
fn signed(glyph: Option<Glyph>, word: AnyView) -> Vec<AnyView> {
    let sign = glyph.map(|glyph| view! { <Icon glyph /> }.into_any());
    match glyph {
        Some(Glyph::Forward) => [Some(word), sign].into_iter().flatten().collect(),
        _ => sign.into_iter().chain([word]).collect(),
    }
}

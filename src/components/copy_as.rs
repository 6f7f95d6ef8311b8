//! The telegram as text for other programs.

use leptos::prelude::*;
use leptos::task::spawn_local;

use super::copy_button::copy;
use super::icon::Glyph;
use super::menu::{Menu, MenuItem};
use super::telegram::Shown;
use super::toast::Toasts;
use buslens::tool::copy::{FORMATS, Format};
use buslens::tool::json;

/// A menu of formats, with one more where the line carries characters. There is none without a telegram.
#[component]
pub fn CopyAs(#[prop(into)] shown: Signal<Option<Shown>>, #[prop(optional)] at_end: bool) -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    let give = move |text: String| {
        spawn_local(async move {
            if copy(toasts, text).await {
                toasts.say("Copied.");
            }
        });
    };
    let entry = move |format: &'static Format| {
        let choose = Callback::new(move |()| {
            let Some(shown) = shown.get_untracked() else { return };
            // What is on the line are the characters.
            give(match characters(&shown) {
                Some(characters) => (format.write)(characters.as_bytes()),
                None => (format.write)(shown.bytes()),
            });
        });
        view! { <MenuItem on_choose=choose>{format.label}</MenuItem> }
    };
    let as_characters = move || {
        let text = characters(&shown.get()?)?;
        let choose = Callback::new(move |()| give(text.clone()));
        Some(view! { <MenuItem on_choose=choose>"Characters"</MenuItem> })
    };
    let as_json = Callback::new(move |()| {
        let line = |shown: Shown| json::line(&shown.report, shown.index, true);
        shown.get_untracked().map(line).into_iter().for_each(give);
    });
    view! {
        <Show when=move || shown.with(Option::is_some)>
            <Menu label="Copy as" glyph=Glyph::Copy at_end=at_end>
                {FORMATS.iter().map(entry).collect_view()}
                {move || as_characters()}
                <MenuItem on_choose=as_json>"JSON, with its fields"</MenuItem>
            </Menu>
        </Show>
    }
}

/// What stands on the line, where that is no bytes but characters.
fn characters(shown: &Shown) -> Option<String> {
    shown.telegram.choice.protocol.characters.map(|characters| characters(shown.bytes()))
}

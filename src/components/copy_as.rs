//! The telegram as text for other programs.

use leptos::prelude::*;
use leptos::task::spawn_local;

use super::copy_button::copy;
use super::icon::Glyph;
use super::menu::{Menu, MenuItem};
use super::telegram::Shown;
use super::toast::Toasts;
use crate::later;
use buslens::tool::copy::{FORMATS, Format};

/// A menu of formats, with one more where the line carries characters.
#[component]
pub fn CopyAs(shown: Shown, #[prop(optional)] at_end: bool) -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    let characters = shown.telegram.choice.protocol.characters.map(|characters| characters(shown.bytes()));
    let shown = StoredValue::new(shown);
    let characters = StoredValue::new(characters);
    let give = move |text: String| {
        spawn_local(async move {
            if copy(toasts, text).await {
                toasts.say("Copied.");
            }
        });
    };
    let entry = move |format: &'static Format| {
        // What is on the line are the characters.
        let choose = Callback::new(move |()| {
            let text = characters.with_value(|characters| match characters {
                Some(characters) => (format.write)(characters.as_bytes()),
                None => shown.with_value(|shown| (format.write)(shown.bytes())),
            });
            give(text);
        });
        view! { <MenuItem on_choose=choose>{format.label}</MenuItem> }
    };
    let as_json = Callback::new(move |()| {
        spawn_local(async move {
            match later::json(shown.get_value()).await {
                Ok(text) => give(text),
                Err(later::NotLoaded) => {
                    toasts.say("What writes JSON could not be loaded: check the connection.")
                }
            }
        });
    });
    view! {
        <Menu label="Copy as" glyph=Glyph::Copy at_end=at_end>
            {FORMATS.iter().map(entry).collect_view()}
            {move || {
                characters
                    .get_value()
                    .map(|text| {
                        let choose = Callback::new(move |()| give(text.clone()));
                        view! { <MenuItem on_choose=choose>"Characters"</MenuItem> }
                    })
            }}
            <MenuItem on_choose=as_json>"JSON, with its fields"</MenuItem>
        </Menu>
    }
}

//! The telegram as text for other programs.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use super::menu;
use crate::app::browser;
use crate::app::state::{Decoded, Shown, State};
use buslens::tool::copy::FORMATS;
use buslens::tool::json;

/// The menu of formats, with one more where the line carries characters.
pub fn copies(shown: &Shown) -> Markup {
    html! {
        details.menu {
            summary { "Copy as" }
            div.examples {
                ul {
                    @for format in FORMATS {
                        li { button type="button" data-format=(format.key) { (format.label) } }
                    }
                    @if shown.telegram.choice.protocol.characters.is_some() {
                        li { button type="button" data-format=(CHARACTERS) { "Characters" } }
                    }
                    li { button type="button" data-format=(JSON) { "JSON, with its fields" } }
                }
            }
        }
    }
}

const CHARACTERS: &str = "characters";
const JSON: &str = "json";

/// The telegram in a format, as it is on the line.
fn written(decoded: &Decoded, key: &str) -> Option<String> {
    let shown = decoded.shown.as_ref()?;
    let characters = shown.telegram.choice.protocol.characters.map(|characters| characters(shown.bytes()));
    match FORMATS.iter().find(|format| format.key == key) {
        Some(format) => match characters {
            Some(characters) => Some((format.write)(characters.as_bytes())),
            None => Some((format.write)(shown.bytes())),
        },
        None if key == CHARACTERS => characters,
        None => json::line(&decoded.report, shown.index, true).ok(),
    }
}

pub fn hear(state: State, kind: &str, event: &Event) {
    if kind == "click"
        && let Some(key) = browser::attribute(event, "data-format")
    {
        let text = state.decoded.with_untracked(|decoded| written(decoded, &key));
        browser::copy(&text.unwrap_or_default());
        browser::say("Copied.");
        menu::close(event);
    }
}

//! The telegram as text for other programs.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use super::menu;
use crate::app::browser;
use crate::app::state::State;
use crate::tool::copy::FORMATS;
use crate::tool::json;

/// The menu of formats.
pub fn copies() -> Markup {
    html! {
        details.menu {
            summary { "Copy as" }
            div.examples {
                ul {
                    @for format in FORMATS {
                        li { button type="button" data-format=(format.key) { (format.label) } }
                    }
                    li { button type="button" data-format=(JSON) { "JSON, with its fields" } }
                }
            }
        }
    }
}

const JSON: &str = "json";

pub fn hear(state: State, kind: &str, event: &Event) {
    if kind == "click"
        && let Some(key) = browser::attribute(event, "data-format")
    {
        let text = state.decoded.with_untracked(|decoded| {
            let shown = decoded.shown.as_ref()?;
            match FORMATS.iter().find(|format| format.key == key) {
                Some(format) => Some((format.write)(shown.bytes())),
                None => json::line(&decoded.report, shown.index, true).ok(),
            }
        });
        browser::copy(&text.unwrap_or_default());
        browser::say("Copied.");
        menu::close(event);
    }
}

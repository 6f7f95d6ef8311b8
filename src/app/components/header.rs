//! The line on top: name, promise, theme.

use leptos::prelude::*;
use maud::html;
use web_sys::Event;

use crate::app::browser;

/// The id of the list of themes. The boot script reads the same setting, so that the page comes up in
/// the right colours.
const THEME: &str = "theme";

#[component]
pub fn Header() -> impl IntoView {
    view! { <header class="top" inner_html=content()></header> }
}

pub fn hear(kind: &str, event: &Event) {
    if kind == "change" && browser::id(event) == THEME {
        let theme = browser::value(event);
        if let Some(root) = document().document_element() {
            let _ = root.set_attribute("data-theme", &theme);
        }
        browser::remember(THEME, &theme);
    }
}

fn content() -> String {
    let chosen = browser::remembered(THEME).unwrap_or_default();
    let markup = html! {
        h1 { "Bus" span { "lens" } }
        p.promise { "Reads field-bus telegrams. Nothing leaves this page." }
        label.theme {
            span { "Theme" }
            select id=(THEME) aria-label="Theme" {
                @for (key, label) in [("", "System"), ("light", "Light"), ("dark", "Dark")] {
                    option value=(key) selected[key == chosen] { (label) }
                }
            }
        }
    };
    markup.into_string()
}

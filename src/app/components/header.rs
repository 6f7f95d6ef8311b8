//! The line on top: name, promise, theme.

use leptos::prelude::*;
use maud::html;
use web_sys::{Element, Event};

use super::shortcuts;
use crate::app::{address, browser};

/// The id of the list of themes. The boot script reads the same setting, so that the page comes up in
/// the right colours.
const THEME: &str = "theme";

#[component]
pub fn Header(
    /// The address of the view that is shown.
    here: &'static str,
) -> impl IntoView {
    view! { <header class="top" inner_html=content(here)></header> }
}

pub fn hear(kind: &str, event: &Event) {
    shortcuts::hear(kind, event);
    if kind == "click" && browser::attribute(event, "data-link").is_some() {
        address::copy_link();
    }
    if kind == "click" && browser::closest(event, ".skip").is_some() {
        // The address holds what is shown, and so no place in the page.
        event.prevent_default();
        if let Some(main) = browser::element::<Element>("main") {
            browser::focus(&main);
        }
    }
    if kind == "change" && browser::id(event) == THEME {
        let theme = browser::value(event);
        if let Some(root) = document().document_element() {
            let _ = root.set_attribute("data-theme", &theme);
        }
        browser::remember(THEME, &theme);
    }
}

const DEVICES: &str = "devices.html";
pub const LOGS: &str = "logs.html";

/// The views, each a document of its own.
const VIEWS: [(&str, &str); 5] =
    [(".", "Decode"), (LOGS, "Logs"), ("build.html", "Build"), ("check.html", "Check"), (DEVICES, "Devices")];

fn content(here: &str) -> String {
    let chosen = browser::remembered(THEME).unwrap_or_default();
    let markup = html! {
        a.skip href="#main" { "Skip to the content" }
        h1 { "Bus" span { "lens" } }
        nav.nav aria-label="Views" {
            @for (address, label) in VIEWS {
                a href=(address) aria-current=[(address == here).then_some("page")] { (label) }
            }
        }
        p.promise { "Reads and builds field-bus telegrams. Nothing leaves this page." }
        // How devices are set up goes with the links of the other views; no link holds a log.
        @if here != DEVICES && here != LOGS { button.quiet type="button" data-link="" { "Copy link" } }
        (shortcuts::shortcuts())
        label.theme {
            span { "Theme" }
            select id=(THEME) aria-label="Theme" {
                @for (key, label) in [("", "System"), ("light", "Light"), ("dark", "Dark")] {
                    option value=(key) selected[key == chosen] { (label) }
                }
            }
        }
        p.toast id="toast" role="status" {}
    };
    markup.into_string()
}

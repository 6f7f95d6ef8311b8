//! The settings of the devices as a file.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use super::drawn;
use crate::app::browser;
use crate::app::setup::Setup;
use buslens::tool::{Settings, settings};

#[component]
pub fn DeviceFile(setup: Setup) -> impl IntoView {
    let text = drawn(move || setup.with(|kept| text(&kept.settings)));
    view! {
        <section class="card aside" aria-label="Settings as a file">
            <div inner_html=head().into_string()></div>
            <div inner_html=text></div>
        </section>
    }
}

pub fn hear(setup: Setup, kind: &str, event: &Event) {
    match (kind, browser::id(event).as_str()) {
        ("click", EXPORT) => {
            let text = setup.now(|kept| settings::write(&kept.settings));
            browser::download("buslens-devices.txt", &text);
        }
        ("click", RESET) => setup.replace(Settings::default()),
        ("change", IMPORT) => browser::read_file(event, move |name, text| match settings::read(&text) {
            Ok(settings) => {
                setup.replace(settings);
                browser::say(&format!("{name} is read: the devices are set up by it."));
            }
            Err(message) => {
                browser::say(&format!("{name} was not taken, nothing is changed. {}.", message.sentence()));
            }
        }),
        _ => {}
    }
}

const EXPORT: &str = "export";
const IMPORT: &str = "import";
const RESET: &str = "reset";

fn head() -> Markup {
    html! {
        h2 { "How your devices are set up" }
        p {
            "Some telegrams mean what a device was told before: which parameters its registers stand for, what \
             its process data carry, in which order its bytes come. Decode and Build follow what is entered here. \
             What the telegrams of a log themselves tell is learned from them, and counts more."
        }
        p { "It is kept in this browser, and goes with every link. As a file it can be sent and kept." }
        div.actions {
            button.quiet id=(EXPORT) type="button" { "Save as a file" }
            label.quiet for=(IMPORT) { "Open a file" }
            input.unseen id=(IMPORT) type="file" accept=".txt,text/plain";
            button.quiet id=(RESET) type="button" { "All as delivered" }
        }
    }
}

/// What the file would hold.
fn text(settings: &Settings) -> Markup {
    let text = settings::write(settings);
    html! {
        h3 { "Not as delivered" }
        @if settings::changed(settings).is_empty() { p { "Nothing: everything is as the devices come from their makers." } }
        @else { pre { (text) } }
    }
}

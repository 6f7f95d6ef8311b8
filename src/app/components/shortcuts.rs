//! Keys that do something, and the list of them.

use maud::{Markup, html};
use web_sys::Event;

use crate::app::browser;

/// The button that shows the list.
const BUTTON: &str = "[popovertarget]";

pub fn shortcuts() -> Markup {
    let keys = [
        ("?", "shows this list"),
        ("/", "goes to the input, or to the search of what can be built"),
        ("Tab, Shift + Tab", "go from part to part; bytes, fields and telegrams are one stop each"),
        ("Arrow keys", "go from byte to byte, from field to field, from telegram to telegram"),
        ("← →", "in fields: close and open a group"),
        ("Home, End", "go to the first and the last"),
        ("Esc", "lets go of the chosen byte, closes a menu"),
        ("Ctrl + V", "anywhere: pastes telegrams in place of the input"),
        ("Ctrl + Z", "takes back what was typed, pasted or loaded"),
        ("Alt + ←, Alt + →", "go back and forward between what was shown"),
    ];
    html! {
        button.quiet type="button" popovertarget="keys" aria-label="Keyboard shortcuts" { "?" }
        div.keys id="keys" popover="" {
            h2 { "Keyboard" }
            dl {
                @for (key, deed) in keys {
                    dt { kbd { (key) } }
                    dd { (deed) }
                }
            }
            p { "Files can be dropped anywhere on Decode." }
        }
    }
}

pub fn hear(kind: &str, event: &Event) {
    if kind != "keydown" || browser::is_field(event) {
        return;
    }
    match browser::key(event).as_str() {
        "?" => browser::click(BUTTON),
        "/" => {
            event.prevent_default();
            browser::focus_first("#input, #find, #bytes");
        }
        _ => {}
    }
}

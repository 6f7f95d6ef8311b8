//! Menus: a button that opens a list of things to do.

use leptos::wasm_bindgen::JsCast;
use web_sys::{Event, HtmlDetailsElement};

use crate::app::browser;

const MENU: &str = ".menu";

/// Closes the menu that is left, by key or by choosing something else.
pub fn hear(kind: &str, event: &Event) {
    match kind {
        "keydown" if browser::key(event) == "Escape" => close(event),
        "focusout" if !browser::stays_within(event, MENU) => close(event),
        _ => {}
    }
}

/// Closes the menu that the event is in; who used the keyboard is back at its button.
pub fn close(event: &Event) {
    if let Some(menu) = browser::closest(event, MENU) {
        if let Some(button) = menu.first_element_child().filter(|_| event.type_() == "keydown") {
            browser::focus(&button);
        }
        menu.unchecked_into::<HtmlDetailsElement>().set_open(false);
    }
}

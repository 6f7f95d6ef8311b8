//! Where somebody types.

use leptos::prelude::{document, window};
use leptos::wasm_bindgen::JsCast;
use web_sys::{Element, EventTarget, HtmlElement};

const FIELD: &str = "input:not([type=checkbox], [type=radio], [type=range], [type=file])";

/// Whether text is typed into the element of an event: keys and what is pasted are meant for it then.
pub fn is_typed_into(target: Option<EventTarget>) -> bool {
    let element = target.and_then(|target| target.dyn_into::<Element>().ok());
    let field = format!("textarea, select, {FIELD}");
    element.is_some_and(|element| element.closest(&field).ok().flatten().is_some())
}

/// Goes to the first field of the view, which is what somebody types into first.
pub fn go_to_field() {
    focus(&format!("main :is(textarea, {FIELD})"));
}

/// Where what had the focus is gone, the next Tab leads to what came in its place.
pub fn find_focus() {
    if document().active_element().is_none_or(|element| element.tag_name() == "BODY") {
        // The view as a whole, and what is seen of it stays.
        let top = window().scroll_y().unwrap_or_default();
        focus("main");
        window().scroll_to_with_x_and_y(0.0, top);
    }
}

fn focus(selector: &str) {
    let element = document().query_selector(selector).ok().flatten();
    if let Some(element) = element.and_then(|element| element.dyn_into::<HtmlElement>().ok()) {
        let _ = element.focus();
    }
}

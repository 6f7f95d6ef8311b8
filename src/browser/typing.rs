//! Where somebody types.

use leptos::wasm_bindgen::JsCast;
use web_sys::{Element, EventTarget};

/// Whether text is typed into the element of an event: keys and what is pasted are meant for it then.
pub fn is_typed_into(target: Option<EventTarget>) -> bool {
    let element = target.and_then(|target| target.dyn_into::<Element>().ok());
    let field = "textarea, select, input:not([type=checkbox], [type=radio], [type=range], [type=file])";
    element.is_some_and(|element| element.closest(field).ok().flatten().is_some())
}

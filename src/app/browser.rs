//! What the browser is asked for, besides showing the page.

use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{HtmlDocument, HtmlElement, HtmlTextAreaElement};

/// A panic ends the page's program: says so, and that the input can still be copied.
pub fn tell_of_panics() {
    std::panic::set_hook(Box::new(|panic| {
        web_sys::console::error_1(&panic.to_string().into());
        let told = document().create_element("p").and_then(|note| {
            note.set_class_name("ended");
            note.set_attribute("role", "alert")?;
            note.set_text_content(Some(
                "Something in Buslens broke, and the page has stopped. Your input is still in its box: \
                 copy it, then reload the page. Please report the input that led to this.",
            ));
            document().body().map(|body| body.prepend_with_node_1(&note)).transpose()
        });
        drop(told);
    }));
}

/// Keeps a small setting in the browser, where the browser allows that.
pub fn remember(key: &str, value: &str) {
    if let Ok(Some(storage)) = window().local_storage() {
        // A full or forbidden storage only means that the setting is gone at the next visit.
        let _ = storage.set_item(key, value);
    }
}

/// A setting kept by [`remember`].
pub fn remembered(key: &str) -> Option<String> {
    window().local_storage().ok()??.get_item(key).ok()?
}

/// Copies `text`; the clipboard of the browser is missing where the page comes over plain http.
pub fn copy(text: &str) {
    let clipboard = window().navigator().clipboard();
    if clipboard.is_undefined() {
        copy_by_selection(text);
    } else {
        // A browser that forbids it shows that itself.
        let _ = clipboard.write_text(text);
    }
}

fn copy_by_selection(text: &str) {
    let Ok(area) = document().create_element("textarea") else { return };
    let area: HtmlTextAreaElement = area.unchecked_into();
    area.set_value(text);
    area.set_class_name("unseen");
    if let Some(body) = document().body() {
        let _ = body.append_child(&area);
        area.select();
        let _ = document().unchecked_into::<HtmlDocument>().exec_command("copy");
        area.remove();
    }
}

/// Puts `text` in place of what `area` holds, in a way that the browser's undo takes back.
pub fn replace_undoably(area: &HtmlTextAreaElement, text: &str) {
    let _ = area.focus();
    area.select();
    let replaced = document()
        .unchecked_into::<HtmlDocument>()
        .exec_command_with_show_ui_and_value("insertText", false, text)
        .unwrap_or(false);
    if !replaced {
        area.set_value(text);
    }
    let _ = area.set_selection_range(0, 0);
    area.set_scroll_top(0);
}

/// The closest element at or above the event's target that `selector` fits.
pub fn closest(event: &web_sys::Event, selector: &str) -> Option<HtmlElement> {
    let target: web_sys::Element = event.target()?.dyn_into().ok()?;
    target.closest(selector).ok()??.dyn_into().ok()
}

/// The number in the attribute `name` of the element that `event` is about.
pub fn number_at(event: &web_sys::Event, name: &str) -> Option<usize> {
    closest(event, &format!("[{name}]"))?.get_attribute(name)?.parse().ok()
}

/// Moves the focus to the element with `id`.
pub fn focus(id: &str) {
    if let Some(element) = document().get_element_by_id(id)
        && let Ok(element) = element.dyn_into::<HtmlElement>()
    {
        let _ = element.focus();
    }
}

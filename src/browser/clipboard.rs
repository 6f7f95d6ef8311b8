//! The clipboard.

use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use wasm_bindgen_futures::JsFuture;
use web_sys::{HtmlDocument, HtmlTextAreaElement};

/// The browser did not copy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused;

/// Puts `text` on the clipboard.
pub async fn write(text: &str) -> Result<(), Refused> {
    let clipboard = window().navigator().clipboard();
    // It is missing where the page comes over plain http.
    if clipboard.is_undefined() {
        return if write_by_selection(text) { Ok(()) } else { Err(Refused) };
    }
    match JsFuture::from(clipboard.write_text(text)).await {
        Ok(_) => Ok(()),
        Err(_) if write_by_selection(text) => Ok(()),
        Err(_) => Err(Refused),
    }
}

/// The old way, for which the text must stand in the page.
fn write_by_selection(text: &str) -> bool {
    let area =
        document().create_element("textarea").ok().and_then(|it| it.dyn_into::<HtmlTextAreaElement>().ok());
    let (Some(area), Some(body)) = (area, document().body()) else { return false };
    // The focus goes back to where it was.
    let before = document().active_element().and_then(|it| it.dyn_into::<web_sys::HtmlElement>().ok());
    area.set_value(text);
    area.set_class_name("unseen");
    if body.append_child(&area).is_err() {
        return false;
    }
    area.select();
    let done = document().unchecked_into::<HtmlDocument>().exec_command("copy").unwrap_or(false);
    area.remove();
    if let Some(before) = before {
        let _ = before.focus();
    }
    done
}

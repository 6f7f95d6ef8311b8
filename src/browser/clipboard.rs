//! The clipboard.

use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use wasm_bindgen_futures::JsFuture;
use web_sys::js_sys::{Array, Object, Reflect};
use web_sys::{Blob, BlobPropertyBag, ClipboardItem, HtmlDocument, HtmlTextAreaElement};

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

/// Puts a text on the clipboard as it is and as HTML: what it is pasted into takes what it can show.
pub async fn write_both(text: &str, html: &str) -> Result<(), Refused> {
    let clipboard = window().navigator().clipboard();
    if clipboard.is_undefined() {
        return write(text).await;
    }
    let kinds = Object::new();
    for (kind, content) in [("text/plain", text), ("text/html", html)] {
        let bag = BlobPropertyBag::new();
        bag.set_type(kind);
        let parts = Array::of1(&content.into());
        let Ok(blob) = Blob::new_with_str_sequence_and_options(&parts, &bag) else { return Err(Refused) };
        let _ = Reflect::set(&kinds, &kind.into(), &blob);
    }
    let Ok(item) = ClipboardItem::new_with_record_from_str_to_blob_promise(&kinds) else {
        return write(text).await;
    };
    match JsFuture::from(clipboard.write(&Array::of1(&item))).await {
        Ok(_) => Ok(()),
        // Without its looks is better than not at all.
        Err(_) => write(text).await,
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

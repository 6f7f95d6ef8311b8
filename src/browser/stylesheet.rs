//! The stylesheet of what comes later.

use leptos::prelude::document;
use wasm_bindgen_futures::JsFuture;
use web_sys::js_sys::Promise;

use super::edition;

/// Puts it into the document, and says whether it is there: what it is for should not flash without it.
pub async fn load_later() -> bool {
    // The page as one file has all of it from the start.
    let Some(address) = edition::later_style() else { return true };
    let put = || {
        let link = document().create_element("link").ok()?;
        link.set_attribute("rel", "stylesheet").ok()?;
        link.set_attribute("href", &address).ok()?;
        let loaded = Promise::new(&mut |there, gone| {
            let _ = link.add_event_listener_with_callback("load", &there);
            let _ = link.add_event_listener_with_callback("error", &gone);
        });
        document().query_selector("head").ok()??.append_child(&link).ok()?;
        Some((link, loaded))
    };
    let Some((link, loaded)) = put() else { return false };
    let there = JsFuture::from(loaded).await.is_ok();
    if !there {
        // The next attempt brings another.
        link.remove();
    }
    there
}

//! The stylesheet of what comes later.

use leptos::prelude::document;
use wasm_bindgen_futures::JsFuture;
use web_sys::js_sys::{Promise, Reflect};

use super::edition;

/// Puts it into the document, and says whether it is there: what it is for should not flash without it.
pub async fn load_later() -> bool {
    // The page as one file has all of it from the start.
    let Some(address) = edition::later_style() else { return true };
    let put = || {
        // Two parts of the page may ask for it.
        let known = document().query_selector(&format!("link[rel=stylesheet][href='{address}']")).ok()?;
        let link = match known {
            Some(link) => link,
            None => document().create_element("link").ok()?,
        };
        let loaded = Promise::new(&mut |there, gone| {
            // It has a sheet once it is loaded.
            if Reflect::get(&link, &"sheet".into()).is_ok_and(|sheet| sheet.is_object()) {
                let _ = there.call0(&link);
            }
            let _ = link.add_event_listener_with_callback("load", &there);
            let _ = link.add_event_listener_with_callback("error", &gone);
        });
        if !link.is_connected() {
            link.set_attribute("rel", "stylesheet").ok()?;
            link.set_attribute("href", &address).ok()?;
            document().query_selector("head").ok()??.append_child(&link).ok()?;
        }
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

//! What the browser keeps for the next visit.

use leptos::ev;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use web_sys::{DomException, Storage};

/// Why something is not kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotKept {
    /// The browser keeps nothing for this page: by its settings, or in a private window.
    Denied,
    /// There is no room left.
    Full,
}

impl NotKept {
    /// In a sentence.
    pub const fn sentence(self) -> &'static str {
        match self {
            Self::Denied => "This browser keeps nothing for this page: it is gone after a reload.",
            Self::Full => "This browser has no room left for this page: it is gone after a reload.",
        }
    }
}

/// Keeps `value` under a key.
pub fn keep(key: &str, value: &str) -> Result<(), NotKept> {
    let storage = storage().ok_or(NotKept::Denied)?;
    storage.set_item(&name(key), value).map_err(|error| match error.dyn_ref::<DomException>() {
        Some(error) if error.name() == "QuotaExceededError" => NotKept::Full,
        _ => NotKept::Denied,
    })
}

/// What is kept under a key.
pub fn kept(key: &str) -> Option<String> {
    storage()?.get_item(&name(key)).ok()?
}

/// Keeps `value` for this tab alone, which is about to be loaded anew: what is kept for all tabs may be of
/// another one.
pub fn keep_for_reload(key: &str, value: &str) -> Result<(), NotKept> {
    let storage = window().session_storage().ok().flatten().ok_or(NotKept::Denied)?;
    storage.set_item(&name(key), value).map_err(|_| NotKept::Full)
}

/// What was kept for this tab, once.
pub fn kept_for_reload(key: &str) -> Option<String> {
    let storage = window().session_storage().ok()??;
    let kept = storage.get_item(&name(key)).ok()??;
    let _ = storage.remove_item(&name(key));
    Some(kept)
}

/// Calls `changed` with the new value whenever another tab keeps something else under the key.
pub fn on_change(key: &'static str, changed: impl Fn(Option<String>) + 'static) {
    let listener = window_event_listener(ev::storage, move |event| match event.key() {
        Some(changed_key) if changed_key == name(key) => changed(event.new_value()),
        // All of it was cleared.
        None => changed(None),
        Some(_) => {}
    });
    Owner::on_cleanup(move || listener.remove());
}

fn storage() -> Option<Storage> {
    window().local_storage().ok()?
}

fn name(key: &str) -> String {
    format!("buslens.{key}")
}

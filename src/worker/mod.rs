//! Reading logs of any size, without making the page wait.
//!
//! Large files are read by a worker: the page's module started once more, without a page. Small ones are
//! read where the page is. Both are the same `reader`, asked and answered in the same `messages`. For very large ones
//! the worker starts `others`, each of which reads a slice. All of it is in the part of the module that comes after the
//! first view.

pub mod client;
mod mail;
pub mod messages;
mod others;
mod reader;
mod serve;
mod started;

use wasm_bindgen::{JsCast, JsValue};
// Leptos has no executor where nothing is mounted.
use wasm_bindgen_futures::spawn_local;
use web_sys::{DedicatedWorkerGlobalScope, js_sys};

use crate::later;

pub use serve::serve;

/// Whether this module runs as a worker.
pub fn is_worker() -> bool {
    js_sys::global().dyn_ref::<DedicatedWorkerGlobalScope>().is_some()
}

/// Starts the worker: it answers once its part of the module is loaded.
pub fn start() {
    spawn_local(async {
        if later::serve_logs().await.is_err() {
            let scope: DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
            // No message of ours: the page takes it for a worker that failed.
            let _ = scope.post_message(&JsValue::NULL);
        }
    });
}

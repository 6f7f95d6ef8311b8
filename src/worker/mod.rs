//! Reading logs of any size, without making the page wait.
//!
//! Large files are read by a worker: the page's module started once more, without a page. Small ones are
//! read where the page is. Both are the same `reader`, asked and answered in the same `messages`.

pub mod client;
mod mail;
pub mod messages;
mod reader;
mod serve;

use wasm_bindgen::JsCast;
use web_sys::{DedicatedWorkerGlobalScope, js_sys};

pub use serve::serve;

/// Whether this module runs as a worker.
pub fn is_worker() -> bool {
    js_sys::global().dyn_ref::<DedicatedWorkerGlobalScope>().is_some()
}

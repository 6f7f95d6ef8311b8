//! The worker: the page's module started once more, without a page, to read large files beside it.

use wasm_bindgen::JsCast;
use web_sys::{DedicatedWorkerGlobalScope, js_sys};

/// Whether this module runs as a worker.
pub fn is_worker() -> bool {
    js_sys::global().dyn_ref::<DedicatedWorkerGlobalScope>().is_some()
}

pub fn serve() {}

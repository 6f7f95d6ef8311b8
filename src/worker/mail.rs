//! Messages between page and worker: their bytes, and at most one thing of the browser beside them.

use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::js_sys::{Array, Uint8Array};

/// A message as it is posted.
pub fn write(message: &impl Serialize, beside: &JsValue) -> Option<JsValue> {
    let bytes = postcard::to_allocvec(message).ok()?;
    Some(Array::of2(&Uint8Array::from(&bytes[..]), beside).into())
}

/// What [`write()`] wrote, and what was beside it.
pub fn read<T: DeserializeOwned>(mail: &JsValue) -> Option<(T, JsValue)> {
    let mail = mail.dyn_ref::<Array>()?;
    let bytes = mail.get(0).dyn_into::<Uint8Array>().ok()?.to_vec();
    Some((postcard::from_bytes(&bytes).ok()?, mail.get(1)))
}

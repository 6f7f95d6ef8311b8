//! The file that was opened last, kept in the browser so that a reload brings it back.

use leptos::prelude::window;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::JsFuture;
use web_sys::js_sys::Promise;
use web_sys::{Blob, IdbDatabase, IdbObjectStore, IdbOpenDbRequest, IdbRequest, IdbTransactionMode};

const DATABASE: &str = "buslens";
const STORE: &str = "files";

/// Keeps a file under `key` in the place of the one before; whether the browser did it.
pub async fn keep(key: &str, file: &Blob) -> bool {
    let Some(store) = store(IdbTransactionMode::Readwrite).await else { return false };
    let _ = store.clear();
    match store.put_with_key(file, &key.into()) {
        Ok(request) => done(&request).await.is_some(),
        Err(_) => false,
    }
}

/// What was kept under `key`, if it is still there.
pub async fn kept(key: &str) -> Option<Blob> {
    let store = store(IdbTransactionMode::Readonly).await?;
    done(&store.get(&key.into()).ok()?).await?.dyn_into().ok()
}

async fn store(mode: IdbTransactionMode) -> Option<IdbObjectStore> {
    // A browser that keeps nothing has none, or refuses to look.
    let opening: IdbOpenDbRequest = window().indexed_db().ok()??.open_with_u32(DATABASE, 1).ok()?;
    let request = opening.clone();
    let make = Closure::once_into_js(move || {
        if let Ok(database) = request.result().and_then(JsCast::dyn_into::<IdbDatabase>) {
            let _ = database.create_object_store(STORE);
        }
    });
    opening.set_onupgradeneeded(Some(make.unchecked_ref()));
    let database: IdbDatabase = done(&opening).await?.dyn_into().ok()?;
    database.transaction_with_str_and_mode(STORE, mode).ok()?.object_store(STORE).ok()
}

/// Waits for the result of a request.
async fn done(request: &IdbRequest) -> Option<JsValue> {
    let waited = Promise::new(&mut |resolve, reject| {
        request.set_onsuccess(Some(&resolve));
        request.set_onerror(Some(&reject));
    });
    JsFuture::from(waited).await.ok()?;
    request.result().ok()
}

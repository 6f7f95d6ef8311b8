//! A worker as whoever started it has it.

use std::rc::Rc;

use wasm_bindgen::closure::Closure;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Event, MessageEvent, Worker};

#[wasm_bindgen]
extern "C" {
    /// Only the boot script knows where the module is: in files of a server, or in the document.
    #[wasm_bindgen(js_name = startWorker, catch)]
    fn start_worker() -> Result<Worker, JsValue>;
}

/// A worker. Dropping it ends it, which what it says may not do: that is still being told then.
pub struct Started {
    worker: Worker,
    /// They live as long as it does.
    _hear: Closure<dyn Fn(MessageEvent)>,
    _fail: Closure<dyn Fn(Event)>,
}

impl Drop for Started {
    fn drop(&mut self) {
        self.worker.set_onmessage(None);
        self.worker.set_onerror(None);
        self.end();
    }
}

impl Started {
    /// Starts the module of the page once more, if this browser can. `hear` is told what it says, and null, which is no
    /// message of ours, if it fails.
    pub fn start(hear: impl Fn(&JsValue) + 'static) -> Option<Self> {
        let worker = start_worker().ok()?;
        let hear = Rc::new(hear);
        let told = hear.clone();
        let hear = Closure::<dyn Fn(MessageEvent)>::new(move |event: MessageEvent| hear(&event.data()));
        let fail = Closure::<dyn Fn(Event)>::new(move |event: Event| {
            event.prevent_default();
            told(&JsValue::NULL);
        });
        worker.set_onmessage(Some(hear.as_ref().unchecked_ref()));
        worker.set_onerror(Some(fail.as_ref().unchecked_ref()));
        Some(Self { worker, _hear: hear, _fail: fail })
    }

    /// Sends it a message; nothing if that cannot be sent.
    pub fn post(&self, mail: &JsValue) -> Option<()> {
        self.worker.post_message(mail).ok()
    }

    /// Ends it, whoever still holds it.
    pub fn end(&self) {
        self.worker.terminate();
    }
}

//! Another worker, which reads a slice of a large file for the first one.

use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::js_sys::BigUint64Array;
use web_sys::{Blob, Event, MessageEvent, Worker};

use super::messages::{Answer, Request, Share};
use super::{mail, serve, start_worker};
use buslens::tool::log::Slice;

/// A worker with its slice.
pub struct Other {
    worker: Worker,
    /// What it is to read: it is told when it can hear.
    share: JsValue,
    from: u64,
    /// `None` if it failed.
    slice: Option<Slice>,
    /// They live as long as it does.
    _hear: Closure<dyn Fn(MessageEvent)>,
    _fail: Closure<dyn Fn(Event)>,
}

impl Drop for Other {
    fn drop(&mut self) {
        self.worker.set_onmessage(None);
        self.worker.set_onerror(None);
        self.worker.terminate();
    }
}

impl Other {
    /// Starts it, if this browser can: what it says is heard by these numbers.
    pub fn start(turn: u32, index: usize, share: Share, file: &Blob) -> Option<Self> {
        let from = share.slice.start;
        let share = mail::write(&Request::Read(share), file)?;
        let worker = start_worker().ok()?;
        let hear = Closure::<dyn Fn(MessageEvent)>::new(move |event: MessageEvent| {
            serve::heard(turn, index, &event.data());
        });
        let fail = Closure::<dyn Fn(Event)>::new(move |event: Event| {
            event.prevent_default();
            serve::heard(turn, index, &JsValue::NULL);
        });
        worker.set_onmessage(Some(hear.as_ref().unchecked_ref()));
        worker.set_onerror(Some(fail.as_ref().unchecked_ref()));
        let slice = Some(Slice::default());
        Some(Self { worker, share, from, slice, _hear: hear, _fail: fail })
    }

    /// Hears what it says.
    pub fn hear(&mut self, mail: &JsValue) {
        let heard = match mail::read(mail) {
            Some((Answer::Hello, _)) => self.worker.post_message(&self.share).ok(),
            Some((Answer::Found, words)) => self.take(words),
            _ => None,
        };
        if heard.is_none() {
            // It failed, or there is no memory for what it finds: its slice is read by the first one.
            self.worker.terminate();
            self.slice = None;
        }
    }

    fn take(&mut self, words: JsValue) -> Option<()> {
        let words = words.dyn_into::<BigUint64Array>().ok()?.to_vec();
        self.slice.as_mut()?.take(&words).then_some(())
    }

    /// Whether it is not through with its slice.
    pub fn reads(&self) -> bool {
        self.slice.as_ref().is_some_and(|slice| !slice.is_whole())
    }

    /// How many bytes it has read.
    pub fn done(&self) -> u64 {
        self.slice.as_ref().map_or(0, |slice| slice.taken().saturating_sub(self.from))
    }

    pub fn telegrams(&self) -> u64 {
        self.slice.as_ref().map_or(0, Slice::telegrams)
    }

    /// What it found, if it did not fail.
    pub fn into_slice(mut self) -> Option<Slice> {
        self.slice.take()
    }
}

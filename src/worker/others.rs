//! Another worker, which reads a slice of a large file for the first one.

use wasm_bindgen::{JsCast, JsValue};
use web_sys::Blob;
use web_sys::js_sys::BigUint64Array;

use super::messages::{Answer, Request, Share};
use super::started::Started;
use super::{mail, serve};
use buslens::tool::log::Slice;

/// A worker with its slice.
pub struct Other {
    worker: Started,
    /// What it is to read: it is told when it can hear.
    share: JsValue,
    from: u64,
    /// `None` if it failed.
    slice: Option<Slice>,
}

impl Other {
    /// Starts it, if this browser can: what it says is heard by these numbers.
    pub fn start(turn: u32, index: usize, share: Share, file: &Blob) -> Option<Self> {
        let from = share.slice.start;
        let share = mail::write(&Request::Read(share), file)?;
        let worker = Started::start(move |mail| serve::heard(turn, index, mail))?;
        Some(Self { worker, share, from, slice: Some(Slice::default()) })
    }

    /// Hears what it says.
    pub fn hear(&mut self, mail: &JsValue) {
        let heard = match mail::read(mail) {
            Some((Answer::Hello, _)) => self.worker.post(&self.share),
            Some((Answer::Found, words)) => self.take(words),
            _ => None,
        };
        if heard.is_none() {
            // It failed, or there is no memory for what it finds: its slice is read by the first one.
            self.worker.end();
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

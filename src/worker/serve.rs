//! The worker's end: it reads the file in parts and answers what the page asks.

use std::cell::RefCell;

use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
// Leptos has no executor where nothing is mounted.
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::js_sys::{Array, Uint8Array, global};
use web_sys::{Blob, DedicatedWorkerGlobalScope, FileReaderSync, MessageEvent};

use super::mail;
use super::messages::{Answer, How, Request};
use super::reader::Reader;
use crate::browser::file;
use buslens::tool::log::{BEGINNING, Log, SMALL, Source};

/// What is read at a time.
const PIECE: u64 = 4 << 20;

/// What is read at first, so that there is something to see at once.
const FIRST: u64 = 1 << 20;

thread_local! {
    static DESK: RefCell<Desk> = RefCell::default();
}

/// What the worker holds.
#[derive(Default)]
struct Desk {
    reader: Option<Reader<File>>,
    /// The file is read: what goes out has all of it.
    complete: bool,
    /// What waits until it is.
    waiting: Vec<Request>,
    /// Counts what was opened: a reading that is not the latest gives up.
    turn: u32,
    stopped: bool,
}

/// A file that can be read at any place.
#[derive(Clone)]
struct File(Blob);

impl File {
    fn size(&self) -> u64 {
        self.0.size() as u64
    }

    fn slice(&self, from: u64, length: u64) -> Option<Blob> {
        let to = (from + length).min(self.size());
        self.0.slice_with_f64_and_f64(from as f64, to as f64).ok()
    }

    /// Begins to read, which makes nobody wait: messages come in meanwhile.
    fn part(&self, from: u64, length: u64) -> Option<JsFuture> {
        Some(JsFuture::from(self.slice(from, length)?.array_buffer()))
    }
}

impl Source for File {
    fn read(&self, from: u64, length: usize) -> Vec<u8> {
        let read = || {
            let slice = self.slice(from, length as u64)?;
            let buffer = FileReaderSync::new().ok()?.read_as_array_buffer(&slice).ok()?;
            Some(Uint8Array::new(&buffer).to_vec())
        };
        read().unwrap_or_else(|| {
            // Of a small one only the places of bytes in their lines are read again: they are not marked then.
            if self.size() > SMALL {
                let why = "The file was changed or moved since it was opened: what its telegrams say is not known any \
                           more.";
                tell(&Answer::Lost(why.to_owned()));
            }
            Vec::new()
        })
    }
}

/// Waits for what the page asks.
pub fn serve() {
    std::panic::set_hook(Box::new(|panic| web_sys::console::error_1(&panic.to_string().into())));
    let hear = Closure::<dyn Fn(MessageEvent)>::new(|event: MessageEvent| {
        if let Some((request, beside)) = mail::read(&event.data()) {
            hear(request, beside);
        }
    });
    scope().set_onmessage(Some(hear.into_js_value().unchecked_ref()));
    tell(&Answer::Hello);
}

fn scope() -> DedicatedWorkerGlobalScope {
    global().unchecked_into()
}

fn tell(answer: &Answer) {
    tell_with(answer, &JsValue::UNDEFINED);
}

fn tell_with(answer: &Answer, beside: &JsValue) {
    if let Some(mail) = mail::write(answer, beside) {
        // A page that is gone hears nothing.
        let _ = scope().post_message(&mail);
    }
}

fn hear(request: Request, beside: JsValue) {
    match request {
        Request::Open(how) => {
            let Ok(blob) = beside.dyn_into::<Blob>() else { return };
            let turn = DESK.with_borrow_mut(|desk| {
                desk.turn += 1;
                *desk = Desk { turn: desk.turn, ..Desk::default() };
                desk.turn
            });
            spawn_local(open(turn, File(blob), how));
        }
        Request::Stop => DESK.with_borrow_mut(|desk| desk.stopped = true),
        Request::Export { .. } | Request::PassOn(_) if DESK.with_borrow(|desk| !desk.complete) => {
            DESK.with_borrow_mut(|desk| desk.waiting.push(request));
        }
        Request::Export { kind, notes } => DESK.with_borrow(|desk| {
            let Some(reader) = &desk.reader else { return };
            let parts = Array::new();
            reader.export(kind, &notes, &mut |part| _ = parts.push(&Uint8Array::from(part)));
            if let Some(blob) = file::blob(&parts, kind.file().1) {
                tell_with(&Answer::Exported(kind), &blob);
            }
        }),
        Request::PassOn(hidden) => DESK.with_borrow(|desk| {
            let Some(reader) = &desk.reader else { return };
            let (file, passed) = reader.pass_on(&hidden);
            if let Some(blob) = file::blob(&Array::of1(&Uint8Array::from(file.as_slice())), "") {
                tell_with(&Answer::PassedOn(passed), &blob);
            }
        }),
        request => DESK.with_borrow_mut(|desk| {
            if let Some(reader) = &mut desk.reader {
                reader.answer(&request).iter().for_each(tell);
            }
        }),
    }
}

/// Reads a file from its beginning to its end.
async fn open(turn: u32, file: File, how: How) {
    let size = file.size();
    let gone = || {
        Answer::Refused(
            "The file cannot be read: it was changed, moved, or is a folder. Open it again.".into(),
        )
    };
    let mut part = Vec::new();
    if !come(file.part(0, BEGINNING as u64), &mut part).await {
        return tell(&gone());
    }
    let log = match Log::open(&part, size, &how.reading(), how.options()) {
        Ok(log) => log,
        Err(refusal) => return tell(&Answer::Refused(refusal.to_string())),
    };
    // From now on it is asked while it reads.
    let reader = Reader::new(log, file.clone(), size);
    if !DESK.with_borrow_mut(|desk| desk.turn == turn && desk.reader.replace(reader).is_none()) {
        return;
    }
    let mut at = 0;
    let mut next = file.part(0, FIRST);
    while at < size {
        if !come(next, &mut part).await {
            return tell(&gone());
        }
        at += part.len() as u64;
        // The browser reads the next part while this one is taken.
        next = file.part(at, PIECE);
        match DESK.with_borrow_mut(|desk| desk.take(turn, &part, at)) {
            Some(true) => {}
            Some(false) => break,
            None => return,
        }
    }
    let waiting = DESK.with_borrow_mut(|desk| desk.finish(turn));
    waiting.into_iter().for_each(|request| hear(request, JsValue::UNDEFINED));
}

impl Desk {
    /// Takes the part of the file that ends at `at`; `None` if another one was opened meanwhile, and `false` if
    /// this is all that is to be read.
    fn take(&mut self, turn: u32, part: &[u8], at: u64) -> Option<bool> {
        let reader = self.reader.as_mut().filter(|_| self.turn == turn)?;
        let room = reader.take(part);
        tell(&Answer::Progress { done: at as f64, telegrams: reader.telegrams() });
        reader.growing().iter().for_each(tell);
        Some(room && !self.stopped && !part.is_empty())
    }

    /// The file is read; returns what waited for that.
    fn finish(&mut self, turn: u32) -> Vec<Request> {
        let Some(reader) = self.reader.as_mut().filter(|_| self.turn == turn) else { return Vec::new() };
        reader.finish(&mut |answer| tell(&answer));
        self.complete = true;
        std::mem::take(&mut self.waiting)
    }
}

/// Waits for a part of a file, and puts it into `part`, whose room is used again and again.
async fn come(next: Option<JsFuture>, part: &mut Vec<u8>) -> bool {
    let Some(next) = next else { return false };
    let Ok(buffer) = next.await else { return false };
    let bytes = Uint8Array::new(&buffer);
    part.resize(bytes.length() as usize, 0);
    bytes.copy_to(part);
    true
}

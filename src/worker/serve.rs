//! The worker's end: it reads the file in parts and answers what the page asks.

use std::cell::RefCell;
use std::ops::Range;

use gloo_timers::callback::Timeout;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
// Leptos has no executor where nothing is mounted.
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::js_sys::{Array, BigUint64Array, Function, Promise, Uint8Array, global};
use web_sys::{Blob, DedicatedWorkerGlobalScope, FileReaderSync, MessageEvent};

use super::mail;
use super::messages::{Answer, How, Request, Share};
use super::others::Other;
use super::reader::Reader;
use crate::browser::file;
use buslens::tool::log::{BEGINNING, Division, Log, SMALL, Slice, Source};

/// What is read at a time.
const PIECE: u64 = 4 << 20;

/// What is read at first, so that there is something to see at once.
const FIRST: u64 = 1 << 20;

/// When all other workers say nothing for so long, in milliseconds, they are waited for no more: a browser that is
/// short of memory may end one without a word. The page waits longer for this one.
const PATIENCE: u32 = 15_000;

/// A slice for another worker has so many bytes at least.
const LEAST: u64 = 32 << 20;

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
    /// How many workers may read.
    cores: usize,
    /// Where the slice of this worker ends, if others read, too.
    own: Option<u64>,
    others: Vec<Other>,
    /// What they have read.
    slices: Vec<Slice>,
    /// To be called when there is something new of them.
    heard: Option<Function>,
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

/// Tells whoever joins them what was found.
fn tell_found(piece: &[u64]) {
    let words = BigUint64Array::from(piece);
    if let Some(mail) = mail::write(&Answer::Found, &words) {
        let _ = scope().post_message_with_transfer(&mail, &Array::of1(&words.buffer()));
    }
}

fn hear(request: Request, beside: JsValue) {
    match request {
        Request::Open(how, cores) => {
            let Ok(blob) = beside.dyn_into::<Blob>() else { return };
            let turn = DESK.with_borrow_mut(|desk| {
                desk.turn += 1;
                *desk = Desk { turn: desk.turn, cores, ..Desk::default() };
                desk.turn
            });
            spawn_local(open(turn, File(blob), how));
        }
        Request::Read(share) => {
            if let Ok(blob) = beside.dyn_into::<Blob>() {
                spawn_local(read(File(blob), share));
            }
        }
        Request::Stop => DESK.with_borrow_mut(|desk| {
            desk.stopped = true;
            desk.wake();
        }),
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
    let mut parts = Parts::of(file.clone(), 0);
    if !parts.next(BEGINNING as u64).await {
        return tell(&gone());
    }
    let log = match Log::open(&parts.part, size, &how.reading(), how.options()) {
        Ok(log) if size > SMALL => log.divided(Division::default()),
        Ok(log) => log,
        Err(refusal) => return tell(&Answer::Refused(refusal.to_string())),
    };
    // From now on it is asked while it reads.
    let reader = Reader::new(log, file.clone(), size);
    if !DESK.with_borrow_mut(|desk| desk.turn == turn && desk.reader.replace(reader).is_none()) {
        return;
    }
    let mut parts = Parts::of(file.clone(), 0);
    loop {
        match DESK.with_borrow_mut(|desk| desk.step(turn, size)) {
            Step::Read(to) => {
                if !parts.next(to).await {
                    return tell(&gone());
                }
                DESK.with_borrow_mut(|desk| desk.take(turn, &parts.part, &file, &how));
            }
            Step::Wait => {
                let heard =
                    Promise::new(&mut |heard, _| DESK.with_borrow_mut(|desk| desk.heard = Some(heard)));
                let given_up = Timeout::new(PATIENCE, || {
                    DESK.with_borrow_mut(|desk| {
                        desk.others.clear();
                        desk.wake();
                    });
                });
                // It cannot fail.
                let _ = JsFuture::from(heard).await;
                drop(given_up);
            }
            Step::Finish => break,
            Step::Leave => return,
        }
    }
    let waiting = DESK.with_borrow_mut(|desk| desk.finish(turn));
    waiting.into_iter().for_each(|request| hear(request, JsValue::UNDEFINED));
}

/// Reads a slice for another worker.
async fn read(file: File, share: Share) {
    let Share { how, beginning, slice } = share;
    if read_slice(file, how, beginning, slice).await.is_none() {
        // Whoever waits for it reads the slice itself.
        tell(&Answer::Refused(String::new()));
    }
}

async fn read_slice(file: File, how: How, beginning: u64, slice: Range<u64>) -> Option<()> {
    let size = file.size();
    let first = file.read(0, beginning as usize);
    let log = Log::open(first.get(..BEGINNING)?, size, &how.reading(), how.options()).ok()?;
    let mut log = log.divided(Division::default());
    log.push(&first);
    drop(first);
    let mut parts = Parts::of(file, log.jump(slice.start));
    while parts.at < slice.end {
        if !parts.next(slice.end).await || parts.part.is_empty() || !log.push(&parts.part) {
            return None;
        }
        tell_found(&log.hand_over());
    }
    tell_found(&log.hand_over_rest(size));
    Some(())
}

/// What comes next.
enum Step {
    /// Reads on, up to there at most.
    Read(u64),
    /// Waits for what others read.
    Wait,
    Finish,
    /// Another file was opened meanwhile.
    Leave,
}

impl Desk {
    /// What the reading with this number, of a file of so many bytes, does next.
    fn step(&mut self, turn: u32, size: u64) -> Step {
        let Some(reader) = self.reader.as_mut().filter(|_| self.turn == turn) else { return Step::Leave };
        let log = reader.log();
        if self.stopped || log.taken() == size {
            self.others.clear();
            return Step::Finish;
        }
        let own = self.own.unwrap_or(size);
        if log.taken() < own {
            return Step::Read(own);
        }
        if self.others.iter().any(Other::reads) {
            return Step::Wait;
        }
        self.slices.extend(self.others.drain(..).filter_map(Other::into_slice));
        if log.join(&mut self.slices, size) {
            return Step::Finish;
        }
        // What nobody read, or read in another way, is read here.
        Step::Read(if self.slices.is_empty() { size } else { log.next_mark().min(size) })
    }

    /// Takes the next part of the file.
    fn take(&mut self, turn: u32, part: &[u8], file: &File, how: &How) {
        let Some(reader) = self.reader.as_mut().filter(|_| self.turn == turn) else { return };
        let room = reader.log().push(part);
        self.stopped |= !room || part.is_empty();
        let slices = reader.log().slices(file.size(), self.cores, LEAST);
        let beginning = reader.log().taken();
        if let [own, others @ ..] = &slices[..]
            && !others.is_empty()
        {
            self.cores = 1;
            self.own = Some(own.end);
            for slice in others {
                let share = Share { how: how.clone(), beginning, slice: slice.clone() };
                self.others.extend(Other::start(turn, self.others.len(), share, &file.0));
            }
        }
        self.tell_progress();
        if let Some(reader) = &mut self.reader {
            reader.growing().iter().for_each(tell);
        }
    }

    fn tell_progress(&mut self) {
        let Some(reader) = &mut self.reader else { return };
        let done = reader.log().taken() + self.others.iter().map(Other::done).sum::<u64>();
        let telegrams = reader.telegrams() + self.others.iter().map(Other::telegrams).sum::<u64>() as usize;
        tell(&Answer::Progress { done: done as f64, telegrams });
    }

    /// Whoever waits for what others read looks at it.
    fn wake(&mut self) {
        if let Some(heard) = self.heard.take() {
            let _ = heard.call0(&JsValue::UNDEFINED);
        }
    }

    /// The file is read; returns what waited for that.
    fn finish(&mut self, turn: u32) -> Vec<Request> {
        let Some(reader) = self.reader.as_mut().filter(|_| self.turn == turn) else { return Vec::new() };
        reader.finish(&mut |answer| tell(&answer));
        self.complete = true;
        std::mem::take(&mut self.waiting)
    }
}

/// Another worker says something; nothing of ours if it fails.
pub fn heard(turn: u32, index: usize, mail: &JsValue) {
    DESK.with_borrow_mut(|desk| {
        let Some(other) = desk.others.get_mut(index).filter(|_| desk.turn == turn) else { return };
        other.hear(mail);
        desk.tell_progress();
        desk.wake();
    });
}

/// A file, part by part.
struct Parts {
    file: File,
    /// The place behind the part at hand.
    at: u64,
    /// The part at hand, whose room is used again and again.
    part: Vec<u8>,
    next: Option<JsFuture>,
}

impl Parts {
    fn of(file: File, from: u64) -> Self {
        Self { file, at: from, part: Vec::new(), next: None }
    }

    /// Waits for the next part, which ends at `to` at most; `false` if the file cannot be read.
    async fn next(&mut self, to: u64) -> bool {
        let Some(next) = self.next.take().or_else(|| self.begin(FIRST, to)) else { return false };
        let Ok(buffer) = next.await else { return false };
        let bytes = Uint8Array::new(&buffer);
        self.part.resize(bytes.length() as usize, 0);
        bytes.copy_to(&mut self.part);
        self.at += u64::from(bytes.length());
        // The browser reads the next part while this one is taken.
        self.next = self.begin(PIECE, to);
        true
    }

    fn begin(&self, length: u64, to: u64) -> Option<JsFuture> {
        let length = to.saturating_sub(self.at).min(length);
        if length == 0 { None } else { self.file.part(self.at, length) }
    }
}

//! The page's end: whoever reads the open log, here or in the worker. The page need not know which.

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};

use gloo_timers::callback::Timeout;
use leptos::task::spawn_local;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::JsFuture;
use web_sys::Blob;
use web_sys::js_sys::{Array, Uint8Array};

use super::mail;
use super::messages::{Answer, How, Request};
use super::reader::Reader;
use super::started::Started;
use crate::browser::file;
use buslens::tool::log::{Log, Source};

/// What is not larger is read where the page is, within a frame; the rest in the worker.
pub const SMALL: usize = 1 << 16;

/// What the page is told: an answer, with the file that comes with an export.
pub type Hear = Rc<dyn Fn(Answer, Option<Blob>)>;

/// Reads the open log.
pub struct Client {
    me: Weak<Self>,
    hear: Hear,
    here: RefCell<Option<Reader<Memory>>>,
    worker: RefCell<Option<Running>>,
    /// What was opened last: files come later than they are opened.
    turn: Cell<u32>,
}

/// A worker and what waits until it can hear.
struct Running {
    worker: Started,
    /// `None` once it can hear.
    waiting: Option<Vec<JsValue>>,
    /// It holds the log, or reads it.
    reads: bool,
    /// It is not through with the file: it says something with each part of it.
    in_parts: bool,
    /// How many bytes the file has.
    size: f64,
    /// Ends when it has been silent for too long.
    watch: Option<Timeout>,
}

/// A worker that says nothing for so long, in milliseconds, although it was asked, is gone: a browser
/// that is short of memory may end it without a word.
const PATIENCE: u32 = 30_000;
/// Bytes of a file for which it may take a millisecond more: some questions are about all of it.
const BYTES_PER_MILLISECOND: f64 = 32_768.0;
/// The same where a file of all telegrams is written.
const PATIENCE_WITH_FILES: u32 = 300_000;

/// A small file.
struct Memory(Vec<u8>);

impl Source for Memory {
    fn read(&self, from: u64, length: usize) -> Vec<u8> {
        self.0.as_slice().read(from, length)
    }
}

/// How many workers may read at once.
fn cores() -> usize {
    /// More would take memory, and would wait for the disk.
    const MOST: usize = 4;
    let cores = web_sys::window().map_or(1.0, |window| window.navigator().hardware_concurrency());
    (cores as usize).clamp(1, MOST)
}

impl Client {
    pub fn new(hear: Hear) -> Rc<Self> {
        Rc::new_cyclic(|me| Self {
            me: me.clone(),
            hear,
            here: RefCell::default(),
            worker: RefCell::default(),
            turn: Cell::default(),
        })
    }

    /// Opens a small file in place of the one before.
    pub fn open_bytes(&self, bytes: Vec<u8>, how: &How) {
        self.close();
        match Log::read(&bytes, &how.reading(), how.options()) {
            Ok(log) => {
                let size = bytes.len() as u64;
                let mut reader = Reader::new(log, Memory(bytes), size);
                let mut answers = Vec::new();
                reader.opening(&mut |answer| answers.push(answer));
                self.here.replace(Some(reader));
                answers.into_iter().for_each(|answer| (self.hear)(answer, None));
            }
            Err(refusal) => (self.hear)(Answer::Refused(refusal.to_string()), None),
        }
    }

    /// Opens a file in place of the one before.
    pub fn open_file(&self, file: Blob, how: How) {
        self.close();
        if file.size() > SMALL as f64 {
            return self.post(&Request::Open(how, cores()), &file);
        }
        let (client, turn) = (self.me.clone(), self.turn.get());
        spawn_local(async move {
            let read = JsFuture::from(file.array_buffer()).await;
            let Some(client) = client.upgrade().filter(|client| client.turn.get() == turn) else { return };
            match read {
                Ok(buffer) => client.open_bytes(Uint8Array::new(&buffer).to_vec(), &how),
                Err(_) => {
                    let why = "The file cannot be read: it is a folder, it is gone, or this browser may not open it.";
                    (client.hear)(Answer::Refused(why.to_owned()), None);
                }
            }
        });
    }

    /// Nothing is open any more.
    pub fn close(&self) {
        self.turn.set(self.turn.get() + 1);
        self.here.replace(None);
        // A worker that goes on reading would only keep the machine busy.
        self.worker.borrow_mut().take_if(|running| running.reads);
    }

    /// Asks something about the open log.
    pub fn ask(&self, request: Request) {
        let mut answers = Vec::new();
        let mut exported = None;
        match (&mut *self.here.borrow_mut(), &request) {
            (Some(reader), Request::Export { kind, notes }) => {
                let parts = Array::new();
                reader.export(*kind, notes, &mut |part| _ = parts.push(&Uint8Array::from(part)));
                exported = file::blob(&parts, kind.file().1);
                answers.push(Answer::Exported(*kind));
            }
            (Some(reader), Request::PassOn(hidden)) => {
                let (file, passed) = reader.pass_on(hidden);
                exported = file::blob(&Array::of1(&Uint8Array::from(file.as_slice())), "");
                answers.push(Answer::PassedOn(passed));
            }
            (Some(reader), request) => answers = reader.answer(request),
            (None, request) => {
                if self.worker.borrow().as_ref().is_some_and(|running| running.reads) {
                    self.post(request, &JsValue::UNDEFINED);
                }
            }
        }
        answers.into_iter().for_each(|answer| (self.hear)(answer, exported.clone()));
    }

    /// Sends to the worker, which is started if there is none.
    fn post(&self, request: &Request, beside: &JsValue) {
        let Some(mail) = mail::write(request, beside) else { return };
        let mut kept = self.worker.borrow_mut();
        if kept.is_none() {
            *kept = self.start();
        }
        match kept.as_mut() {
            Some(running) => {
                running.reads = true;
                if let Some(file) = beside.dyn_ref::<Blob>() {
                    running.size = file.size();
                }
                let writes = matches!(request, Request::Export { .. } | Request::PassOn(_));
                let patience = if writes { PATIENCE_WITH_FILES } else { PATIENCE };
                running.watch = Some(self.watch(patience, running.size));
                match &mut running.waiting {
                    Some(waiting) => waiting.push(mail),
                    None => drop(running.worker.post(&mail)),
                }
            }
            None => {
                drop(kept);
                let why = "This browser starts no workers, which read large files. Try a current version of \
                           Firefox, Chrome, Edge or Safari.";
                (self.hear)(Answer::Refused(why.to_owned()), None);
            }
        }
    }

    /// Starts the module of the page once more, as a worker.
    fn start(&self) -> Option<Running> {
        let me = self.me.clone();
        let worker = Started::start(move |mail| {
            if let Some(client) = me.upgrade() {
                client.heard(mail);
            }
        })?;
        Some(Running {
            worker,
            waiting: Some(Vec::new()),
            reads: false,
            in_parts: false,
            size: 0.0,
            watch: None,
        })
    }

    fn heard(&self, mail: &JsValue) {
        let Some((answer, beside)) = mail::read::<Answer>(mail) else { return self.failed() };
        if let Some(running) = &mut *self.worker.borrow_mut() {
            match answer {
                Answer::Progress { .. } => running.in_parts = true,
                Answer::Ready(_) | Answer::Refused(_) => running.in_parts = false,
                _ => {}
            }
            running.watch = running.in_parts.then(|| self.watch(PATIENCE, running.size));
            if matches!(answer, Answer::Hello) {
                running.watch = Some(self.watch(PATIENCE, running.size));
                for mail in running.waiting.take().unwrap_or_default() {
                    // It takes whatever this page writes.
                    let _ = running.worker.post(&mail);
                }
            }
        }
        (self.hear)(answer, beside.dyn_into().ok());
    }

    /// The worker did not start, or broke. The next file starts another one.
    fn failed(&self) {
        let Some(running) = self.worker.borrow_mut().take() else { return };
        let why = match running.waiting {
            Some(_) => {
                "The part of Buslens that reads large files could not be loaded. Check the connection, and reload the \
                 page if it goes on like that."
            }
            None => {
                "The part of Buslens that reads large files has ended: something in it broke, or the browser is short \
                 of memory. Please report the file if it goes on like that."
            }
        };
        // A closure may not be dropped while it runs.
        Timeout::new(0, move || drop(running)).forget();
        (self.hear)(Answer::Lost(why.to_owned()), None);
    }

    /// Ends a worker that says nothing for longer than `patience`, and what a file of this size adds to it.
    fn watch(&self, patience: u32, size: f64) -> Timeout {
        let me = self.me.clone();
        Timeout::new(patience.saturating_add((size / BYTES_PER_MILLISECOND) as u32), move || {
            if let Some(client) = me.upgrade() {
                client.failed();
            }
        })
    }
}

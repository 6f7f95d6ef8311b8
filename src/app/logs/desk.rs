//! What the page of logs is about. What it shows is drawn by the worker; here is what a person chose.

use std::cell::RefCell;
use std::collections::BTreeMap;

use leptos::prelude::*;
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;
use web_sys::js_sys::Array;
use web_sys::{Blob, Element, HtmlLinkElement, MessageEvent, Worker, WorkerOptions, WorkerType};

use super::mail::{Mail, pairs_text};
use crate::app::address::SETTINGS;
use crate::app::browser::{self, LIST};
use buslens::field::{Span, many};

thread_local! {
    static WORKER: RefCell<Option<Worker>> = const { RefCell::new(None) };
    /// The message that waits for the worker to hear.
    static WAITING: RefCell<Option<Mail>> = const { RefCell::new(None) };
    /// The file that is open, to read it again in another way.
    static FILE: RefCell<Option<(Blob, String)>> = const { RefCell::new(None) };
}

/// The height of a row in pixels; the stylesheet has the same.
const ROW: usize = 40;

/// Browsers draw no element higher than some million pixels: longer lists move in larger steps.
const HIGHEST: usize = 8_000_000;

/// How many rows are asked for at once: more than are in sight.
const ASKED: usize = 48;

/// The page's state.
#[derive(Clone, Copy)]
pub struct Desk {
    /// The worker can hear.
    awake: RwSignal<bool>,
    pub stage: RwSignal<Stage>,
    /// Markup that the worker drew.
    pub settings: RwSignal<String>,
    pub story: RwSignal<String>,
    pub findings: RwSignal<String>,
    pub table: RwSignal<String>,
    pub lists: RwSignal<String>,
    pub picture: RwSignal<String>,
    pub series: RwSignal<String>,
    pub telegram: RwSignal<String>,
    pub unread: RwSignal<String>,
    /// The rows that are drawn, and the place of the first one.
    pub rows: RwSignal<(usize, String)>,
    /// How many telegrams the list has, of how many.
    pub total: RwSignal<(usize, usize)>,
    /// The place in the list of the telegram that is shown.
    pub place: RwSignal<Option<usize>>,
    /// Its number.
    pub number: RwSignal<usize>,
    pub scrolled: RwSignal<usize>,
    /// What was typed and chosen above the list.
    pub filter: RwSignal<BTreeMap<String, String>>,
    /// How the file is to be read.
    pub how: RwSignal<BTreeMap<String, String>>,
    /// What a person noted on telegrams, by their numbers.
    pub notes: RwSignal<BTreeMap<usize, String>>,
    /// The line to mark parts in.
    pub sample: RwSignal<String>,
}

/// How far the log is read.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Stage {
    #[default]
    Empty,
    Reading {
        done: f64,
        of: f64,
        telegrams: usize,
        /// Milliseconds since the start.
        since: f64,
    },
    Refused(String),
    Ready,
}

impl Desk {
    pub fn new() -> Self {
        Self {
            awake: RwSignal::default(),
            stage: RwSignal::default(),
            settings: RwSignal::default(),
            story: RwSignal::default(),
            findings: RwSignal::default(),
            table: RwSignal::default(),
            lists: RwSignal::default(),
            picture: RwSignal::default(),
            series: RwSignal::default(),
            telegram: RwSignal::default(),
            unread: RwSignal::default(),
            rows: RwSignal::default(),
            total: RwSignal::default(),
            place: RwSignal::default(),
            number: RwSignal::default(),
            scrolled: RwSignal::default(),
            filter: RwSignal::default(),
            how: RwSignal::default(),
            notes: RwSignal::default(),
            sample: RwSignal::default(),
        }
    }

    /// Opens a file in place of the one before.
    pub fn open(&self, file: Blob, name: String) {
        FILE.with_borrow_mut(|kept| *kept = Some((file, name)));
        self.notes.update(BTreeMap::clear);
        self.how.update(|how| how.retain(|key, _| matches!(key.as_str(), "protocol" | "device")));
        self.read();
    }

    /// Opens text that was pasted.
    pub fn paste(&self, text: &str) {
        if let Ok(file) = Blob::new_with_str_sequence(&Array::of1(&text.into())) {
            self.open(file, "pasted text".to_owned());
        }
    }

    /// Reads the open file from its beginning.
    pub fn read(&self) {
        let Some((file, name)) = FILE.with_borrow(Clone::clone) else { return };
        self.stage.set(Stage::Reading { done: 0.0, of: file.size(), telegrams: 0, since: now() });
        self.filter.update(BTreeMap::clear);
        for markup in [
            self.story,
            self.findings,
            self.table,
            self.lists,
            self.picture,
            self.series,
            self.telegram,
            self.unread,
        ] {
            markup.set(String::new());
        }
        self.rows.set((0, String::new()));
        self.total.set((0, 0));
        self.place.set(None);
        let mail = Mail::new("open").with(file).with(name.as_str()).with(self.how_text().as_str());
        self.send(mail);
    }

    /// How the file is to be read, and how the devices are set up.
    fn how_text(&self) -> String {
        let settings = browser::remembered(SETTINGS);
        self.how.with_untracked(|pairs| pairs_text(pairs))
            + &pairs_text(settings.iter().map(|kept| ("settings", kept)))
    }

    /// A person says how the file is to be read.
    pub fn read_as(&self, key: &str, value: &str) {
        self.how.update(|how| drop(how.insert(key.to_owned(), value.to_owned())));
        if key == "device" {
            self.send(Mail::new("set-up").with(self.how_text().as_str()));
        } else {
            self.read();
        }
    }

    /// Stops reading; what was read so far is shown.
    pub fn stop(&self) {
        self.send(Mail::new("stop"));
    }

    /// A person says which telegrams are to be seen.
    pub fn filter_by(&self, key: &str, value: &str) {
        self.filter.update(|filter| match value {
            "" => drop(filter.remove(key)),
            value => drop(filter.insert(key.to_owned(), value.to_owned())),
        });
        self.send(Mail::new("filter").with(self.filter.with_untracked(|pairs| pairs_text(pairs)).as_str()));
    }

    /// Everything is to be seen.
    pub fn show_all(&self) {
        self.filter.update(BTreeMap::clear);
        self.filter_by("text", "");
    }

    /// Reads the file without what was marked in a line.
    pub fn forget_marks(&self) {
        let choices = |key: &str| matches!(key, "protocol" | "device" | "input" | "numbers");
        self.how.update(|how| how.retain(|key, _| choices(key)));
        self.read();
    }

    /// Shows the telegram at a place of the list.
    pub fn select(&self, place: usize) {
        self.send(Mail::new("select").with(place as f64));
    }

    /// Shows a telegram wherever it is.
    pub fn find(&self, index: usize) {
        self.send(Mail::new("find").with(index as f64));
    }

    /// Goes to the next error.
    pub fn step(&self, forwards: bool) {
        let from = self.place.get_untracked().unwrap_or(0);
        self.send(Mail::new("step").with(from as f64).with(if forwards { 1.0 } else { -1.0 }));
    }

    /// Notes something on the telegram that is shown.
    pub fn note(&self, text: &str) {
        let number = self.number.get_untracked();
        self.notes.update(|notes| match text.trim() {
            "" => drop(notes.remove(&number)),
            text => drop(notes.insert(number, text.to_owned())),
        });
        self.send_notes();
    }

    fn send_notes(&self) {
        self.send(Mail::new("notes").with(self.notes.with_untracked(|notes| pairs_text(notes)).as_str()));
    }

    pub fn export(&self, kind: &str) {
        self.send(Mail::new("export").with(kind));
    }

    pub fn ask(&self, kind: &str) {
        self.send(Mail::new(kind));
    }

    /// Shows the telegrams that a finding is about.
    pub fn show_finding(&self, number: usize) {
        self.filter.update(|filter| drop(filter.insert("finding".to_owned(), number.to_string())));
        self.send(Mail::new("finding").with(number as f64));
    }

    pub fn draw_series(&self, unit: &str, register: &str) {
        let number = |text: &str| match text.trim().strip_prefix("0x") {
            Some(hex) => u32::from_str_radix(hex, 16).ok().map(f64::from),
            None => text.trim().parse::<u32>().ok().map(f64::from),
        };
        match number(register) {
            Some(register) => {
                self.send(Mail::new("series").with(number(unit).unwrap_or(-1.0)).with(register))
            }
            None => browser::say("Which register? Expected its address, such as 200 or 0xC8."),
        }
    }

    /// The list was scrolled to this many pixels.
    pub fn scroll(&self, top: usize) {
        self.scrolled.set(top);
        let (count, _) = self.total.get_untracked();
        let first = self.first_in_sight(top, count);
        let drawn = self.rows.with_untracked(|(first, _)| *first);
        let near = first >= drawn + 2 && first + 16 < drawn + ASKED;
        if !near {
            self.ask_rows(first);
        }
    }

    fn ask_rows(&self, first: usize) {
        let first = first.saturating_sub(ASKED / 3);
        self.send(Mail::new("rows").with(first as f64).with(ASKED as f64));
    }

    fn first_in_sight(&self, top: usize, count: usize) -> usize {
        let height = self.height(count);
        if height == count * ROW { top / ROW } else { (top as f64 / height as f64 * count as f64) as usize }
    }

    /// How high the list is with all its rows.
    fn height(&self, count: usize) -> usize {
        (count * ROW).min(HIGHEST)
    }

    /// The empty space above the drawn rows and below them.
    pub fn space(&self) -> (usize, usize) {
        let (count, _) = self.total.get();
        let (first, drawn) = self.rows.with(|(first, _)| (*first, ASKED.min(count.saturating_sub(*first))));
        let height = self.height(count);
        let above = if height == count * ROW {
            first * ROW
        } else {
            // In steps of many rows, those drawn are put where the list is scrolled to.
            let top = self.scrolled.get();
            let ahead = self.first_in_sight(top, count).saturating_sub(first);
            top.saturating_sub(ahead * ROW)
        };
        (above, height.saturating_sub(above + drawn * ROW))
    }

    /// Scrolls the list so that the row at `place` is in sight.
    fn keep_in_sight(&self, place: usize) {
        let (count, _) = self.total.get_untracked();
        let height = self.height(count);
        if height == count * ROW {
            browser::keep_in_sight(place);
        } else if let Some(list) = browser::element::<Element>(LIST) {
            list.set_scroll_top((place as f64 / count as f64 * height as f64) as i32);
        }
    }

    fn hear(&self, mail: &Mail) {
        match mail.kind().as_str() {
            "hello" => {
                self.awake.set(true);
                self.settings.set(mail.text(1));
                if let Some(mail) = WAITING.take() {
                    self.send(mail);
                }
            }
            "progress" => self.stage.update(|stage| {
                if let Stage::Reading { done, of, telegrams, .. } = stage {
                    (*done, *of, *telegrams) = (mail.number(1), mail.number(2), mail.index(3));
                }
            }),
            "refused" => {
                browser::announce(mail.text(1));
                self.stage.set(Stage::Refused(mail.text(1)));
            }
            "ready" => {
                self.story.set(mail.text(1));
                self.table.set(mail.text(2));
                self.lists.set(mail.text(3));
                self.stage.set(Stage::Ready);
                // The same file, read in another way.
                self.send_notes();
            }
            "filtered" => {
                self.total.set((mail.index(1), mail.index(2)));
                self.picture.set(mail.text(3));
                self.place.set(None);
                self.scrolled.set(0);
                if let Some(list) = browser::element::<Element>(LIST) {
                    list.set_scroll_top(0);
                }
                self.ask_rows(0);
                self.select(0);
                browser::announce(format!("{} in the list", many(mail.index(1), "telegram")));
            }
            "findings" => self.findings.set(mail.text(1)),
            "rows" => self.rows.set((mail.index(1), mail.text(2))),
            "telegram" => {
                let place = (mail.number(1) >= 0.0).then(|| mail.index(1));
                self.place.set(place);
                self.number.set(mail.index(2) + 1);
                self.telegram.set(mail.text(3));
                let note = self.notes.with_untracked(|notes| notes.get(&(mail.index(2) + 1)).cloned());
                browser::set_field("note", &note.unwrap_or_default());
                if let Some(place) = place {
                    self.keep_in_sight(place);
                }
            }
            "series" => self.series.set(mail.text(1)),
            "unread" => self.unread.set(mail.text(1)),
            "sample" => {
                self.sample.set(mail.text(1));
                browser::set_field("sample", &mail.text(1));
            }
            "said" => browser::say(&mail.text(1)),
            "exported" => {
                if let Ok(file) = mail.value(2).dyn_into::<Blob>() {
                    browser::download_blob(&mail.text(1), &file);
                }
            }
            _ => {}
        }
    }

    /// Starts the worker. It says hello once it can hear.
    pub fn start(&self) {
        let desk = *self;
        let Some(worker) = start() else {
            let why = "This browser starts no workers, which read logs. Try a current version of Firefox, \
                       Chrome, Edge or Safari.";
            self.stage.set(Stage::Refused(why.to_owned()));
            return;
        };
        let hear = Closure::<dyn Fn(MessageEvent)>::new(move |event: MessageEvent| {
            if let Some(mail) = Mail::of(&event) {
                desk.hear(&mail);
            }
        });
        worker.set_onmessage(Some(hear.into_js_value().unchecked_ref()));
        WORKER.with_borrow_mut(|kept| *kept = Some(worker));
        // What another view hands over.
        if let Some(text) = browser::remembered(browser::LOG).filter(|text| !text.is_empty()) {
            browser::remember(browser::LOG, "");
            self.paste(&text);
        }
    }

    /// Sends to the worker, or keeps what is to be opened until it can hear.
    fn send(&self, mail: Mail) {
        if !self.awake.get_untracked() {
            WAITING.with_borrow_mut(|waiting| *waiting = Some(mail));
            return;
        }
        WORKER.with_borrow(|worker| {
            // A worker that is gone hears nothing.
            drop(worker.as_ref().map(|worker| worker.post_message(mail.message())));
        });
    }

    /// What is selected of the sample line is its time, its bytes, or says who speaks.
    pub fn mark(&self, part: &str, span: Span) {
        let line = self.sample.get_untracked();
        self.how.update(|how| {
            how.insert("line".to_owned(), line);
            if matches!(part, "request" | "response") {
                how.remove("request");
                how.remove("response");
            }
            how.insert(part.to_owned(), browser::span_text(span));
        });
        if self.how.with_untracked(|how| how.contains_key("bytes")) {
            let sample = self.sample.get_untracked();
            self.read();
            self.sample.set(sample);
        } else {
            browser::say("Now mark the bytes in the line, too.");
        }
    }
}

/// Starts the worker whose script the document names.
fn start() -> Option<Worker> {
    let link: HtmlLinkElement = browser::element("worker")?;
    let options = WorkerOptions::new();
    options.set_type(WorkerType::Module);
    Worker::new_with_options(&link.href(), &options).ok()
}

/// Milliseconds since the page was opened.
pub fn now() -> f64 {
    window().performance().map_or(0.0, |clock| clock.now())
}

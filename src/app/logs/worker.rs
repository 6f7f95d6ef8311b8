//! The worker: it holds the log, reads it, and draws what is asked for.

use std::cell::RefCell;
use std::collections::BTreeMap;

use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::js_sys::{self, Array, Uint8Array};
use web_sys::{Blob, DedicatedWorkerGlobalScope, FileReaderSync, MessageEvent};

use super::mail::{Mail, pairs_of, value_of};
use super::{rows, summary, telegram, timeline};
use buslens::field::{Direction, Span};
use buslens::tool::link::Link;
use buslens::tool::log::{self, Filter, Finding, Input, Log, Marks, Numbers, Place, Reading, Source, Wanted};
use buslens::tool::{annotated, csv, json};

/// What is read at a time.
const PIECE: u64 = 4 << 20;

/// How many stretches the timeline has.
const BUCKETS: usize = 120;

thread_local! {
    static DESK: RefCell<Desk> = RefCell::default();
}

/// What lies on the worker's desk.
#[derive(Default)]
struct Desk {
    opened: Option<Opened>,
    /// Counts what was opened and stopped: a reading that is not the latest gives up.
    turn: u32,
    stopped: bool,
}

struct Opened {
    log: Log,
    file: File,
    name: String,
    filter: Filter,
    /// The indices of the telegrams that the list shows.
    chosen: Vec<u32>,
    findings: Vec<Finding>,
    /// What a person noted on telegrams, by their numbers.
    notes: BTreeMap<usize, String>,
    /// Which rows were asked for last.
    in_sight: (usize, usize),
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
        read().unwrap_or_default()
    }
}

/// Waits for messages from the page.
pub fn start() {
    std::panic::set_hook(Box::new(|panic| {
        web_sys::console::error_1(&panic.to_string().into());
        tell(&Mail::new("refused").with("Something in Buslens broke while it read this log. Reload the page, and please report the file that led to this."));
    }));
    let hear = Closure::<dyn Fn(MessageEvent)>::new(|event: MessageEvent| {
        if let Some(mail) = Mail::of(&event) {
            hear(&mail);
        }
    });
    scope().set_onmessage(Some(hear.into_js_value().unchecked_ref()));
    tell(&Mail::new("hello").with(summary::settings().into_string()));
}

fn scope() -> DedicatedWorkerGlobalScope {
    js_sys::global().unchecked_into()
}

fn tell(mail: &Mail) {
    // A page that is gone hears nothing.
    let _ = scope().post_message(mail.message());
}

fn hear(mail: &Mail) {
    match mail.kind().as_str() {
        "open" => {
            if let Ok(blob) = mail.value(1).dyn_into::<Blob>() {
                let turn = DESK.with_borrow_mut(|desk| {
                    desk.turn += 1;
                    desk.stopped = false;
                    desk.opened = None;
                    desk.turn
                });
                spawn_local(open(turn, File(blob), mail.text(2), mail.text(3)));
            }
        }
        "stop" => DESK.with_borrow_mut(|desk| desk.stopped = true),
        _ => DESK.with_borrow_mut(|desk| {
            if let Some(opened) = &mut desk.opened {
                opened.hear(mail);
            }
        }),
    }
}

/// Reads a file from its beginning to its end.
async fn open(turn: u32, file: File, name: String, how: String) {
    let pairs = pairs_of(&how);
    let options = Link::read(pairs.clone()).options;
    let size = file.size();
    let mut part = Vec::new();
    if let Some(beginning) = file.part(0, log::BEGINNING as u64) {
        come(beginning, &mut part).await;
    }
    let mut log = match Log::open(&part, size, &reading(&pairs), options) {
        Ok(log) => log,
        Err(refusal) => return tell(&Mail::new("refused").with(refusal.to_string())),
    };
    let mut at = 0;
    let mut next = file.part(0, PIECE);
    while at < size {
        let came = match next {
            Some(next) => come(next, &mut part).await,
            None => false,
        };
        if !came {
            return tell(
                &Mail::new("refused")
                    .with("The file can no longer be read: it was changed or moved. Open it again."),
            );
        };
        let (latest, stopped) = DESK.with_borrow(|desk| (desk.turn == turn, desk.stopped));
        if !latest {
            return;
        }
        at += part.len() as u64;
        // The browser reads the next part while this one is taken.
        next = file.part(at, PIECE);
        let room = log.push(&part);
        let telegrams = log.entries().len();
        tell(&Mail::new("progress").with(at as f64).with(size as f64).with(telegrams as f64));
        if stopped || !room || part.is_empty() {
            break;
        }
    }
    log.finish();
    let opened = Opened {
        log,
        file,
        name,
        filter: Filter::default(),
        chosen: Vec::new(),
        findings: Vec::new(),
        notes: BTreeMap::new(),
        in_sight: (0, 0),
    };
    DESK.with_borrow_mut(|desk| {
        if desk.turn == turn {
            desk.opened.insert(opened).ready();
        }
    });
}

/// Waits for a part of a file, and puts it into `part`, whose room is used again and again.
async fn come(next: JsFuture, part: &mut Vec<u8>) -> bool {
    let Ok(buffer) = next.await else { return false };
    let bytes = Uint8Array::new(&buffer);
    part.resize(bytes.length() as usize, 0);
    bytes.copy_to(part);
    true
}

impl Opened {
    /// Says what was read.
    fn ready(&mut self) {
        tell(
            &Mail::new("ready")
                .with(summary::story(&self.log, &self.name).into_string())
                .with(summary::table(&self.log).into_string())
                .with(summary::lists(&self.log).into_string()),
        );
        self.choose();
        self.find_causes();
    }

    /// Looks for what is behind many errors.
    fn find_causes(&mut self) {
        self.findings = self.log.findings(&self.file);
        tell(&Mail::new("findings").with(summary::findings(&self.findings).into_string()));
    }

    fn hear(&mut self, mail: &Mail) {
        match mail.kind().as_str() {
            "set-up" => {
                self.log.set_options(Link::read(pairs_of(&mail.text(1))).options);
                self.choose();
            }
            "filter" => {
                self.filter = filter(&pairs_of(&mail.text(1)));
                self.choose();
            }
            "rows" => {
                self.in_sight = (mail.index(1), mail.index(2));
                self.rows();
            }
            "notes" => {
                let notes = pairs_of(&mail.text(1)).into_iter();
                self.notes = notes.filter_map(|(number, note)| Some((number.parse().ok()?, note))).collect();
                self.rows();
            }
            "select" => self.select(mail.index(1)),
            "find" => self.find(mail.index(1)),
            "step" => self.step(mail.index(1), mail.number(2) > 0.0),
            "finding" => self.show_finding(mail.index(1)),
            "series" => self.series(mail.number(1), mail.number(2)),
            "export" => self.export(&mail.text(1)),
            "unread" => self.unread(),
            "sample" => self.sample(),
            _ => {}
        }
    }

    /// Shows the telegrams that a finding is about.
    fn show_finding(&mut self, number: usize) {
        if let Some(finding) = self.findings.get(number) {
            self.chosen = finding.evidence.clone();
            self.list();
        }
    }

    /// Finds the telegrams that the filter lets through.
    fn choose(&mut self) {
        self.chosen = self.log.filtered(&self.filter, &self.file, self.file.size());
        self.list();
    }

    /// Says what the list has.
    fn list(&self) {
        let all = self.chosen.len() == self.log.entries().len();
        let picture = self.log.timeline((!all).then_some(self.chosen.as_slice()), BUCKETS);
        tell(
            &Mail::new("filtered")
                .with(self.chosen.len() as f64)
                .with(self.log.entries().len() as f64)
                .with(timeline::timeline(&picture).into_string()),
        );
    }

    fn rows(&self) {
        /// More do not fit on any screen.
        const MOST: usize = 200;
        let (first, count) = self.in_sight;
        let total = self.chosen.len();
        let rows = Span::new(first, first + count.min(MOST)).of(&self.chosen);
        let markup = rows::rows(&self.log, &self.file, &self.notes, rows, (first, total));
        tell(&Mail::new("rows").with(first as f64).with(markup.into_string()));
    }

    fn select(&self, place: usize) {
        let Some(index) = self.chosen.get(place).map(|index| *index as usize) else { return };
        let markup = telegram::telegram(&self.log, &self.file, index);
        tell(&Mail::new("telegram").with(place as f64).with(index as f64).with(markup.into_string()));
    }

    /// Shows a telegram by its index, wherever it is in the list, or next to it.
    fn find(&self, index: usize) {
        let place = self.chosen.partition_point(|other| (*other as usize) < index);
        if self.chosen.get(place).is_some_and(|found| *found as usize == index) {
            self.select(place);
        } else {
            let markup = telegram::telegram(&self.log, &self.file, index);
            tell(&Mail::new("telegram").with(-1.0).with(index as f64).with(markup.into_string()));
        }
    }

    /// The next error from a place of the list on.
    fn step(&self, from: usize, forwards: bool) {
        let wrong = |place: &usize| {
            let entry = &self.log.entries()[self.chosen[*place] as usize];
            log::is_error(entry)
        };
        let found = match forwards {
            true => (from + 1..self.chosen.len()).find(wrong),
            false => (0..from.min(self.chosen.len())).rev().find(wrong),
        };
        match found {
            Some(place) => self.select(place),
            None => tell(&Mail::new("said").with(if forwards {
                "No error comes after this."
            } else {
                "No error comes before this."
            })),
        }
    }

    fn series(&self, unit: f64, address: f64) {
        const MOST: usize = 600;
        let unit = (0.0..=255.0).contains(&unit).then_some(unit as u8);
        let points = self.log.series(&self.file, unit, address.clamp(0.0, 65_535.0) as u16, MOST);
        let what = match unit {
            Some(unit) => format!("Register {address} of unit {unit}"),
            None => format!("Register {address}"),
        };
        tell(&Mail::new("series").with(timeline::series(&points, &what).into_string()));
    }

    /// The telegrams of the list as a file.
    fn export(&self, kind: &str) {
        /// So many are read at a time.
        const AT_ONCE: usize = 2000;
        let parts = Array::new();
        match kind {
            "csv" => drop(parts.push(&csv::head().into())),
            "txt" => drop(parts.push(&story_text(&self.log).into())),
            _ => {}
        }
        for chosen in self.chosen.chunks(AT_ONCE) {
            let text = match kind {
                "hex" => self.hex(chosen),
                "log" => self.lines(chosen),
                _ => self.read(chosen, kind),
            };
            parts.push(&text.into());
        }
        let (name, mime) = match kind {
            "csv" => ("telegrams.csv", "text/csv"),
            "jsonl" | "fields" => ("telegrams.jsonl", "application/json"),
            "log" => ("lines.txt", "text/plain"),
            _ => ("telegrams.txt", "text/plain"),
        };
        let bag = web_sys::BlobPropertyBag::new();
        bag.set_type(mime);
        if let Ok(blob) = Blob::new_with_str_sequence_and_options(&parts, &bag) {
            tell(&Mail::new("exported").with(name).with(JsValue::from(blob)));
        }
    }

    fn hex(&self, chosen: &[u32]) -> String {
        let entries = chosen.iter().map(|index| &self.log.entries()[*index as usize]);
        entries.map(|entry| buslens::field::hex(self.log.bytes(entry)) + "\n").collect()
    }

    /// The log's own lines.
    fn lines(&self, chosen: &[u32]) -> String {
        const LONGEST: usize = 4096;
        let mut last = None;
        let mut text = String::new();
        for entry in chosen.iter().map(|index| &self.log.entries()[*index as usize]) {
            if entry.line > 0 && last != Some(entry.offset) {
                text += &self.log.text_at(&self.file, entry.offset, LONGEST);
                text.push('\n');
            }
            last = Some(entry.offset);
        }
        text
    }

    /// What telegrams say, each by itself, with what their partners tell of them.
    fn read(&self, chosen: &[u32], kind: &str) -> String {
        let entries = self.log.entries();
        let chosen: Vec<usize> =
            chosen.iter().map(|index| *index as usize).filter(|index| entries[*index].counts()).collect();
        let read = self.log.with_partners(chosen.iter().copied());
        let mut report = self.log.report(&self.file, &read);
        for telegram in &mut report.telegrams {
            telegram.comment = self.notes.get(&telegram.number).cloned().unwrap_or_default();
        }
        let places = chosen.iter().filter_map(|index| read.binary_search(index).ok());
        let one = |place: usize| match kind {
            "csv" => csv::telegram(&report, place),
            "txt" => format!("\n{}", annotated::telegram(&report, place)),
            kind => json::line(&report, place, kind == "fields").unwrap_or_default() + "\n",
        };
        places.map(one).collect()
    }

    /// The lines without bytes.
    fn unread(&self) {
        const SHOWN: usize = 500;
        const LONGEST: usize = 300;
        let unread = self.log.unread();
        let markup = maud::html! {
            ol.unread {
                @for (line, offset) in unread.iter().take(SHOWN) {
                    li value=(line) { code { (self.log.text_at(&self.file, *offset, LONGEST)) } }
                }
            }
            @if unread.len() > SHOWN { p { "and " (unread.len() - SHOWN) " more" } }
        };
        tell(&Mail::new("unread").with(markup.into_string()));
    }

    /// A line that holds a telegram, or else any line, to mark its parts in.
    fn sample(&self) {
        const LONGEST: usize = 1000;
        let first = self.log.entries().iter().find(|entry| entry.line > 0).map(|entry| entry.offset);
        let offset = first.or(self.log.unread().first().map(|(_, offset)| *offset)).unwrap_or_default();
        tell(&Mail::new("sample").with(self.log.text_at(&self.file, offset, LONGEST)));
    }
}

fn story_text(log: &Log) -> String {
    log.story().iter().map(|sentence| format!("{}.\n", sentence.sentence())).collect()
}

/// How a person says that the file is to be read.
fn reading(pairs: &[(String, String)]) -> Reading {
    let value = |key: &str| value_of(pairs, key);
    let numbers = match value("numbers") {
        "hex" => Some(Numbers::Hex),
        "decimal" => Some(Numbers::Decimal),
        _ => None,
    };
    let line = value("line");
    let span = |key: &str| {
        let (from, to) = value(key).split_once('-')?;
        let span = Span::new(from.parse().ok()?, to.parse().ok()?);
        line.get(span.from..span.to).filter(|text| !text.is_empty()).map(|text| (span, text))
    };
    let marks = span("bytes").map(|(bytes, _)| Marks {
        time: span("time").map(|(time, _)| Place::of(line, time)),
        direction: ["request", "response"].into_iter().find_map(|key| {
            let (place, word) = span(key)?;
            Some((Place::of(line, place), word.to_owned(), Direction::of(key)?))
        }),
        bytes: Place::of(line, bytes),
    });
    Reading { input: Input::of(value("input")).unwrap_or_default(), numbers, marks }
}

fn filter(pairs: &[(String, String)]) -> Filter {
    let value = |key: &str| value_of(pairs, key);
    let range = |key: &str| {
        let (from, to) = value(key).split_once("..")?;
        Some((from.parse::<i64>().ok()?, to.parse::<i64>().ok()?))
    };
    Filter {
        port: value("port").parse().ok(),
        unit: value("unit").parse().ok(),
        function: value("function").parse().ok(),
        direction: Direction::of(value("way")),
        wanted: Wanted::of(value("wanted")).unwrap_or_default(),
        times: range("times"),
        places: range("places").map(|(from, to)| (from.max(0) as usize, to.max(0) as usize)),
        text: value("text").to_owned(),
    }
}

//! The log that is open: what was asked of its reader, and what the reader said.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;
use web_sys::Blob;
use web_sys::js_sys::Date;

use crate::browser::{file, storage};
use crate::components::byte_strip::Lights;
use crate::components::telegram::Shown;
use crate::components::toast::Toasts;
use crate::worker::client::Client;
use crate::worker::messages::{
    self, Answer, Choice, Export, Found, How, Passed, Proposed, Request, Value, Which,
};
use buslens::field::{in_order, many};
use buslens::tool::Options;
use buslens::tool::digest::Digest;
use buslens::tool::log::{Filter, Held, Lanes, Overview, Row, Seen, State};

/// How many rows are asked for at once: more than are in sight.
pub const ASKED: usize = 80;

/// Where what a person noted is kept.
const NOTES: &str = "notes";

/// How far a log is read.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Stage {
    #[default]
    Closed,
    Reading {
        done: f64,
        of: f64,
        telegrams: usize,
        /// Milliseconds, as the browser counts them.
        since: f64,
    },
    Refused(String),
    /// Nobody reads it any more.
    Lost(String),
    Ready,
}

/// A telegram that is shown beside the list.
#[derive(Clone, Debug)]
pub struct Current {
    pub told: messages::Shown,
    /// `None` for what is no telegram.
    pub shown: Option<Shown>,
}

/// What is known of the open log.
#[derive(Clone, Copy)]
pub struct LogState {
    /// Who reads it, once that part of the module is there.
    client: StoredValue<Option<Rc<Client>>, LocalStorage>,
    toasts: Toasts,
    /// How it is read: the page takes what it is told for those bytes.
    options: RwSignal<Options>,
    /// What notes belong to.
    key: RwSignal<String>,
    /// The log was told of, and its first list is to come.
    is_new: StoredValue<bool>,
    /// The telegram that was asked for is elsewhere in the list.
    jumps: StoredValue<bool>,
    pub stage: RwSignal<Stage>,
    pub overview: RwSignal<Option<Arc<Overview>>>,
    pub findings: RwSignal<Vec<Found>>,
    /// The devices that units look like, the surest first.
    pub proposals: RwSignal<Vec<Proposed>>,
    /// What lines tell that hold no telegram.
    pub seen: RwSignal<Vec<Seen>>,
    pub lanes: RwSignal<Lanes>,
    /// How many telegrams the list has.
    pub total: RwSignal<usize>,
    /// The list is what somebody wants to see now.
    pub to_list: Trigger,
    /// Counts the lists: each begins at its top.
    pub lists: RwSignal<usize>,
    /// The rows that are known, and the place of the first one.
    pub rows: RwSignal<(usize, Vec<Row>)>,
    /// The telegram that is shown.
    pub current: RwSignal<Option<Arc<Current>>>,
    pub lights: Lights,
    pub filter: RwSignal<Filter>,
    /// The finding that is followed.
    pub finding: RwSignal<Option<usize>>,
    /// The list has only the telegrams of that finding.
    pub only: RwSignal<bool>,
    /// What a person noted on telegrams, by their numbers.
    pub notes: RwSignal<BTreeMap<usize, String>>,
    pub series: RwSignal<Option<Vec<Value>>>,
    /// The registers that the log has values of.
    pub held: RwSignal<Vec<Held>>,
    pub unread: RwSignal<Option<Unread>>,
    /// A line to mark parts in.
    pub sample: RwSignal<String>,
    /// The log in short, when it was asked for.
    pub digest: RwSignal<Option<Arc<Digest>>>,
    /// The log to pass on, when it was asked for.
    pub passed: RwSignal<Option<(Passed, Blob)>, LocalStorage>,
}

/// Unread lines: their numbers and text, and how many more there are.
#[derive(Clone, Debug, PartialEq)]
pub struct Unread {
    pub lines: Vec<(u32, String)>,
    pub more: usize,
}

impl LogState {
    pub fn new(toasts: Toasts) -> Self {
        Self {
            client: StoredValue::new_local(None),
            toasts,
            options: RwSignal::default(),
            key: RwSignal::default(),
            is_new: StoredValue::new(false),
            jumps: StoredValue::new(false),
            stage: RwSignal::default(),
            overview: RwSignal::default(),
            findings: RwSignal::default(),
            proposals: RwSignal::default(),
            seen: RwSignal::default(),
            lanes: RwSignal::default(),
            total: RwSignal::default(),
            to_list: Trigger::new(),
            lists: RwSignal::default(),
            rows: RwSignal::default(),
            current: RwSignal::default(),
            lights: Lights::new(),
            filter: RwSignal::default(),
            finding: RwSignal::default(),
            only: RwSignal::default(),
            notes: RwSignal::default(),
            series: RwSignal::default(),
            held: RwSignal::default(),
            unread: RwSignal::default(),
            sample: RwSignal::default(),
            digest: RwSignal::default(),
            passed: RwSignal::new_local(None),
        }
    }

    /// From now on logs can be opened.
    pub fn start(self) {
        let hear = move |answer, beside| self.hear(answer, beside);
        self.client.set_value(Some(Client::new(Rc::new(hear))));
        // Two tabs with the same log: each hears what is noted in the other.
        storage::on_change(NOTES, move |kept| {
            let key = self.key.get_untracked();
            if let Some(notes) = kept.and_then(|kept| notes_of(&key, &kept)) {
                self.notes.set(notes);
            }
        });
    }

    fn client(&self) -> Rc<Client> {
        self.client.get_value().expect("logs are opened once they can be")
    }

    /// Opens a small file in place of the one before.
    pub fn open_bytes(&self, key: &str, bytes: Vec<u8>, how: &How) {
        self.begin(key, bytes.len() as f64, how);
        self.client().open_bytes(bytes, how);
    }

    /// Opens a file of any size in place of the one before.
    pub fn open_file(&self, key: &str, file: Blob, how: How) {
        self.begin(key, file.size(), &how);
        self.client().open_file(file, how);
    }

    pub fn close(&self) {
        self.client().close();
        self.forget();
        self.stage.set(Stage::Closed);
    }

    fn begin(&self, key: &str, of: f64, how: &How) {
        // The same text with a slip mended goes on being looked at in the same way.
        if self.key.get_untracked() != key {
            self.key.set(key.to_owned());
            self.filter.set(Filter::default());
            self.forget();
            let kept = storage::kept(NOTES).unwrap_or_default();
            self.notes.set(notes_of(key, &kept).unwrap_or_default());
        }
        self.options.set(how.options());
        self.stage.set(Stage::Reading { done: 0.0, of, telegrams: 0, since: Date::now() });
    }

    fn forget(&self) {
        self.overview.set(None);
        self.findings.set(Vec::new());
        self.proposals.set(Vec::new());
        self.seen.set(Vec::new());
        self.lanes.set(Lanes::default());
        self.total.set(0);
        self.rows.set((0, Vec::new()));
        self.current.set(None);
        self.lights.chosen.set(None);
        self.finding.set(None);
        self.only.set(false);
        self.series.set(None);
        self.held.set(Vec::new());
        self.unread.set(None);
        self.sample.set(String::new());
        self.digest.set(None);
        self.passed.set(None);
    }

    pub fn ask(&self, request: Request) {
        // Who goes along the list hears its rows; who jumps hears where to.
        if let Request::Show(which) = &request {
            self.jumps.set_value(!matches!(which, Which::At(_)));
        }
        self.client().ask(request);
    }

    /// The devices are others, or set up in another way.
    pub fn set_up(&self, how: How) {
        self.options.set(how.options());
        self.ask(Request::SetUp(how));
    }

    /// Stops reading; what was read so far is shown.
    pub fn stop(&self) {
        self.ask(Request::Stop);
    }

    /// Changes which telegrams the list has.
    pub fn filter_by(&self, change: impl FnOnce(&mut Filter)) {
        self.filter.update(change);
        self.list();
    }

    /// The list has everything again.
    pub fn show_all(&self) {
        self.filter.set(Filter::default());
        self.finding.set(None);
        self.only.set(false);
        self.list();
    }

    /// Whether the list leaves something out.
    pub fn is_filtered(&self) -> bool {
        self.only.get() || self.filter.with(|filter| *filter != Filter::default())
    }

    fn list(&self) {
        let finding = self.finding.get_untracked().filter(|_| self.only.get_untracked());
        self.ask(Request::List(Choice { filter: self.filter.get_untracked(), finding }));
    }

    /// Follows a finding: its telegrams are marked, and the first one is shown.
    pub fn follow(&self, finding: usize) {
        self.finding.set(Some(finding));
        if self.only.get_untracked() {
            self.list();
        }
        self.step_in_finding(None);
        self.to_list.notify();
    }

    /// Lets go of the finding.
    pub fn leave_finding(&self) {
        self.finding.set(None);
        if self.only.get_untracked() {
            self.only.set(false);
            self.list();
        }
    }

    /// The list has only the telegrams of the finding, or marks them.
    pub fn show_only(&self, only: bool) {
        self.only.set(only);
        self.list();
    }

    /// The next telegram of the finding from the one that is shown, or the one before; the first one
    /// where no direction is said.
    pub fn step_in_finding(&self, forwards: Option<bool>) {
        let at = self.current.with_untracked(|current| current.as_ref().map(|it| it.told.row.index as u32));
        let next = self.with_evidence(|evidence| match (forwards, at) {
            (Some(true), Some(at)) => evidence.iter().find(|index| **index > at).copied(),
            (Some(false), Some(at)) => evidence.iter().rev().find(|index| **index < at).copied(),
            _ => evidence.first().copied(),
        });
        if let Some(index) = next.flatten() {
            self.ask(Request::Show(Which::Index(index as usize)));
        }
    }

    /// The telegrams that show the finding that is followed.
    pub fn with_evidence<T>(&self, look: impl FnOnce(&[u32]) -> T) -> Option<T> {
        let finding = self.finding.get()?;
        self.findings.with(|findings| findings.get(finding).map(|finding| look(&finding.evidence)))
    }

    /// Shows the telegram at a place of the list.
    pub fn select(&self, place: usize) {
        self.ask(Request::Show(Which::At(place)));
    }

    /// The rows from `first` on come into sight.
    pub fn see(&self, first: usize) {
        let (known, count) = self.rows.with_untracked(|(first, rows)| (*first, rows.len()));
        let total = self.total.get_untracked();
        let enough = first >= known && (first + ASKED / 2).min(total) <= known + count;
        if !enough {
            self.ask(Request::Rows { from: first.saturating_sub(ASKED / 4), count: ASKED });
        }
    }

    /// Notes something on the telegram that is shown.
    pub fn note(&self, text: &str) {
        let number = self.current.with_untracked(|current| current.as_ref().map(|it| it.told.row.index + 1));
        let Some(number) = number else { return };
        self.notes.update(|notes| match text.trim() {
            "" => drop(notes.remove(&number)),
            text => drop(notes.insert(number, text.to_owned())),
        });
        let notes = self.notes.with_untracked(|notes| {
            notes.iter().map(|(number, text)| format!("{number}\t{text}\n")).collect::<String>()
        });
        let kept = format!("{}\n{notes}", self.key.get_untracked());
        if let Err(why) = storage::keep(NOTES, &kept) {
            self.toasts.say(format!("The note is not kept. {}", why.sentence()));
        }
    }

    pub fn export(&self, kind: Export) {
        self.ask(Request::Export { kind, notes: self.notes.get_untracked() });
    }

    fn hear(&self, answer: Answer, beside: Option<Blob>) {
        match answer {
            Answer::Hello | Answer::Found => {}
            Answer::Progress { done, telegrams } => self.stage.update(|stage| {
                if let Stage::Reading { done: old, telegrams: before, .. } = stage {
                    (*old, *before) = (done, telegrams);
                }
            }),
            Answer::Growing(overview) => self.overview.set(Some(Arc::from(overview))),
            Answer::Grown(list) => self.grown(list),
            Answer::Refused(why) => {
                self.toasts.announce(why.clone());
                self.forget();
                self.stage.set(Stage::Refused(why));
            }
            Answer::Lost(why) => {
                self.toasts.announce(why.clone());
                self.stage.set(Stage::Lost(why));
            }
            Answer::Ready(overview) => {
                self.toasts.announce(format!(
                    "{}: {}",
                    many(overview.telegrams, "telegram"),
                    overview.headline
                ));
                self.is_new.set_value(true);
                self.overview.set(Some(Arc::from(overview)));
                self.stage.set(Stage::Ready);
            }
            Answer::Findings(findings) => {
                if self.finding.get_untracked().is_some_and(|finding| finding >= findings.len()) {
                    self.finding.set(None);
                    self.only.set(false);
                }
                self.findings.set(findings);
                // The reader knows nothing yet of what the list has.
                if self.only.get_untracked()
                    || self.filter.with_untracked(|filter| *filter != Filter::default())
                {
                    let state = *self;
                    Timeout::new(0, move || state.list()).forget();
                }
            }
            Answer::Beside { proposals, seen } => {
                self.proposals.set(in_order(proposals, |proposed| std::cmp::Reverse(proposed.bits)));
                self.seen.set(seen);
            }
            Answer::Lanes(lanes) => self.lanes.set(lanes),
            Answer::List(total) => {
                self.total.set(total);
                self.rows.set((0, Vec::new()));
                self.lists.update(|lists| *lists += 1);
                let state = *self;
                // Not from within an answer: the client is still giving it.
                Timeout::new(0, move || state.listed()).forget();
            }
            Answer::Rows { from, rows } => self.rows.set((from, rows)),
            Answer::Shown(told) => {
                let options = self.options.get_untracked();
                let shown = (told.discarded.is_none()).then(|| {
                    let report = Arc::new(told.excerpt.report(&options));
                    Shown::of(&report, told.excerpt.place, &options)
                });
                let same = self.current.with_untracked(|current| {
                    current.as_ref().is_some_and(|current| current.told.row.index == told.row.index)
                });
                if !same {
                    self.lights.chosen.set(None);
                }
                if self.jumps.try_update_value(std::mem::take).unwrap_or_default() {
                    let row = &told.row;
                    let state = Some(row.state.word()).filter(|_| row.state != State::Plain);
                    let said: Vec<&str> = [row.said.as_str()].into_iter().chain(state).collect();
                    self.toasts.announce(format!("Telegram {}: {}.", row.index + 1, said.join(", ")));
                }
                self.current.set(Some(Arc::new(Current { told: *told, shown: shown.flatten() })));
            }
            Answer::NothingThere => self.toasts.say("There is no further one."),
            Answer::Series(values) => self.series.set(Some(values)),
            Answer::Held(held) => self.held.set(held),
            Answer::Unread { lines, more } => self.unread.set(Some(Unread { lines, more })),
            Answer::Sample(line) => self.sample.set(line),
            Answer::Digest(digest) => self.digest.set(Some(Arc::new(*digest))),
            Answer::PassedOn(passed) => self.passed.set(beside.map(|file| (passed, file))),
            Answer::Exported(kind) => {
                if let Some(blob) = beside {
                    file::save_blob(kind.file().0, &blob);
                }
            }
        }
    }

    /// The list has more telegrams at its end.
    fn grown(&self, list: usize) {
        let before = self.total.get_untracked();
        self.total.set(list);
        let (from, known) = self.rows.with_untracked(|(from, rows)| (*from, rows.len()));
        // The end was in sight.
        if from + known >= before {
            let state = *self;
            Timeout::new(0, move || state.ask(Request::Rows { from, count: ASKED })).forget();
        }
    }

    /// The list is another one.
    fn listed(&self) {
        let total = self.total.get_untracked();
        // The first list has what was told of the log just now.
        if !self.is_new.try_update_value(std::mem::take).unwrap_or_default() {
            self.toasts.announce(format!("{} in the list", many(total, "telegram")));
        }
        self.ask(Request::Rows { from: 0, count: ASKED });
        let shown = self.current.with_untracked(|current| current.as_ref().map(|it| it.told.row.index));
        match shown {
            // It is the same as before.
            Some(index) => self.client().ask(Request::Show(Which::Index(index))),
            None if total > 0 => self.select(0),
            None => {}
        }
    }
}

/// The notes on the log `key`, if it was the last one with notes.
fn notes_of(key: &str, kept: &str) -> Option<BTreeMap<usize, String>> {
    let notes = kept.strip_prefix(key)?.strip_prefix('\n')?;
    let note = |line: &str| {
        let (number, text) = line.split_once('\t')?;
        Some((number.parse().ok()?, text.to_owned()))
    };
    Some(notes.lines().filter_map(note).collect())
}

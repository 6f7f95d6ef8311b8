//! What Read is about. Everything it shows follows from what is here, and only the methods here change
//! it. It outlasts the view.

use std::sync::Arc;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;
use leptos::task::spawn_local;
use wasm_bindgen_futures::JsFuture;
use web_sys::js_sys::{Array, Uint8Array};
use web_sys::{Blob, File};

use super::log::LogState;
use crate::address::{Address, FILE};
use crate::browser::kept_file;
use crate::components::byte_strip::Lights;
use crate::components::telegram::Shown;
use crate::components::toast::Toasts;
use crate::later::{Later, Part as ModulePart};
use crate::views::devices::DeviceSettings;
use crate::worker::client::SMALL;
use crate::worker::messages::{How, Marked, Part};
use buslens::field::{Direction, Span, count, hex};
use buslens::tool::link::Link;
use buslens::tool::log::State;
use buslens::tool::{Options, Profile, Protocol, Report, decode, decode_pasted};

/// So many telegrams are looked at one by one; more are a log.
const FEW: usize = 8;

/// What is shown of what was put in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Nothing was put in.
    Start,
    /// Some telegrams, and the input to change them.
    Telegrams,
    /// Many, which take a part of the module that comes later: without it they are shown like a few.
    Log,
}

#[derive(Clone, Copy)]
pub struct ReadState {
    address: Address,
    toasts: Toasts,
    devices: DeviceSettings,
    text: RwSignal<String>,
    /// The text as far as it is read: long ones are read at a pause, so that typing is never held up.
    settled: RwSignal<String>,
    settling: StoredValue<Option<Timeout>, LocalStorage>,
    /// The text as it was put in, which notes belong to.
    key: RwSignal<String>,
    /// The file that is read in the place of the text, where it is too large for that, or is none.
    file: RwSignal<Option<Opened>, LocalStorage>,
    /// The name of the file that the text is of.
    text_name: RwSignal<Option<String>>,
    /// A file that was open at the last visit and that this browser has not kept.
    pub missing: RwSignal<Option<String>>,
    choices: RwSignal<Choices>,
    report: Memo<Shared>,
    mode: Memo<Mode>,
    index: RwSignal<usize>,
    shown: Memo<Option<Shown>>,
    pub lights: Lights,
    /// Somebody types: the input stays, whatever it becomes.
    pub editing: RwSignal<bool>,
    pub log: LogState,
}

/// How the input is read, where a person says so.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Choices {
    /// Their keys.
    pub protocol: String,
    pub device: String,
    pub direction: String,
    pub input: String,
    pub decimal: Option<bool>,
    pub marks: Option<Marked>,
}

/// A file that is open.
#[derive(Clone)]
pub struct Opened {
    pub name: String,
    /// Tells it from others, also in the next visit.
    pub key: String,
    pub blob: Blob,
}

/// A report, which each reading makes anew.
#[derive(Clone)]
struct Shared(Arc<Report>);

impl PartialEq for Shared {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// What the log's reader was given.
#[derive(Clone, PartialEq)]
enum Given {
    Text(String),
    /// The key of a file.
    File(String),
}

impl ReadState {
    pub fn new() -> Self {
        let (address, toasts, devices) = (expect_context(), expect_context(), expect_context());
        let later = expect_context::<Later>();
        let text = RwSignal::new(String::new());
        let settled = RwSignal::new(String::new());
        let file = RwSignal::new_local(None::<Opened>);
        let choices = RwSignal::new(Choices::default());
        let options = move || options(&choices.read(), devices);
        let report = Memo::new(move |_| Shared(Arc::new(settled.with(|text| read(text, options())))));
        let mode = Memo::new(move |_| {
            let has_file = file.with(Option::is_some);
            let report = report.get().0;
            let timed = report.telegrams.iter().any(|telegram| telegram.time.is_some());
            match report.telegrams.len() {
                _ if has_file => Mode::Log,
                0 if settled.with(|text| text.trim().is_empty()) => Mode::Start,
                n if (n > FEW || n > 2 && timed) && !later.has_failed(ModulePart::Log) => Mode::Log,
                _ => Mode::Telegrams,
            }
        });
        let index = RwSignal::new(0);
        let shown = Memo::new(move |_| {
            let Shared(report) = report.get();
            let last = report.telegrams.len().checked_sub(1)?;
            (mode.get() == Mode::Telegrams).then(|| Shown::of(&report, index.get().min(last), &options()))?
        });
        let lights = Lights::new();
        // What was chosen among the bytes of another telegram means nothing any more.
        let other = Memo::new(move |_| (index.get(), report.with(|report| report.0.telegrams.len())));
        Effect::watch(move || other.get(), move |_, _, _| lights.clear(), false);
        Self {
            address,
            toasts,
            devices,
            text,
            settled,
            settling: StoredValue::new_local(None),
            key: RwSignal::default(),
            file,
            text_name: RwSignal::default(),
            missing: RwSignal::default(),
            choices,
            report,
            mode,
            index,
            shown,
            lights,
            editing: RwSignal::default(),
            log: LogState::new(toasts),
        }
    }

    /// From now on the log's reader gets whatever is a log, and how it is to be read.
    pub fn read_logs(self) {
        self.log.start();
        let waiting = StoredValue::new_local(None::<Timeout>);
        Effect::new(move |before: Option<Option<(Given, How)>>| {
            let how = self.how();
            let given = match (self.mode.get(), self.file.get()) {
                (Mode::Log, Some(file)) => Given::File(file.key),
                (Mode::Log, None) => Given::Text(self.settled.get()),
                _ => {
                    waiting.set_value(None);
                    if before.flatten().is_some() {
                        self.log.close();
                    }
                    return None;
                }
            };
            let before = before.flatten();
            let same = |(old, was): &(Given, How)| {
                let devices =
                    How { device: how.device.clone(), settings: how.settings.clone(), ..was.clone() };
                *old == given && devices == how
            };
            match (&given, &before) {
                (_, Some(old)) if same(old) => {
                    if old.1 != how {
                        self.log.set_up(how.clone());
                    }
                }
                // While somebody types, a pause is waited for.
                (Given::Text(text), Some((Given::Text(_), _))) => {
                    const PAUSE: u32 = 300;
                    let (text, how, key) = (text.clone(), how.clone(), self.key.get_untracked());
                    let read = move || self.log.open_bytes(&key, text.into_bytes(), &how);
                    waiting.set_value(Some(Timeout::new(PAUSE, read)));
                }
                (Given::Text(text), _) => {
                    self.log.open_bytes(&self.key.get_untracked(), text.clone().into_bytes(), &how);
                }
                (Given::File(key), _) => {
                    if let Some(file) = self.file.get_untracked() {
                        self.log.open_file(key, file.blob, how.clone());
                    }
                }
            }
            Some((given, how))
        });
    }

    pub fn mode(&self) -> Mode {
        self.mode.get()
    }

    pub fn text(&self) -> String {
        self.text.get()
    }

    pub fn with_text<T>(&self, look: impl FnOnce(&str) -> T) -> T {
        self.text.with(|text| look(text))
    }

    /// The text that the report is of.
    pub fn with_settled<T>(&self, look: impl FnOnce(&str) -> T) -> T {
        self.settled.with(|text| look(text))
    }

    /// What the text holds.
    pub fn report(&self) -> Arc<Report> {
        self.report.get().0
    }

    /// Which of its telegrams is shown.
    pub fn index(&self) -> usize {
        self.index.get()
    }

    /// That telegram with its details.
    pub fn shown(&self) -> Option<Shown> {
        self.shown.get()
    }

    pub fn choices(&self) -> Choices {
        self.choices.get()
    }

    /// What the input is called, where it has a name.
    pub fn file_name(&self) -> Option<String> {
        let file = self.file.with(|file| file.as_ref().map(|file| file.name.clone()));
        file.or_else(|| self.text_name.get())
    }

    /// Whether the input is text that can be edited.
    pub fn is_text(&self) -> bool {
        self.file.with(Option::is_none)
    }

    /// What is shown, in a few words: tabs and the browser's history tell pages apart by it.
    pub fn title(&self) -> Option<String> {
        match self.mode() {
            Mode::Start => None,
            Mode::Telegrams => self.shown.with(|shown| Some(shown.as_ref()?.detail.meaning().sentence())),
            Mode::Log => Some(self.file_name().unwrap_or_else(|| "pasted log".to_owned())),
        }
    }

    /// How telegrams are read, with how the devices are set up.
    pub fn options(&self) -> Options {
        options(&self.choices.read(), self.devices)
    }

    fn how(&self) -> How {
        let choices = self.choices.get();
        How {
            input: (!choices.input.is_empty()).then_some(choices.input),
            decimal: choices.decimal,
            marks: choices.marks,
            ..How::of(&self.options())
        }
    }

    /// The input was edited; the telegram at the cursor is shown.
    pub fn type_text(&self, text: String, cursor: usize) {
        if text.len() > SMALL {
            return self.load(text);
        }
        /// What is not longer is read within a frame.
        const SHORT: usize = 4096;
        const PAUSE: u32 = 150;
        self.missing.set(None);
        self.editing.set(true);
        self.text.set(text.clone());
        let state = *self;
        let settle = move || {
            state.settled.set(text);
            state.follow_cursor(cursor);
            state.announce();
        };
        if self.text.with_untracked(String::len) <= SHORT {
            self.settling.set_value(None);
            settle();
        } else {
            // What waited before is dropped, and so never done.
            self.settling.set_value(Some(Timeout::new(PAUSE, settle)));
        }
        self.address.typed();
    }

    /// The cursor moved in the input.
    pub fn follow_cursor(&self, cursor: usize) {
        let Shared(report) = self.report.get_untracked();
        let at = report.telegrams.iter().position(|telegram| cursor <= telegram.line.span.to);
        if let Some(index) = at {
            self.select(index);
        }
    }

    /// Shows another telegram.
    pub fn select(&self, index: usize) {
        if index != self.index.get_untracked() {
            self.index.set(index);
            self.address.chosen();
        }
    }

    /// Puts `text` in the place of what was put in. What was typed comes back on request.
    pub fn load(&self, text: String) {
        if text.len() > SMALL {
            let parts = Array::of1(&text.into());
            if let Ok(blob) = Blob::new_with_str_sequence(&parts) {
                self.open_blob("pasted text".to_owned(), blob, 0.0);
            }
            return;
        }
        self.offer_undo();
        self.editing.set(false);
        self.put(text);
        self.index.set(first_of_interest(&self.report.get_untracked().0));
        self.address.chosen();
        self.announce();
    }

    /// Loads an example.
    pub fn load_example(&self, text: &str, device: &str) {
        self.load(text.to_owned());
        self.read_as(|choices| *choices = Choices { device: device.to_owned(), ..Choices::default() });
        self.index.set(first_of_interest(&self.report.get_untracked().0));
    }

    /// Puts `bytes` in the place of those of the telegram that is shown.
    pub fn correct(&self, bytes: Vec<u8>) {
        let (text, Shared(report)) = (self.settled.get_untracked(), self.report.get_untracked());
        let index = self.index.get_untracked();
        let places = report.telegrams.get(index).map(|telegram| telegram.line.places.as_slice());
        let Some([first, .., last]) = places else { return };
        let (Some(before), Some(behind)) = (text.get(..first.from), text.get(last.to..)) else { return };
        let text = format!("{before}{}{behind}", hex(&bytes));
        self.offer_undo();
        self.put(text);
        self.index.set(index);
        self.address.chosen();
        self.announce();
    }

    /// Empties the input.
    pub fn clear(&self) {
        self.offer_undo();
        self.editing.set(false);
        self.put(String::new());
        self.choices.update(|choices| choices.marks = None);
        self.address.chosen();
    }

    fn put(&self, text: String) {
        self.missing.set(None);
        self.file.set(None);
        self.text_name.set(None);
        self.settling.set_value(None);
        self.lights.clear();
        self.key.set(format!("text {:x}", hash(&text)));
        self.text.set(text.clone());
        self.settled.set(text);
    }

    /// What is about to be replaced can be had again.
    fn offer_undo(&self) {
        let (state, text) = (*self, self.text.get_untracked());
        let file = self.file.get_untracked();
        if file.is_some() || text.trim().is_empty() {
            return;
        }
        let (index, choices) = (self.index.get_untracked(), self.choices.get_untracked());
        let undo = move || {
            state.put(text.clone());
            state.choices.set(choices.clone());
            state.index.set(index);
            state.address.chosen();
        };
        self.toasts.offer("What was typed before is replaced.", "Undo", undo);
    }

    /// A person says how the input is to be read.
    pub fn read_as(&self, set: impl FnOnce(&mut Choices)) {
        self.choices.update(set);
        self.address.chosen();
    }

    /// Opens the file that is chosen with a button.
    pub fn opener(self) -> Callback<File> {
        Callback::new(move |file| self.open(file))
    }

    /// Opens a file of any size.
    pub fn open(&self, file: File) {
        let state = *self;
        let name = file.name();
        if file.size() > SMALL as f64 {
            return self.open_blob(name, file.clone().into(), file.last_modified());
        }
        spawn_local(async move {
            let Ok(buffer) = JsFuture::from(file.array_buffer()).await else {
                state.toasts.say(format!(
                    "{name} cannot be read: it is a folder, it is gone, or this browser may not open it."
                ));
                return;
            };
            let bytes = Uint8Array::new(&buffer).to_vec();
            match String::from_utf8(bytes) {
                _ if file.size() == 0.0 => state.toasts.say(format!("{name} is empty.")),
                Ok(text) if !text.contains('\0') => {
                    state.load(text.trim_start_matches('\u{FEFF}').to_owned());
                    state.text_name.set(Some(name));
                }
                _ => state.open_blob(name, file.clone().into(), file.last_modified()),
            }
        });
    }

    fn open_blob(&self, name: String, blob: Blob, modified: f64) {
        // Whole numbers: what writes floats weighs 7 kB.
        let key = format!("{name}|{}|{}", blob.size() as u64, modified as i64);
        self.offer_undo();
        self.missing.set(None);
        self.editing.set(false);
        self.settling.set_value(None);
        self.text.set(String::new());
        self.settled.set(String::new());
        self.choices.update(|choices| choices.marks = None);
        self.file.set(Some(Opened { name, key: key.clone(), blob: blob.clone() }));
        self.address.chosen();
        spawn_local(async move {
            // Where the browser does not keep it, the next visit asks for it by its name.
            let _ = kept_file::keep(&key, &blob).await;
        });
    }

    /// Keeps the open file for a reload; whether the browser did it. Another tab may have kept its own
    /// in the meantime.
    pub async fn keep_file(&self) -> bool {
        match self.file.get_untracked() {
            Some(file) => kept_file::keep(&file.key, &file.blob).await,
            None => true,
        }
    }

    /// Reads the open file once more.
    pub fn read_again(&self) {
        self.file.update(|_| {});
        let file = self.file.get_untracked();
        match file {
            Some(file) => self.log.open_file(&file.key, file.blob, untrack(|| self.how())),
            None => {
                let text = self.text.get_untracked();
                self.log.open_bytes(&self.key.get_untracked(), text.into_bytes(), &untrack(|| self.how()));
            }
        }
    }

    /// A part of the sample line is what a person says it is.
    pub fn mark(&self, line: String, part: Part, span: Span) {
        self.read_as(|choices| {
            let marks = choices.marks.get_or_insert_default();
            if marks.line != line {
                *marks = Marked { line, parts: Vec::new() };
            }
            marks.parts.retain(|(other, _)| *other != part);
            marks.parts.push((part, (span.from, span.to)));
        });
    }

    fn announce(&self) {
        let Shared(report) = self.report.get_untracked();
        let summary = report.summary();
        let telegrams = count(summary.telegrams, "telegram");
        let checks = match summary.check_failed {
            0 => "no wrong checksum".to_owned(),
            failed => count(failed, "wrong checksum"),
        };
        match summary.telegrams {
            0 => {}
            1 => {
                let said = report.detail(0).map_or(String::new(), |detail| detail.meaning().sentence() + ".");
                self.toasts.announce(format!("{telegrams}, {checks}. {said}"));
            }
            _ => self.toasts.announce(format!("{telegrams}, {checks}")),
        }
    }

    pub fn link(&self) -> Link {
        let entries = self.file.with_untracked(|file| {
            file.iter().map(|file| (FILE.to_owned(), file.key.clone())).collect::<Vec<_>>()
        });
        Link {
            text: self.text.get_untracked(),
            options: untrack(|| self.options()),
            telegram: self.index.get_untracked(),
            entries,
            ..Link::default()
        }
    }

    pub fn follow(&self, link: Link) {
        let Link { text, options, telegram, entries, .. } = link;
        self.devices.bring(&options.settings);
        self.choices.set(Choices {
            protocol: options.protocol.map_or(String::new(), |it| it.key.to_owned()),
            device: options.device.map_or(String::new(), |it| it.key.to_owned()),
            direction: options.direction.map_or(String::new(), |it| it.key().to_owned()),
            ..Choices::default()
        });
        self.editing.set(false);
        let Some((_, key)) = entries.into_iter().find(|(path, _)| path == FILE) else {
            self.put(text);
            return self.index.set(telegram);
        };
        if self.file.with_untracked(|file| file.as_ref().is_some_and(|file| file.key == key)) {
            return;
        }
        self.put(String::new());
        let state = *self;
        spawn_local(async move {
            let name = key.split('|').next().unwrap_or_default().to_owned();
            match kept_file::kept(&key).await {
                Some(blob) => state.file.set(Some(Opened { name, key, blob })),
                None => state.missing.set(Some(name)),
            }
        });
    }
}

fn read(text: &str, options: Options) -> Report {
    if options.direction.is_some() {
        return decode(text, options);
    }
    // What is no log at all is still looked at, line by line.
    decode_pasted(text, options.clone()).unwrap_or_else(|_| decode(text, options))
}

fn options(choices: &Choices, devices: DeviceSettings) -> Options {
    Options {
        protocol: Protocol::of(&choices.protocol),
        device: Profile::of(&choices.device),
        direction: Direction::of(&choices.direction),
        settings: devices.settings(),
    }
}

/// What somebody looks for in what was put in: the first telegram with which something is wrong, or else
/// the first answer.
fn first_of_interest(report: &Report) -> usize {
    let states: Vec<State> = (0..report.telegrams.len().min(100)).map(|index| report.state(index)).collect();
    let wrong = states.iter().position(|state| state.is_wrong());
    wrong.or(states.iter().position(|state| *state == State::Ok)).unwrap_or_default()
}

/// Tells texts apart (FNV-1a).
fn hash(text: &str) -> u64 {
    text.bytes()
        .fold(0xCBF2_9CE4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3))
}

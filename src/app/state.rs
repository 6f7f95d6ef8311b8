//! What the page is about. Everything shown follows from the signals here, and only the methods
//! here change them.

use leptos::prelude::*;

use super::address::{self, Shows, Step};
use super::browser;
use buslens::field::{Direction, Field, Message, Span, count, leaves};
use buslens::tool::link::Link;
use buslens::tool::{Detail, Explanation, Options, Report, Settings, Summary, Telegram, decode};

/// The page's state, as handed to every part of it.
#[derive(Clone, Copy)]
pub struct State {
    /// What was typed, and all that follows from it.
    pub decoded: RwSignal<Decoded>,
    /// The bytes under the pointer.
    pointed: RwSignal<Option<Span>>,
    /// The bytes chosen by tap, click or keyboard.
    pub chosen: RwSignal<Option<Chosen>>,
    /// How far the list of telegrams is scrolled, in pixels.
    pub scrolled: RwSignal<usize>,
}

/// The input and what it says.
#[derive(Default)]
pub struct Decoded {
    pub text: String,
    /// How the input is to be read, where a person said so.
    pub options: Options,
    pub report: Report,
    /// The telegram that is shown, if there is one.
    pub shown: Option<Shown>,
}

/// A telegram with all its details.
pub struct Shown {
    pub index: usize,
    /// How many telegrams there are.
    pub of: usize,
    pub telegram: Telegram,
    pub detail: Detail,
    /// What may have happened where its check failed, best first.
    pub causes: Vec<Explanation>,
    /// Why that cannot be told, if so.
    pub undecidable: Option<Message>,
}

impl Shown {
    /// Telegram `index` of a report, which is number `number` of `of` for a person, from 0.
    pub fn of(report: &Report, index: usize, number: usize, of: usize) -> Option<Self> {
        Some(Self {
            index: number,
            of,
            telegram: report.telegrams.get(index)?.clone(),
            detail: report.detail(index)?,
            causes: report.explanations(index),
            undecidable: report.undecidable(index),
        })
    }
}

/// Chosen bytes, and which one of them is explained.
#[derive(Clone, Copy, PartialEq)]
pub struct Chosen {
    pub span: Span,
    pub at: usize,
}

impl Shown {
    pub fn bytes(&self) -> &[u8] {
        &self.telegram.line.bytes
    }

    /// The leaves that hold bytes.
    pub fn leaves(&self) -> Vec<&Field> {
        let mut leaves = leaves(&self.detail.fields);
        leaves.retain(|leaf| !leaf.span.is_empty());
        leaves
    }
}

impl Decoded {
    /// The index of the telegram that is shown.
    pub fn index(&self) -> usize {
        self.shown.as_ref().map_or(0, |shown| shown.index)
    }

    fn decode(&mut self) {
        self.report = decode(&self.text, self.options.clone());
    }

    /// Shows telegram `index`, or the last one if there are fewer.
    fn show(&mut self, index: usize) {
        let of = self.report.telegrams.len();
        let index = index.min(of.saturating_sub(1));
        self.shown = Shown::of(&self.report, index, index, of);
    }
}

impl State {
    pub fn new() -> Self {
        Self {
            decoded: RwSignal::default(),
            pointed: RwSignal::default(),
            chosen: RwSignal::default(),
            scrolled: RwSignal::default(),
        }
    }

    /// The input was edited; the telegram at the cursor is shown.
    pub fn type_text(&self, text: String, cursor: usize) {
        self.change(|decoded| {
            decoded.text = text;
            decoded.decode();
            decoded.show(telegram_at(&decoded.report, cursor).unwrap_or(decoded.index()));
        });
        address::renew(Step::Typed);
        browser::announce(announcement(self.decoded.with_untracked(|decoded| decoded.report.summary())));
    }

    /// Puts `text` in place of the input; the browser's undo takes it back.
    pub fn load(&self, text: &str) {
        // The replaced text comes back to us as an input event.
        browser::replace_undoably(browser::INPUT, text);
        self.read_as(|options| options.direction = None);
    }

    /// Shows what was built, read as what it is.
    pub fn show_built(&self, text: String, options: Options) {
        self.change(|decoded| {
            decoded.text = text;
            decoded.options = Options { settings: decoded.options.settings.clone(), ..options };
            decoded.decode();
            decoded.show(usize::MAX);
        });
    }

    /// How the user's devices are set up.
    pub fn settings(&self) -> Settings {
        self.decoded.with_untracked(|decoded| decoded.options.settings.clone())
    }

    /// The user's devices are set up in another way.
    pub fn set_up(&self, settings: Settings) {
        self.decoded.update_untracked(|decoded| decoded.options.settings = settings);
    }

    /// The cursor moved in the input.
    pub fn follow_cursor(&self, cursor: usize) {
        if let Some(index) = self.decoded.with_untracked(|decoded| telegram_at(&decoded.report, cursor)) {
            self.select(index);
        }
    }

    /// A person says how the input is to be read.
    pub fn read_as(&self, set: impl FnOnce(&mut Options)) {
        self.change(|decoded| {
            set(&mut decoded.options);
            decoded.decode();
            decoded.show(decoded.index());
        });
        // An example or a click elsewhere may have chosen.
        self.decoded.with_untracked(|decoded| show_options(&decoded.options));
        address::renew(Step::Chosen);
    }

    /// Shows another telegram.
    pub fn select(&self, index: usize) {
        if index != self.decoded.with_untracked(Decoded::index) {
            self.change(|decoded| decoded.show(index));
            address::renew(Step::Chosen);
        }
    }

    /// The bytes to light up: those under the pointer, or else those chosen.
    pub fn lit(&self) -> Option<Span> {
        self.pointed.get().or(self.chosen.get().map(|chosen| chosen.span))
    }

    /// The pointer is over these bytes, or over none.
    pub fn point(&self, span: Option<Span>) {
        if span != self.pointed.get_untracked() {
            self.pointed.set(span);
            browser::light(untrack(|| self.lit()));
        }
    }

    /// These bytes are chosen, or none.
    pub fn choose(&self, chosen: Option<Chosen>) {
        if chosen != self.chosen.get_untracked() {
            self.chosen.set(chosen);
            browser::light(untrack(|| self.lit()));
        }
    }

    /// Changes what is shown. What was chosen among the bytes before means nothing any more.
    fn change(&self, change: impl FnOnce(&mut Decoded)) {
        self.point(None);
        self.choose(None);
        let before = self.decoded.with_untracked(Decoded::index);
        self.decoded.update(change);
        let index = self.decoded.with_untracked(Decoded::index);
        if index != before {
            browser::keep_in_sight(index);
        }
    }
}

impl Shows for State {
    fn key(&self) -> &'static str {
        "decode"
    }

    fn link(&self) -> Link {
        self.decoded.with_untracked(|decoded| Link {
            telegram: decoded.index(),
            ..Link::to(decoded.text.clone(), decoded.options.clone())
        })
    }

    fn follow(&self, link: Link) {
        let Link { text, options, telegram, .. } = link;
        browser::set_field(browser::INPUT, &text);
        show_options(&options);
        self.change(|decoded| {
            (decoded.text, decoded.options) = (text, options);
            decoded.decode();
            decoded.show(telegram);
        });
    }
}

/// Chooses in the lists of the page how the input is read.
fn show_options(options: &Options) {
    browser::set_field(browser::PROTOCOL, options.protocol.map_or("", |it| it.key));
    browser::set_field(browser::DIRECTION, options.direction.map_or("", Direction::key));
    browser::set_field(browser::DEVICE, options.device.map_or("", |it| it.key));
}

/// The telegram at byte `cursor` of the text, or the next one.
fn telegram_at(report: &Report, cursor: usize) -> Option<usize> {
    report.telegrams.iter().position(|telegram| cursor <= telegram.line.span.to)
}

fn announcement(summary: Summary) -> String {
    match (summary.telegrams, summary.check_failed) {
        (0, _) => String::new(),
        (n, 0) => format!("{}, no failed check", count(n, "telegram")),
        (n, failed) => format!("{}, {} failed", count(n, "telegram"), count(failed, "check")),
    }
}

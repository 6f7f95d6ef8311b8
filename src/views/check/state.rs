//! What is checked, and how far it is followed.

use leptos::prelude::*;

use crate::address::Address;
use buslens::field::hex;
use buslens::tool::link::Link;
use buslens::tool::steps::{Algorithm, CHECKS, Deed, MOST, Step, bytes, steps};

/// What Check shows.
#[derive(Clone, Copy)]
pub struct CheckState {
    text: RwSignal<String>,
    algorithm: RwSignal<&'static Algorithm>,
    /// What a person says of the last bytes; else they tell it themselves.
    ending: RwSignal<Option<Ending>>,
    at: RwSignal<usize>,
    pub playing: RwSignal<bool>,
    work: Memo<Work>,
    address: Address,
}

/// What the last bytes are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    Check,
    Data,
}

/// The check, worked out.
#[derive(Clone, Debug)]
pub struct Work {
    pub algorithm: &'static Algorithm,
    /// All bytes of the text.
    pub bytes: Vec<u8>,
    /// The check is over so many of them.
    pub covered: usize,
    pub steps: Vec<Step>,
    /// Something was typed, but no bytes.
    pub nonsense: bool,
}

impl PartialEq for Work {
    fn eq(&self, other: &Self) -> bool {
        // All else follows from these.
        (self.algorithm.kind, &self.bytes, self.covered, self.nonsense)
            == (other.algorithm.kind, &other.bytes, other.covered, other.nonsense)
    }
}

impl Work {
    fn of(text: &str, algorithm: &'static Algorithm, ending: Option<Ending>) -> Self {
        let bytes = bytes(text);
        let width = algorithm.width;
        let before = bytes.len().saturating_sub(width);
        let matches =
            || before > 0 && bytes.len() <= MOST && wire(algorithm, &bytes[..before]) == bytes[before..];
        let covered = match ending {
            Some(Ending::Check) => before,
            Some(Ending::Data) => bytes.len(),
            None if matches() => before,
            None => bytes.len(),
        };
        let covered = covered.min(MOST);
        let nonsense = bytes.is_empty() && !text.trim().is_empty();
        Self { algorithm, steps: steps(algorithm, &bytes[..covered]), covered, bytes, nonsense }
    }

    /// The bytes that the check is over.
    pub fn data(&self) -> &[u8] {
        &self.bytes[..self.covered]
    }

    /// The check that stands behind them, if one does.
    pub fn found(&self) -> Option<&[u8]> {
        self.bytes.get(self.covered..self.covered + self.algorithm.width).filter(|_| self.covered < MOST)
    }

    /// The check as a number.
    pub fn value(&self) -> u64 {
        self.steps.last().map_or(0, |step| step.after.into())
    }

    /// The check as the wire has it.
    pub fn wire(&self) -> Vec<u8> {
        wire(self.algorithm, self.data())
    }

    pub fn last(&self) -> usize {
        self.steps.len().saturating_sub(1)
    }

    /// The step behind which the byte `index` is done with.
    pub fn done_with(&self, index: usize) -> usize {
        let own = |step: &Step| step.byte == index && !matches!(step.deed, Deed::Complement | Deed::Start);
        self.steps.iter().rposition(own).unwrap_or(0)
    }

    /// What the register holds behind the byte `index`.
    pub fn behind(&self, index: usize) -> u16 {
        self.steps.get(self.done_with(index)).map_or(0, |step| step.after)
    }
}

fn wire(algorithm: &Algorithm, bytes: &[u8]) -> Vec<u8> {
    algorithm.wire(bytes).to_be_bytes()[8 - algorithm.width..].to_vec()
}

/// What is followed where nothing else is asked for: section 2.3.1 of the Memograph's manual.
const EXAMPLE: &str = "01 03 00 C8 00 03 84 35";

/// The names of the check and of the ending in a link.
const CHECK: &str = "check";
const ENDING: &str = "ending";

impl Ending {
    const fn key(self) -> &'static str {
        match self {
            Self::Check => "check",
            Self::Data => "data",
        }
    }
}

impl CheckState {
    pub fn new() -> Self {
        let text = RwSignal::new(EXAMPLE.to_owned());
        let algorithm = RwSignal::new(CHECKS[0]);
        let ending = RwSignal::new(None);
        let work = Memo::new(move |_| text.with(|text| Work::of(text, algorithm.get(), ending.get())));
        Self {
            text,
            algorithm,
            ending,
            at: RwSignal::new(0),
            playing: RwSignal::new(false),
            work,
            address: expect_context(),
        }
    }

    pub fn text(&self) -> String {
        self.text.get()
    }

    /// Whether nobody typed yet.
    pub fn is_example(&self) -> bool {
        self.text.with_untracked(|text| text == EXAMPLE)
    }

    pub fn work(&self) -> Memo<Work> {
        self.work
    }

    /// The index of the step that is shown.
    pub fn at(&self) -> usize {
        self.at.get().min(self.work.with(Work::last))
    }

    /// The step that is shown.
    pub fn step(&self) -> Option<Step> {
        let at = self.at();
        self.work.with(|work| work.steps.get(at).copied())
    }

    /// What the last bytes are, chosen or told by themselves.
    pub fn ending(&self) -> Ending {
        self.work.with(|work| if work.found().is_some() { Ending::Check } else { Ending::Data })
    }

    /// Other bytes: from the start.
    pub fn enter(&self, text: String) {
        self.text.set(text);
        self.restart();
        self.address.typed();
    }

    pub fn choose_algorithm(&self, kind: &str) {
        if let Some(check) = CHECKS.iter().find(|check| check.kind == kind) {
            self.algorithm.set(check);
            self.restart();
            self.address.chosen();
        }
    }

    pub fn choose_ending(&self, ending: Ending) {
        self.ending.set(Some(ending));
        self.restart();
        self.address.chosen();
    }

    fn restart(&self) {
        self.playing.set(false);
        self.at.set(0);
    }

    /// Goes to the step `at`, or to the last one.
    pub fn go(&self, at: usize) {
        self.at.set(at.min(self.work.with_untracked(Work::last)));
        self.address.typed();
    }

    pub fn back(&self) {
        self.go(self.at.get_untracked().saturating_sub(1));
    }

    pub fn forward(&self) {
        self.go(self.at.get_untracked() + 1);
    }

    /// Goes to where the next byte is done with.
    pub fn next_byte(&self) {
        let at = self.at.get_untracked();
        let to = self.work.with_untracked(|work| {
            let byte = work.steps.get(at).map_or(0, |step| step.byte);
            match work.done_with(byte) {
                done if done > at => done,
                _ if byte + 1 < work.covered => work.done_with(byte + 1),
                _ => work.last(),
            }
        });
        self.go(to);
    }

    /// Goes on by itself, or stops; at the end it begins again.
    pub fn play(&self) {
        let playing = !self.playing.get_untracked();
        if playing && self.at.get_untracked() >= self.work.with_untracked(Work::last) {
            self.at.set(0);
        }
        self.playing.set(playing);
    }

    pub fn link(&self) -> Link {
        let mut entries = vec![(CHECK.to_owned(), self.algorithm.with_untracked(|it| it.kind.to_owned()))];
        entries
            .extend(self.ending.get_untracked().map(|ending| (ENDING.to_owned(), ending.key().to_owned())));
        Link {
            text: self.text.get_untracked(),
            telegram: self.at.get_untracked(),
            entries,
            ..Link::default()
        }
    }

    pub fn follow(&self, link: Link) {
        let entry = |wanted: &str| link.entries.iter().find(|(path, _)| path == wanted).map(|(_, text)| text);
        let asked = entry(CHECK);
        let algorithm = CHECKS.iter().find(|check| asked.is_some_and(|kind| check.kind == kind));
        let ending = [Ending::Check, Ending::Data]
            .into_iter()
            .find(|ending| entry(ENDING).is_some_and(|key| ending.key() == key));
        let empty = link.text.is_empty() && asked.is_none();
        self.playing.set(false);
        self.algorithm.set(algorithm.copied().unwrap_or(CHECKS[0]));
        self.ending.set(ending);
        self.text.set(if empty { EXAMPLE.to_owned() } else { link.text });
        self.at.set(link.telegram);
    }
}

/// A link to where the check of `bytes` is followed, whose last ones are the check.
pub fn link_to(bytes: &[u8], kind: &str) -> Link {
    let entries =
        vec![(CHECK.to_owned(), kind.to_owned()), (ENDING.to_owned(), Ending::Check.key().to_owned())];
    Link { text: hex(bytes), entries, ..Link::default() }
}

#[cfg(test)]
pub mod tests {
    use super::*;

    pub fn work(text: &str) -> Work {
        Work::of(text, CHECKS[0], None)
    }

    const REQUEST: &str = "01 03 00 C8 00 03 84 35";

    #[test]
    fn a_check_that_is_there_tells_itself() {
        let work = Work::of(REQUEST, CHECKS[0], None);
        assert_eq!((work.covered, work.found()), (6, Some(&[0x84, 0x35][..])));
        assert_eq!((work.value(), work.wire()), (0x3584, vec![0x84, 0x35]));
        // Over the whole frame it is 0.
        assert_eq!(Work::of(REQUEST, CHECKS[0], Some(Ending::Data)).value(), 0);
        let wrong = Work::of("01 03 00 C8 00 03 84 36", CHECKS[0], Some(Ending::Check));
        assert_eq!((wrong.found(), wrong.wire()), (Some(&[0x84, 0x36][..]), vec![0x84, 0x35]));
    }

    #[test]
    fn nonsense_is_no_check_of_nothing() {
        assert!(Work::of("hello", CHECKS[0], None).nonsense);
        assert!(!Work::of("", CHECKS[0], None).nonsense);
        for (text, ending) in [("", Ending::Check), ("01", Ending::Check), ("01 02", Ending::Check)] {
            for check in CHECKS {
                let work = Work::of(text, check, Some(ending));
                assert!(work.covered <= work.bytes.len() && work.done_with(9) <= work.last());
            }
        }
        let long = Work::of(&"01 ".repeat(5000), CHECKS[0], None);
        assert_eq!(long.covered, MOST);
    }
}

//! What somebody typed, in words: which are verbs, numbers and names, and how well a label fits one.

use super::{BEGINNING, INSIDE, NAME, WORD};
use crate::device::Access;

/// A text in words.
pub(super) struct Query {
    pub words: Vec<Word>,
    /// What is to be done, where a word says it.
    pub access: Option<Access>,
    /// A word that switches off what it is about.
    pub off: bool,
}

pub(super) struct Word {
    /// As typed.
    pub text: String,
    /// Without capitals, and without what only parts it.
    pub plain: String,
    /// It says what to do and nothing else, where nothing is called so.
    pub verb: bool,
    pub stop: bool,
    pub number: Option<Number>,
}

#[derive(Clone, Copy)]
pub(in crate::tool) struct Number {
    /// Whole numbers that can be addresses or say which one.
    pub whole: Option<u64>,
    pub hex: bool,
}

const READ: &[&str] = &["read", "get", "ask", "show", "fetch", "query", "request", "what"];
const WRITE: &[&str] =
    &["write", "set", "send", "put", "change", "switch", "turn", "load", "reset", "clear", "map", "give"];
const OFF: &[&str] = &["clear", "reset"];
const STOP: &[&str] = &[
    "to", "the", "of", "a", "an", "at", "in", "as", "with", "and", "for", "from", "is", "=", ":", "into",
    "please", "its",
];

/// What switches are called otherwise.
pub(super) const STATES: &[(&str, &str)] =
    &[("on", "active"), ("off", "inactive"), ("active", "on"), ("inactive", "off")];

/// Words for what the manuals call otherwise.
const SYNONYMS: &[(&str, &str)] = &[
    ("totalizer", "total"),
    ("totaliser", "total"),
    ("totalizers", "total"),
    ("math", "maths"),
    ("event", "event"),
    ("message", "event"),
    ("default", "factory"),
    ("defaults", "factory"),
    ("factory", "factory"),
    ("di", "digital"),
    ("ai", "universal"),
    ("analog", "universal"),
    ("analogue", "universal"),
    ("baudrate", "baud"),
    ("parity", "character"),
    ("parametrise", "parameters"),
    ("diagnostics", "diagnosis"),
    ("speed", "speed"),
    ("reference", "reference"),
    ("mapping", "mapping"),
    ("float", "float"),
    ("double", "double"),
];

impl Query {
    pub fn of(text: &str) -> Self {
        let typed = text.replace(['“', '”', '"'], " ");
        let words: Vec<Word> = typed.split_whitespace().flat_map(parts).map(|word| Word::of(&word)).collect();
        let says = |verbs: &[&str]| words.iter().any(|word| verbs.contains(&word.plain.as_str()));
        let access = match (says(READ), says(WRITE)) {
            (true, false) => Some(Access::Read),
            (false, true) => Some(Access::Write),
            // "read back" is said of writing, too.
            _ => None,
        };
        let off = says(OFF);
        Self { words, access, off }
    }
}

impl Word {
    fn of(text: &str) -> Self {
        let plain = fold(text);
        let verb = READ.contains(&plain.as_str()) || WRITE.contains(&plain.as_str());
        let stop = verb || STOP.contains(&text) || plain.is_empty();
        Self { text: text.to_owned(), verb, stop, number: Number::of(text), plain }
    }
}

impl Number {
    pub fn of(text: &str) -> Option<Self> {
        let plain = text.replace('\u{2212}', "-").to_ascii_lowercase();
        let hex = plain.strip_prefix("0x").or_else(|| plain.strip_suffix('h'));
        if let Some(digits) = hex.filter(|digits| !digits.is_empty()) {
            return u64::from_str_radix(digits, 16).ok().map(|whole| Self { whole: Some(whole), hex: true });
        }
        let digit = plain.bytes().any(|byte| byte.is_ascii_digit());
        let numeric = plain.bytes().all(|byte| byte.is_ascii_digit() || b"+-.eE".contains(&byte));
        let begins = plain.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        (digit && numeric && begins).then(|| Self { whole: plain.parse().ok(), hex: false })
    }
}

/// A word and what is glued to it: "6=1.5" is three.
fn parts(word: &str) -> Vec<String> {
    let mut parts = Vec::new();
    for (index, part) in word.split('=').enumerate() {
        if index > 0 {
            parts.push("=".to_owned());
        }
        let part = part.trim_matches(|c: char| ",:?!".contains(c));
        if !part.is_empty() {
            parts.push(part.to_owned());
        }
    }
    parts
}

/// Letters and digits, small: `Sy.51`, `SY_51` and `sy51` are the same.
pub(in crate::tool) fn fold(text: &str) -> String {
    text.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect()
}

/// The words of a label, folded.
pub(super) fn split(label: &str) -> impl Iterator<Item = String> {
    label.split([' ', '_', ',', '-', '/', '(', ')']).map(fold).filter(|word| !word.is_empty())
}

/// What the manuals call what `word` says.
pub(super) fn meant(word: &str) -> &str {
    SYNONYMS.iter().find(|(said, _)| *said == word).map_or(word, |(_, meant)| *meant)
}

/// How well `word` is one of these words, or a part of them.
pub(super) fn in_words(labels: &[&str], word: &str) -> i32 {
    let meant = meant(word);
    let singular = meant.strip_suffix('s').filter(|word| word.len() > 2).unwrap_or(meant);
    let of = |label: &&str| {
        if fold(label) == word || fold(label) == meant {
            return NAME;
        }
        let words = split(label);
        let score = |own: String| {
            if own == word || own == meant {
                WORD
            } else if own == singular || own.strip_suffix('s') == Some(singular) {
                WORD - 5
            } else if !word.is_empty() && (own.starts_with(word) || own.starts_with(singular)) {
                BEGINNING
            } else {
                0
            }
        };
        let best = words.map(score).max().unwrap_or_default();
        let inside = word.len() > 2 && fold(label).contains(word);
        best.max(if inside { INSIDE } else { 0 })
    };
    labels.iter().filter(|label| !label.is_empty()).map(of).max().unwrap_or_default()
}

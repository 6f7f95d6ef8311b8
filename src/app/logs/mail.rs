use std::fmt::Display;

use wasm_bindgen::{JsCast, JsValue};
use web_sys::MessageEvent;
use web_sys::js_sys::Array;

/// A message between page and worker: its kind and what belongs to it.
///
/// | to the worker | |
/// | --- | --- |
/// | `open` | the file, its name, how it is to be read |
/// | `stop` | |
/// | `set-up` | how the devices are set up |
/// | `filter` | which telegrams are to be seen |
/// | `rows` | the first place in the list, how many |
/// | `select` | a place in the list |
/// | `find` | a telegram's index: where it is in the list |
/// | `step` | a place, and 1 or -1: the next error from there |
/// | `series` | unit, register |
/// | `finding` | its number: the list shows its telegrams |
/// | `export` | kind, numbers with comments |
/// | `unread`, `sample` | lines without bytes; a line to mark parts in |
///
/// | to the page | |
/// | --- | --- |
/// | `hello` | |
/// | `progress` | bytes done, bytes in all, telegrams |
/// | `refused` | why |
/// | `ready` | markup of the story, the table, and the filter's lists |
/// | `findings` | markup |
/// | `filtered` | how many, of how many, markup of the timeline |
/// | `rows` | the first place, markup |
/// | `telegram` | its place, its number, markup |
/// | `series`, `unread`, `sample` | markup, or a text |
/// | `exported` | the file's name, the file |
#[derive(Clone, Debug)]
pub struct Mail(Array);

impl Mail {
    pub fn new(kind: &str) -> Self {
        Self(Array::of1(&kind.into()))
    }

    /// Adds what belongs to it.
    pub fn with(self, value: impl Into<JsValue>) -> Self {
        self.0.push(&value.into());
        self
    }

    /// What came with an event; `None` if that is something else.
    pub fn of(event: &MessageEvent) -> Option<Self> {
        event.data().dyn_into().ok().map(Self)
    }

    pub fn kind(&self) -> String {
        self.text(0)
    }

    /// What is at place `at`, from 1; the kind is at 0.
    pub fn text(&self, at: u32) -> String {
        self.0.get(at).as_string().unwrap_or_default()
    }

    pub fn number(&self, at: u32) -> f64 {
        self.0.get(at).as_f64().unwrap_or_default()
    }

    /// The same as a whole number from 0.
    pub fn index(&self, at: u32) -> usize {
        self.number(at).max(0.0) as usize
    }

    pub fn value(&self, at: u32) -> JsValue {
        self.0.get(at)
    }

    /// What is handed over.
    pub fn message(&self) -> &JsValue {
        &self.0
    }
}

/// Pairs as a text, a line each: what the two tell each other of how a log is to be read.
pub fn pairs_text<'a>(pairs: impl IntoIterator<Item = (impl Display, &'a String)>) -> String {
    let lines = pairs.into_iter().map(|(key, value)| format!("{key}={}\n", value.replace('\n', " ")));
    lines.collect()
}

/// What [`pairs_text`] wrote.
pub fn pairs_of(text: &str) -> Vec<(String, String)> {
    let pairs = text.lines().filter_map(|line| line.split_once('='));
    pairs.map(|(key, value)| (key.to_owned(), value.to_owned())).collect()
}

/// The value with this key; empty if there is none.
pub fn value_of<'a>(pairs: &'a [(String, String)], key: &str) -> &'a str {
    pairs.iter().find(|(other, _)| other == key).map_or("", |(_, value)| value)
}

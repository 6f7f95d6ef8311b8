//! Lessons: what a trainer writes as text and a page teaches with. docs/teaching.md has the format.
//!
//! A lesson says nothing of a byte that the library does not say, too: its telegrams are read, its fields are
//! found by the names that the library gives them, and [`Lesson::mistakes`] says of each statement that does
//! not hold in which line it stands.

mod all;
mod check;
mod exercise;
mod progress;
mod read;
mod text;

use buslens::field::{Field, Span, in_order, leaves};
use buslens::tool::{Detail, Options, Profile, Protocol, Report, decode};

pub use all::LESSONS;
pub use exercise::{Ask, Checksum, Exercise, Reading};
pub use progress::Progress;
pub use read::read;
pub(crate) use read::{is_known, key};
pub use text::{Piece, pieces};

/// What is wrong in a lesson's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The line, from 1.
    pub line: usize,
    /// What stands there and what was expected, in a sentence.
    pub said: String,
}

/// A lesson.
#[derive(Clone, Debug, Default)]
pub struct Lesson {
    /// The word by which links and progress name it.
    pub key: String,
    pub title: String,
    /// What it is listed under.
    pub group: String,
    /// What it is about, in a sentence.
    pub about: String,
    pub minutes: u8,
    pub steps: Vec<Step>,
}

/// One idea, with something to do.
#[derive(Clone, Debug, Default)]
pub struct Step {
    pub title: String,
    /// Its paragraphs; [`pieces`] has what in them is code or a new word.
    pub text: Vec<String>,
    /// What is lit, one after another.
    pub telegrams: Vec<Telegram>,
    /// A log as it came, where the step is about one.
    pub log: String,
    /// What the telegrams are shown as besides their bytes.
    pub show: Show,
    pub device: Option<&'static Profile>,
    pub protocol: Option<&'static Protocol>,
    pub statements: Vec<Statement>,
    pub exercise: Option<Exercise>,
    pub line: usize,
}

/// How telegrams are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Show {
    #[default]
    Bytes,
    /// Two sides that take turns.
    Sides,
    /// The first telegram's CRC, worked out bit by bit.
    Checksum,
    /// The line over time, at so many bits a second.
    Line(u32),
    /// The log with what is read in it.
    Log,
}

/// A telegram, and what there is to say of its parts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Telegram {
    /// As a person would type it.
    pub text: String,
    pub remarks: Vec<Remark>,
    pub line: usize,
}

/// A part of a telegram, and what to say of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    pub place: Place,
    pub text: String,
    pub line: usize,
}

/// A part of a telegram.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// All of it.
    Whole,
    /// The field that the library calls so.
    Field(String),
    /// These bytes, from 0.
    Bytes(Span),
}

/// Something that a lesson says and that must hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// Of which telegram of the step.
    pub telegram: usize,
    /// The name of a field; of a log the number that is meant, or `finding`.
    pub name: String,
    pub value: String,
    pub line: usize,
}

impl Step {
    pub fn options(&self) -> Options {
        Options { device: self.device, protocol: self.protocol, ..Options::default() }
    }

    /// Its telegrams as the library reads them, one after another.
    pub fn report(&self) -> Report {
        let lines: Vec<&str> = self.telegrams.iter().map(|telegram| telegram.text.as_str()).collect();
        decode(&lines.join("\n"), self.options())
    }
}

impl Place {
    /// The bytes that it names in a telegram of `length` bytes, if it has such.
    pub fn span(&self, detail: &Detail, length: usize) -> Option<Span> {
        match self {
            Self::Whole => Some(Span::new(0, length)),
            Self::Bytes(span) => Some(*span).filter(|span| !span.is_empty() && span.to <= length),
            Self::Field(name) => field(detail, name).map(|field| field.span),
        }
    }
}

/// The field that the library calls `name`, by the device's words or else by the protocol's.
pub fn field<'a>(detail: &'a Detail, name: &str) -> Option<&'a Field> {
    let mut found: Option<&Field> = None;
    let named = |field: &Field| field.label().to_string().eq_ignore_ascii_case(name);
    let blocks = detail.device.blocks.iter().map(|block| &block.field);
    for tree in blocks.chain(&detail.fields) {
        tree.visit(&mut |field| {
            if found.is_none() && named(field) && !field.span.is_empty() {
                found = Some(field);
            }
        });
    }
    found
}

/// What fields can be named in a telegram, in the order of their bytes.
pub fn names(detail: &Detail) -> Vec<String> {
    let blocks = detail.device.blocks.iter().flat_map(|block| leaves(std::slice::from_ref(&block.field)));
    let all = in_order(leaves(&detail.fields).into_iter().chain(blocks), |field| field.span);
    let mut names: Vec<String> = all.into_iter().map(|field| field.label().to_string()).collect();
    names.dedup();
    names
}

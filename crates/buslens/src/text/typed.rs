//! What a person types: the bytes of one telegram in their text, and what is wrong with the rest of the line.

use super::characters::is_letter_or_digit;
use super::line::{Numbers, Scan, Start};
use crate::field::{Message, Severity, Span};
use crate::message;

/// The bytes of one telegram in the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Counted from 1.
    pub number: usize,
    /// The part of the text that they stand in.
    pub span: Span,
    pub bytes: Vec<u8>,
    /// Where each of `bytes` stands in the text.
    pub places: Vec<Span>,
    pub remarks: Vec<Remark>,
    /// The bytes are hex digits behind a colon, without anything between: `:0103…`.
    pub colon: bool,
}

/// Something in the text that is not as it should be, or was read in a way worth telling.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Stable kebab-case word.
    pub code: &'static str,
    pub severity: Severity,
    pub message: Message,
    /// Its place in the text.
    pub span: Span,
}

/// All bytes of a text that holds nothing else, whatever they are written like and on however many lines.
pub fn bytes(text: &str) -> Vec<u8> {
    let mut scan = Scan::default();
    let mut bytes = Vec::new();
    for line in text.lines() {
        scan.read(line.as_bytes(), Start::default(), Some(Numbers::Hex));
        bytes.extend(scan.runs.iter().flat_map(|run| &scan.hex[run.first..run.end]));
    }
    bytes
}

/// What in a line of bytes is none, each at its place: letters that are no hex digits, digits left over.
/// `places` are those of the bytes that were read from `text`, which begins at `from`.
pub fn remarks(text: &str, from: usize, places: &[Span]) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let mut rest = text.char_indices().map(|(at, c)| (from + at, c)).peekable();
    let mut places = places.iter().peekable();
    // How many digits of bytes stand right before.
    let (mut digits, mut end) = (0, 0);
    while let Some((at, c)) = rest.next() {
        while let Some(place) = places.next_if(|place| place.to <= at) {
            digits = if place.from == end { digits + place.len() } else { place.len() };
            end = place.to;
        }
        let read = |at: usize, places: &mut std::iter::Peekable<std::slice::Iter<'_, Span>>| {
            places.peek().is_some_and(|place| place.from <= at)
        };
        if read(at, &mut places) || !is_letter(c) {
            continue;
        }
        let mut to = at + c.len_utf8();
        let mut word = String::from(c);
        while let Some((at, c)) = rest.next_if(|(at, c)| is_letter(*c) && !read(*at, &mut places)) {
            to = at + c.len_utf8();
            word.push(c);
        }
        let before = if end == at { digits } else { 0 };
        // What is whole bytes by itself is right, whatever is beside it.
        let whole = word.chars().all(|c| c.is_ascii_hexdigit()) && (before + word.len()).is_multiple_of(2);
        if !whole {
            remarks.push(remark(&word, before, Span::new(at, to)));
        }
    }
    remarks
}

/// Whether a line without bytes is what a person typed as some: hardly more than hex digits.
pub fn looks_typed(line: &str) -> bool {
    const WORD: usize = 8;
    let letters = line.chars().filter(|c| is_letter_or_digit(*c));
    let (hex, all) =
        letters.fold((0, 0), |(hex, all), c| (hex + usize::from(c.is_ascii_hexdigit()), all + 1));
    let short = line.split(|c: char| !is_letter_or_digit(c)).all(|word| word.len() <= WORD);
    hex * 4 >= all * 3 && short && line.chars().any(|c| c.is_ascii_digit())
}

/// What is wrong with `word`, behind so many digits of bytes.
fn remark(word: &str, before: usize, span: Span) -> Remark {
    let one = word.chars().count() == 1;
    let hex = word.chars().all(|c| c.is_ascii_hexdigit());
    let (code, message) = match word {
        "O" | "o" => {
            ("not-hex", message!("this is the letter O, not a zero: hex digits are 0 to 9 and A to F"))
        }
        "l" | "I" => ("not-hex", message!("this is a letter, not a one: hex digits are 0 to 9 and A to F")),
        _ if hex && one && before == 0 => {
            ("digit-missing", message!("one digit: a byte has two, a second one is missing"))
        }
        _ if hex => (
            "odd-digits",
            message!("{n} digits: one is left over, since a byte has two", n = before + word.len()),
        ),
        "0x" | "0X" => {
            ("digit-missing", message!("hex digits are missing after “{prefix}”", prefix = word.to_owned()))
        }
        _ if one => {
            ("not-hex", message!("“{text}” is not a hex digit (0 to 9, A to F)", text = word.to_owned()))
        }
        _ => (
            "not-hex",
            message!(
                "“{text}” is not hex: expected bytes of two digits, 0 to 9 and A to F",
                text = word.to_owned()
            ),
        ),
    };
    Remark { code, severity: Severity::Error, message, span }
}

/// Whether `c` can be a slip: what parts bytes is none.
fn is_letter(c: char) -> bool {
    is_letter_or_digit(c) || matches!(c, '?' | '!')
}

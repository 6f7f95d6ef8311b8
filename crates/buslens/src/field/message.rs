use std::fmt;

use super::HexValue;
use super::number::{push_digits, push_signed};

/// A sentence as a constant template with named arguments, so that a catalogue can translate it.
///
/// Made with [`message!`](crate::message); shown in English by `Display`.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// English text with `{name}` where an argument goes.
    pub template: &'static str,
    pub arguments: Vec<(&'static str, Argument)>,
}

/// What stands in place of a `{name}`.
#[derive(Clone, Debug, PartialEq)]
pub enum Argument {
    Number(u64),
    /// A number that may be below 0.
    Signed(i64),
    Hex(HexValue),
    /// Text of the input or of the wire: never translated.
    Text(String),
    /// A word of ours that a catalogue translates by itself.
    Term(&'static str),
    Message(Message),
}

impl Message {
    /// A message that is one word or phrase of ours.
    pub const fn term(template: &'static str) -> Self {
        Self { template, arguments: Vec::new() }
    }

    /// Adds an argument; used by [`message!`](crate::message). Not inlined: it is called from
    /// hundreds of places.
    #[inline(never)]
    pub fn put(&mut self, name: &'static str, value: impl Into<Argument>) {
        self.arguments.push((name, value.into()));
    }

    /// "a, b, c"; nothing of nothing.
    pub fn list(parts: impl IntoIterator<Item = Self>) -> Option<Self> {
        let join = |said, next| crate::message!("{said}, {next}", said = said, next = next);
        parts.into_iter().reduce(join)
    }

    /// "a; b; c", of parts that may have commas.
    pub fn clauses(parts: impl IntoIterator<Item = Self>) -> Option<Self> {
        let join = |said, next| crate::message!("{said}; {next}", said = said, next = next);
        parts.into_iter().reduce(join)
    }

    /// "1 byte", "3 bytes".
    pub fn bytes(count: usize) -> Self {
        match count {
            1 => Self::term("1 byte"),
            _ => crate::message!("{n} bytes", n = count),
        }
    }

    /// The message in English with a capital first letter, to stand by itself.
    pub fn sentence(&self) -> String {
        let mut text = String::new();
        self.push_sentence(&mut text);
        text
    }

    /// The sentence behind what `text` holds.
    pub fn push_sentence(&self, text: &mut String) {
        let from = text.len();
        self.push_to(text);
        if let Some(first) = text.get_mut(from..=from) {
            first.make_ascii_uppercase();
        }
    }

    /// The message in English behind what `text` holds.
    pub fn push_to(&self, text: &mut String) {
        let mut rest = self.template;
        while let Some((before, after)) = split(rest, b'{') {
            text.push_str(before);
            let Some((name, after)) = split(after, b'}') else {
                text.push('{');
                rest = after;
                break;
            };
            match self.arguments.iter().find(|(known, _)| *known == name) {
                Some((_, argument)) => argument.push_to(text),
                None => ["{", name, "}"].into_iter().for_each(|part| text.push_str(part)),
            }
            rest = after;
        }
        text.push_str(rest);
    }
}

impl Argument {
    fn push_to(&self, text: &mut String) {
        match self {
            Self::Number(number) => push_digits(text, *number, 1),
            Self::Signed(number) => push_signed(text, *number),
            Self::Hex(number) => number.push_to(text),
            Self::Text(own) => text.push_str(own),
            Self::Term(term) => text.push_str(term),
            Self::Message(message) => message.push_to(text),
        }
    }
}

/// What stands before the first `mark`, which is of ASCII, and what behind it. Such texts are too short for the ways of
/// the standard library to be worth their beginning.
fn split(text: &str, mark: u8) -> Option<(&str, &str)> {
    text.bytes().position(|byte| byte == mark).map(|at| (&text[..at], &text[at + 1..]))
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::new();
        self.push_to(&mut text);
        f.write_str(&text)
    }
}

impl fmt::Display for Argument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::new();
        self.push_to(&mut text);
        f.write_str(&text)
    }
}

macro_rules! from_number {
    ($($number:ty),*) => {$(
        impl From<$number> for Argument {
            fn from(number: $number) -> Self {
                Self::Number(number as u64)
            }
        }
    )*};
}

from_number!(u8, u16, u32, u64, usize);

impl From<i64> for Argument {
    fn from(number: i64) -> Self {
        Self::Signed(number)
    }
}

impl From<HexValue> for Argument {
    fn from(number: HexValue) -> Self {
        Self::Hex(number)
    }
}

impl From<String> for Argument {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<Message> for Argument {
    fn from(message: Message) -> Self {
        Self::Message(message)
    }
}

/// Makes a [`Message`](crate::field::Message): `message!("{label} is {value}", label = …, value = …)`.
///
/// The template is a literal: a test collects all of them from the source.
#[macro_export]
macro_rules! message {
    ($template:literal $(,)?) => {
        $crate::field::Message::term($template)
    };
    ($template:literal, $($name:ident = $value:expr),+ $(,)?) => {{
        let mut message = $crate::field::Message::term($template);
        $(message.put(stringify!($name), $value);)+
        message
    }};
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_stand_where_their_names_are() {
        let unit = message!("unit {n}", n = 5u8);
        let said = message!("{who} answers: {text}", who = unit, text = "{n}".to_string());
        assert_eq!(said.to_string(), "unit 5 answers: {n}");
        assert_eq!(said.sentence(), "Unit 5 answers: {n}");
    }

    #[test]
    fn a_missing_argument_stays_visible() {
        assert_eq!(Message::term("{who} answers").to_string(), "{who} answers");
        assert_eq!(Message::term("open {brace").to_string(), "open {brace");
    }
}

use std::fmt;

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
        let mut text = self.to_string();
        if let Some(first) = text.get_mut(..1) {
            first.make_ascii_uppercase();
        }
        text
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut rest = self.template;
        while let Some((before, after)) = rest.split_once('{') {
            f.write_str(before)?;
            let Some((name, after)) = after.split_once('}') else {
                return write!(f, "{{{after}");
            };
            match self.arguments.iter().find(|(known, _)| *known == name) {
                Some((_, argument)) => write!(f, "{argument}")?,
                None => write!(f, "{{{name}}}")?,
            }
            rest = after;
        }
        f.write_str(rest)
    }
}

impl fmt::Display for Argument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => f.write_str(text),
            Self::Term(term) => f.write_str(term),
            Self::Message(message) => write!(f, "{message}"),
        }
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

//! The words that everything else is said in: what a field is ([`Spec`]), what it held in one
//! telegram ([`Field`]), and what there is to say about it ([`Message`], [`Problem`]).
//!
//! Nothing here knows a protocol, and nothing here imports anything else of this crate.

mod bits;
mod facts;
mod in_order;
mod message;
mod number;
mod problem;
mod spec;
mod value;

pub use bits::Bits;
pub use facts::Facts;
pub use in_order::{in_order, in_order_by};
pub use message::{Argument, Message};
pub use number::{
    HexValue, decimal, float, hex, hex_value, number_text, parse_float, push_digits, push_hex, push_number,
    shortest,
};
pub use problem::{Problem, Severity};
pub use spec::{Format, Name, Order, Range, Role, Spec};
pub use value::{Check, Value, escaped, unescaped};

/// A run of bytes: of a telegram, or of the text that it was read from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Span {
    /// The first byte.
    pub from: usize,
    /// One past the last byte.
    pub to: usize,
}

impl Span {
    pub const fn new(from: usize, to: usize) -> Self {
        Self { from, to }
    }

    pub const fn len(self) -> usize {
        self.to - self.from
    }

    pub const fn is_empty(self) -> bool {
        self.from == self.to
    }

    pub const fn shifted(self, by: usize) -> Self {
        Self::new(self.from + by, self.to + by)
    }

    /// As much of it as lies in the first `length` bytes.
    pub fn within(self, length: usize) -> Self {
        Self::new(self.from.min(length), self.to.min(length))
    }

    pub const fn contains(self, position: usize) -> bool {
        self.from <= position && position < self.to
    }

    /// The bytes of `whole` that the span names; what lies outside of `whole` is left out.
    pub fn of<T>(self, whole: &[T]) -> &[T] {
        let Self { from, to } = self.within(whole.len());
        &whole[from.min(to)..to]
    }
}

/// Who speaks: the client (the manuals' master) asks, the server (slave) answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "json", derive(serde::Serialize, serde::Deserialize))]
pub enum Direction {
    Request,
    Response,
}

impl Direction {
    /// The stable word of exports and vectors.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Request => "request",
            Self::Response => "response",
        }
    }

    /// The direction with this key.
    pub fn of(key: &str) -> Option<Self> {
        [Self::Request, Self::Response].into_iter().find(|direction| direction.key() == key)
    }
}

/// "1 telegram", "3 telegrams".
pub fn count(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

/// "1 telegram", "1,004 telegrams".
pub fn many(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{} {noun}s", grouped(n)) }
}

/// A number with its thousands parted: 1,234,567.
pub fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Which one of a list a field is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbering {
    /// Its own number is known, such as a register's address.
    At(u64),
    /// Only its distance from the first is known: a read response does not repeat the address.
    Offset(u64),
}

impl Numbering {
    /// The number of the item `offset` places behind the first one, whose number may be known.
    pub fn new(first: Option<u64>, offset: u64) -> Self {
        first.map_or(Self::Offset(offset), |first| Self::At(first.saturating_add(offset)))
    }
}

/// A field of one telegram, with the bytes it was read from and the fields within it.
///
/// The leaves of a telegram's tree tile its bytes: each byte belongs to exactly one leaf.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    pub spec: &'static Spec,
    /// Set for the members of a list.
    pub number: Option<Numbering>,
    pub span: Span,
    pub value: Value,
    pub problems: Vec<Problem>,
    pub children: Vec<Field>,
}

impl Field {
    pub fn new(spec: &'static Spec, span: Span, value: Value) -> Self {
        Self { spec, number: None, span, value, problems: Vec::new(), children: Vec::new() }
    }

    /// The field's name in this telegram: "Quantity", "Register 215", "Register +2".
    pub fn label(&self) -> Message {
        self.spec.numbered(self.number)
    }

    /// The value as a person writes it; empty for groups.
    pub fn value_text(&self) -> String {
        let mut text = String::new();
        self.push_value(&mut text);
        text
    }

    /// The same behind what `text` holds.
    pub fn push_value(&self, text: &mut String) {
        self.value.push_text(text, self.spec);
    }

    /// What the value means, where there is more to say than the value itself.
    pub fn meaning(&self) -> Option<Message> {
        self.value.meaning(self.spec, self.number)
    }

    /// The parts of a number whose bits each say something, with their values.
    pub fn parts(&self) -> impl Iterator<Item = (&'static Bits, u64)> {
        let (raw, bits) = match self.value {
            Value::Number { raw, .. } => (raw, self.spec.bits),
            Value::Selector { raw, chosen, .. } => (raw, chosen.bits),
            _ => (0, &[] as &'static [Bits]),
        };
        bits.iter().map(move |part| (part, part.of(raw)))
    }

    /// Moves the field and all below it: what was read by itself takes its place in a telegram.
    pub fn shift(&mut self, by: usize) {
        self.span = self.span.shifted(by);
        for problem in &mut self.problems {
            problem.span = problem.span.shifted(by);
        }
        for child in &mut self.children {
            child.shift(by);
        }
    }

    /// Calls `visit` for this field and all below it, parents first.
    pub fn visit<'a>(&'a self, visit: &mut dyn FnMut(&'a Field)) {
        visit(self);
        for child in &self.children {
            child.visit(visit);
        }
    }
}

/// All problems of a tree in the order of its fields.
pub fn problems(fields: &[Field]) -> Vec<&Problem> {
    let mut found = Vec::new();
    for field in fields {
        field.visit(&mut |field| found.extend(&field.problems));
    }
    found
}

/// The first answer of `ask` to the fields of a tree, parents first.
pub fn find<'a, T>(fields: &'a [Field], ask: &mut dyn FnMut(&'a Field) -> Option<T>) -> Option<T> {
    fields.iter().find_map(|field| ask(field).or_else(|| find(&field.children, ask)))
}

/// The leaves of a tree, in the order of the bytes. Together they tile the telegram.
pub fn leaves(fields: &[Field]) -> Vec<&Field> {
    let mut found = Vec::new();
    for field in fields {
        field.visit(&mut |field| {
            if field.children.is_empty() {
                found.push(field);
            }
        });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_grouped() {
        assert_eq!(many(1004, "request"), "1,004 requests");
        assert_eq!(many(1, "line"), "1 line");
        assert_eq!(grouped(1_234_567), "1,234,567");
        assert_eq!(grouped(999), "999");
    }
}

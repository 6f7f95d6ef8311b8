//! What a task is: a question, what is given, and what a right answer is.

use buslens::field::{self, Check, Direction, Field, Format, Order, Role, Span, Spec, Value, hex, in_order};
use buslens::tool::{Detail, Options, Protocol, Report};

use crate::notation::Notation;

/// Something to find out or to make.
#[derive(Clone, Debug)]
pub struct Task {
    /// A sentence: "What value does the recorder answer?".
    pub question: String,
    /// What is laid before the learner, in its order.
    pub given: Vec<Given>,
    pub expected: Expected,
    /// At most three, each saying more than the one before: where to look, which rule, the field.
    pub hints: Vec<String>,
    /// The steps that lead to the answer, for the answer key.
    pub working: Vec<String>,
}

/// Something that a learner looks at.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "there are a few of them, and never many at a time")]
pub enum Given {
    Telegram(Telegram),
    /// A conversation, a line each, or other text.
    Text(String),
}

/// What a right answer is.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "there are a few of them, and never many at a time")]
pub enum Expected {
    /// The bytes of a telegram, with its checksum or without.
    Telegram(Telegram),
    /// The value of a field, or any number.
    Number(Number),
    /// One of several choices.
    Choice { choices: Vec<Choice>, right: usize },
    /// Which byte of a telegram is wrong, counted from 0: any of `at`. `right` is the telegram as it should be.
    Byte { telegram: Telegram, right: Telegram, at: Span },
    /// Some fields of a telegram are blank and to be filled in, in bytes.
    Blanks { telegram: Telegram, blanks: Vec<Blank> },
}

/// One of several choices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    pub text: String,
    /// What there is to say to who chose it wrongly; may be empty.
    pub remark: String,
}

/// A field that is to be filled in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Blank {
    pub label: String,
    pub span: Span,
}

/// A telegram that is known for what it is.
#[derive(Clone, Debug)]
pub struct Telegram {
    pub bytes: Vec<u8>,
    pub direction: Direction,
    pub protocol: &'static Protocol,
    /// The request that it answers, where that is there to see.
    pub request: Option<Vec<u8>>,
    /// The device, and how it is set up.
    pub options: Options,
    pub checksum: Checksum,
}

/// Whose part the checksum of a telegram is that is to be made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Checksum {
    /// It is added where it was left away.
    #[default]
    Added,
    /// It belongs to the answer.
    Asked,
}

/// A number that is to be found out.
#[derive(Clone, Debug)]
pub struct Number {
    /// What it is: "Starting address".
    pub label: String,
    /// Its bits, in `width` bytes.
    pub raw: u64,
    pub width: usize,
    /// What kind of number it is.
    pub format: Format,
    /// What is counted: `%`.
    pub unit: String,
    pub role: Role,
    /// How it is to be written; where it does not matter, [`Notation::Any`].
    pub notation: Notation,
    /// The field's own words, for what values are called.
    pub spec: Option<&'static Spec>,
}

impl Telegram {
    pub fn new(bytes: Vec<u8>, direction: Direction, protocol: &'static Protocol) -> Self {
        Self {
            bytes,
            direction,
            protocol,
            request: None,
            options: Options::default(),
            checksum: Checksum::Added,
        }
    }

    /// The same for these bytes.
    pub fn with(&self, bytes: Vec<u8>) -> Self {
        Self { bytes, ..self.clone() }
    }

    /// It read by itself or, where there is one, as the response to its request.
    pub fn report(&self) -> Report {
        let (protocol, options) = (self.protocol, self.options.clone());
        match &self.request {
            Some(request) if self.direction == Direction::Response => {
                Report::of_pair(request, &self.bytes, protocol, options)
            }
            _ => Report::of_one(&self.bytes, self.direction, protocol, options),
        }
    }

    /// Everything about it.
    pub fn detail(&self) -> Option<Detail> {
        let report = self.report();
        report.detail(report.telegrams.len().checked_sub(1)?)
    }

    /// The fields in the order of their bytes. Where the device's manual has words for what registers hold,
    /// `named` asks for those.
    pub fn fields(&self, named: bool) -> Vec<Field> {
        let Some(detail) = self.detail() else { return Vec::new() };
        let own: Vec<&Field> = match named {
            true => detail.device.blocks.iter().flat_map(|it| leaves_of(&it.field)).collect(),
            false => Vec::new(),
        };
        let covered = |leaf: &&&Field| {
            let span = leaf.span;
            (span.from..span.to).any(|at| own.iter().any(|named| named.span.contains(at)))
        };
        let bare = field::leaves(&detail.fields);
        let mut all: Vec<Field> = bare.iter().filter(|leaf| !covered(leaf)).map(|it| (*it).clone()).collect();
        all.extend(own.iter().map(|it| (*it).clone()));
        in_order(all, |leaf| leaf.span)
    }

    /// The field that byte `at` belongs to, in the words of the device's manual where there are such.
    pub fn field_at(&self, at: usize) -> Option<Field> {
        self.fields(true).into_iter().find(|field| field.span.contains(at))
    }

    /// The checksum, where it has one.
    pub fn check(&self) -> Option<Check> {
        self.detail()?.check()
    }

    /// The telegram in a sentence.
    pub fn said(&self) -> String {
        self.detail().map_or_else(String::new, |detail| detail.said.sentence())
    }

    /// The bytes in hex.
    pub fn hex(&self) -> String {
        hex(&self.bytes)
    }
}

/// The leaves of a block that have bytes of their own.
fn leaves_of(field: &Field) -> Vec<&Field> {
    let leaves = field::leaves(std::slice::from_ref(field)).into_iter();
    leaves.filter(|leaf| !matches!(leaf.value, Value::Group) && !leaf.span.is_empty()).collect()
}

impl Number {
    /// Any number without a field.
    pub fn new(label: &str, raw: u64, width: usize, format: Format) -> Self {
        Self {
            label: label.to_owned(),
            raw,
            width,
            format,
            unit: String::new(),
            role: Role::Data,
            notation: Notation::Any,
            spec: None,
        }
    }

    /// The value of a field; `None` where it has none that is a number.
    pub fn of(field: &Field) -> Option<Self> {
        let (Value::Number { raw, width } | Value::Selector { raw, width, .. }) = field.value else {
            return None;
        };
        let spec = field.spec;
        Some(Self {
            unit: spec.unit.to_owned(),
            role: spec.role,
            spec: Some(spec),
            ..Self::new(&field.label().to_string(), raw, width, spec.format)
        })
    }

    pub fn role(mut self, role: Role) -> Self {
        self.role = role;
        self
    }

    pub fn notation(mut self, notation: Notation) -> Self {
        self.notation = notation;
        self
    }

    /// How the answer key writes it.
    pub fn text(&self) -> String {
        let text = match self.notation {
            Notation::Hex => field::number_text(self.raw, self.width, Format::Hex),
            Notation::Binary => format!("{:0digits$b}", self.raw, digits = 8 * self.width),
            Notation::Any | Notation::Decimal => field::number_text(self.raw, self.width, self.format),
        };
        let name = self.spec.and_then(|spec| spec.name(self.raw)).filter(|_| self.notation == Notation::Any);
        match (self.unit.as_str(), name) {
            ("", Some(name)) => format!("{text}, {}", name.label),
            ("", None) => text,
            (unit, _) => format!("{text} {unit}"),
        }
    }

    /// Its bytes as a telegram has them.
    pub fn bytes(&self) -> Vec<u8> {
        Order::Big.bytes(self.raw, self.width)
    }
}

impl Choice {
    pub fn new(text: &str, remark: &str) -> Self {
        Self { text: text.to_owned(), remark: remark.to_owned() }
    }
}

impl Expected {
    /// The right answer as the answer key writes it.
    pub fn text(&self) -> String {
        match self {
            Self::Telegram(telegram) => telegram.hex(),
            Self::Number(number) => number.text(),
            Self::Choice { choices, right } => {
                let text = choices.get(*right).map_or("", |choice| choice.text.as_str());
                format!("{}) {text}", letter(*right))
            }
            Self::Byte { telegram, right, at } => {
                let is = hex(at.of(&right.bytes));
                let was = hex(at.of(&telegram.bytes));
                match at.len() {
                    1 => format!("byte {}: {was}, it should be {is}", at.from),
                    _ => format!("bytes {} to {}: {was}, they should be {is}", at.from, at.to - 1),
                }
            }
            Self::Blanks { telegram, blanks } => {
                let of = |blank: &Blank| format!("{}: {}", blank.label, hex(blank.span.of(&telegram.bytes)));
                blanks.iter().map(of).collect::<Vec<_>>().join("; ")
            }
        }
    }
}

/// The letter of choice `index`: `a`, `b`, ….
pub fn letter(index: usize) -> char {
    (b'a'..=b'z').map(char::from).nth(index).unwrap_or('?')
}

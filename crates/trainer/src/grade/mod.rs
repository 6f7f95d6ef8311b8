//! Whether an answer is right. Answers are compared as bytes and as fields, never as strings, and what is wrong
//! is said of the field that it is wrong in, so that it teaches.

mod blanks;
mod number;
mod slip;
mod telegram;

use buslens::field::{Message, Span};
use buslens::message;

use crate::task::{Choice, Expected, Task, Telegram};

/// What somebody answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// A telegram or a number, as typed.
    Text(String),
    /// The index of a choice.
    Choice(usize),
    /// A byte, counted from 0.
    Byte(usize),
    /// What was typed into each blank.
    Blanks(Vec<String>),
}

/// What there is to say to an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It is right, perhaps with something to add.
    Right(Option<Message>),
    /// It is wrong: what is off, the most important first; at least one remark.
    Wrong(Vec<Remark>),
    /// It cannot be read as an answer: nothing is counted.
    Unread(Message),
}

/// What is off in an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// The label of the field that it is about: "Starting address"; may be empty.
    pub field: String,
    pub text: Message,
    /// The bytes of the answer, or of the telegram that is given, that it is about.
    pub span: Option<Span>,
}

impl Remark {
    fn new(field: &str, text: Message) -> Self {
        Self { field: field.to_owned(), text, span: None }
    }

    fn at(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }
}

impl Verdict {
    pub const fn is_right(&self) -> bool {
        matches!(self, Self::Right(_))
    }

    /// The remarks to a wrong answer.
    pub fn remarks(&self) -> &[Remark] {
        match self {
            Self::Wrong(remarks) => remarks,
            _ => &[],
        }
    }

    fn wrong(remark: Remark) -> Self {
        Self::Wrong(vec![remark])
    }
}

/// Grades an answer to a task.
///
/// ```
/// use buslens::field::Direction;
/// use buslens::tool::Protocol;
/// use buslens_trainer::{Answer, Expected, Task, Telegram, grade};
///
/// let request = vec![0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35];
/// let rtu = Protocol::of("modbus-rtu").unwrap();
/// let task = Task {
///     question: "Ask unit 1 for the registers 200 to 202.".to_owned(),
///     given: Vec::new(),
///     expected: Expected::Telegram(Telegram::new(request, Direction::Request, rtu)),
///     hints: Vec::new(),
///     working: Vec::new(),
/// };
/// let verdict = |answer: &str| grade(&task, &Answer::Text(answer.to_owned()));
/// assert!(verdict("010300c80003").is_right());
/// assert!(verdict("01 03 00 C8 00 03 84 35").is_right());
/// let wrong = verdict("01 03 00 C9 00 03");
/// assert_eq!(wrong.remarks()[0].field, "Starting address");
/// assert_eq!(
///     wrong.remarks()[0].text.sentence(),
///     "The starting address is one too high (201, not 200): a telegram counts addresses from 0, lists of \
///      registers often from 1"
/// );
/// ```
pub fn grade(task: &Task, answer: &Answer) -> Verdict {
    match (&task.expected, answer) {
        (Expected::Telegram(wanted), Answer::Text(text)) => telegram::grade(wanted, text),
        (Expected::Number(wanted), Answer::Text(text)) => number::grade(wanted, text),
        (Expected::Choice { choices, right }, Answer::Choice(chosen)) => choice(choices, *right, *chosen),
        (Expected::Byte { telegram, right, at }, Answer::Byte(chosen)) => byte(telegram, right, *at, *chosen),
        (Expected::Blanks { telegram, blanks }, Answer::Blanks(texts)) => {
            blanks::grade(telegram, blanks, texts)
        }
        // Numbers as they are typed on a handout or by another program.
        (Expected::Choice { choices, right }, Answer::Text(text)) => match letter(text) {
            Some(chosen) => choice(choices, *right, chosen),
            None => Verdict::Unread(message!("name one of the choices by its letter")),
        },
        (Expected::Byte { telegram, right, at }, Answer::Text(text)) => match text.trim().parse() {
            Ok(chosen) => byte(telegram, right, *at, chosen),
            Err(_) => Verdict::Unread(message!("name the byte by its number, counted from 0")),
        },
        (Expected::Blanks { telegram, blanks }, Answer::Text(text)) => {
            let texts: Vec<String> = text.split(';').map(str::to_owned).collect();
            blanks::grade(telegram, blanks, &texts)
        }
        _ => Verdict::Unread(message!("there is no answer yet")),
    }
}

/// The index of a choice that is named by its letter.
fn letter(text: &str) -> Option<usize> {
    let mut letters = text.trim().trim_end_matches(')').chars();
    let letter = letters.next().filter(|_| letters.next().is_none())?.to_ascii_lowercase();
    ('a'..='z').position(|known| known == letter)
}

fn choice(choices: &[Choice], right: usize, chosen: usize) -> Verdict {
    if chosen == right {
        return Verdict::Right(None);
    }
    match choices.get(chosen) {
        None => Verdict::Unread(message!("there is no such choice")),
        Some(Choice { text, remark }) if remark.is_empty() => {
            Verdict::wrong(Remark::new("", message!("it is not “{choice}”", choice = text.clone())))
        }
        Some(Choice { remark, .. }) => {
            Verdict::wrong(Remark::new("", message!("{remark}", remark = remark.clone())))
        }
    }
}

/// Which byte is wrong.
fn byte(telegram: &Telegram, right: &Telegram, at: Span, chosen: usize) -> Verdict {
    if at.contains(chosen) {
        return Verdict::Right(None);
    }
    let Some(value) = telegram.bytes.get(chosen) else {
        return Verdict::Unread(message!(
            "there is no byte {n}: they are counted from 0 to {last}",
            n = chosen,
            last = telegram.bytes.len().saturating_sub(1)
        ));
    };
    let span = Span::new(chosen, chosen + 1);
    let (field, wrong) = (right.field_at(chosen), right.field_at(at.from));
    let label = field.as_ref().map_or(String::new(), |field| field.label().to_string());
    let same = field.as_ref().zip(wrong.as_ref()).is_some_and(|(one, other)| one.span == other.span);
    let text = if chosen == at.to {
        message!(
            "byte {n} is as it should be; bytes are counted from 0, so the first one is byte 0",
            n = chosen
        )
    } else if same {
        message!("the field is the right one, {label}; another of its bytes is off", label = small(&label))
    } else if label.is_empty() {
        message!("byte {n} is as it should be", n = chosen)
    } else {
        message!(
            "byte {n} belongs to the {label}, and {value} is right there",
            n = chosen,
            label = small(&label),
            value = buslens::field::hex_value((*value).into(), 1)
        )
    };
    Verdict::wrong(Remark::new(&label, text).at(span))
}

/// A field within a sentence, with "the" where it wants one: the quantity, register 201, the field “groups”.
fn the(label: &str) -> String {
    match label {
        "Not used" => "what is not used".to_owned(),
        _ if label.ends_with(|last: char| last.is_ascii_digit()) => small(label),
        _ if is_of_several(label) => format!("the field “{}”", small(label)),
        _ => format!("the {}", small(label)),
    }
}

/// Whether a label names several things: what follows speaks of one field.
fn is_of_several(label: &str) -> bool {
    let head = label.split(" of ").next().unwrap_or_default();
    head.ends_with('s') && !["ss", "us", "is"].iter().any(|end| head.ends_with(end))
}

/// A label within a sentence; abbreviations stay as they are.
fn small(label: &str) -> String {
    let mut rest = label.chars();
    match (rest.next(), rest.next()) {
        (Some(first), Some(second)) if first.is_ascii_uppercase() && second.is_ascii_lowercase() => {
            std::iter::once(first.to_ascii_lowercase()).chain(label.chars().skip(1)).collect()
        }
        _ => label.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_stand_in_sentences() {
        for (label, said) in [
            ("Quantity", "the quantity"),
            ("Register 201", "register 201"),
            ("CRC", "the CRC"),
            ("Groups", "the field “groups”"),
            ("Digital inputs", "the field “digital inputs”"),
            ("Length of inputs", "the length of inputs"),
            ("Starting address", "the starting address"),
            ("Exception status", "the exception status"),
            ("Not used", "what is not used"),
        ] {
            assert_eq!(the(label), said);
        }
    }
}

//! Text as the Memograph takes it: ASCII, two characters in a register, padded with a space to
//! whole registers. The device takes no notice of that space.

use crate::field::{Argument, Format, Message, Role, Severity, Spec, parse_float};
use crate::message;
use crate::walk::{Walk, Walker};

/// A text and what the manual asks of it.
#[derive(Debug)]
pub struct Text {
    pub spec: Spec,
    /// The command is nothing without it.
    pub required: bool,
    /// The most characters, without padding.
    longest: usize,
    /// What else it must be.
    rule: fn(&str, Say<'_>),
}

/// Takes what is wrong: code and message.
pub type Say<'a> = &'a mut dyn FnMut(&'static str, Message);

impl Text {
    /// Any text of at most `longest` characters.
    pub const fn new(spec: Spec, longest: usize) -> Self {
        Self { spec: spec.format(Format::Text), longest, required: false, rule: |_, _| {} }
    }

    pub const fn required(mut self) -> Self {
        self.required = true;
        self
    }

    pub const fn rule(mut self, rule: fn(&str, Say<'_>)) -> Self {
        self.rule = rule;
        self
    }

    /// The text, up to the end of the registers. One that ends within a register gets a space; one
    /// that was read keeps the space as its last character.
    pub fn walk(&'static self, w: &mut dyn Walker, text: &mut Vec<u8>) -> Walk {
        w.bytes(&self.spec, text, None)?;
        self.check(text, &mut |code, message| w.remark(&self.spec, Severity::Error, code, message));
        if text.len().is_multiple_of(2) { Ok(()) } else { w.derived(&PADDING, 1, Some(b' '.into())) }
    }

    fn check(&self, text: &[u8], say: Say<'_>) {
        let text = unpadded(text);
        check_length(self.spec.label, text.len(), self.longest, say);
        if text.iter().any(|byte| !(b' '..=b'~').contains(byte)) {
            let label = Argument::Term(self.spec.label);
            let message =
                message!("{label} holds bytes that are no ASCII characters: 20h to 7Eh are", label = label);
            say("not-ascii", message);
        } else if let (false, Ok(text)) = (text.is_empty(), std::str::from_utf8(text)) {
            (self.rule)(text, say);
        }
    }
}

/// `text` without the spaces at its end.
pub fn unpadded(text: &[u8]) -> &[u8] {
    let kept = text.iter().rposition(|byte| *byte != b' ').map_or(0, |last| last + 1);
    text.split_at(kept).0
}

/// Says so where there are more than `longest` characters.
pub fn check_length(label: &'static str, length: usize, longest: usize, say: Say<'_>) {
    if length > longest {
        let message = message!(
            "{label} has {length} characters; at most {longest} are allowed",
            label = Argument::Term(label),
            length = length,
            longest = longest
        );
        say("text-too-long", message);
    }
}

/// The number that `text` writes, with or without decimal point and exponent; says so where it is none.
pub fn check_number(label: &'static str, text: &str, say: Say<'_>) -> Option<f32> {
    let written = text.bytes().all(|byte| b"0123456789+-.eE".contains(&byte));
    let number = parse_float(text, 4).filter(|_| written).map(|raw| f32::from_bits(raw as u32));
    if number.is_none() {
        let message = message!(
            "{label} is “{text}”, which is not a number: write it like 12.5, -0.5 or 1.2E-3",
            label = Argument::Term(label),
            text = text.to_owned()
        );
        say("not-a-number", message);
    }
    number
}

/// Says so where `text` is not a whole number from 0 to `most`.
pub fn check_whole(label: &'static str, text: &str, most: u32, say: Say<'_>) {
    let label = Argument::Term(label);
    if text.bytes().any(|byte| !byte.is_ascii_digit()) {
        let message = message!(
            "{label} is “{text}”, which is not a whole number",
            label = label,
            text = text.to_owned()
        );
        say("not-a-number", message);
    } else if !text.parse().is_ok_and(|number: u32| number <= most) {
        let message = message!(
            "{label} is {text}; 0 to {most} are allowed",
            label = label,
            text = text.to_owned(),
            most = most
        );
        say("out-of-range", message);
    }
}

static PADDING: Spec = Spec::new("padding", "Padding")
    .role(Role::Unknown)
    .format(Format::Hex)
    .note("A space that fills the last register. The device takes no notice of it.")
    .source(SOURCE);

const SOURCE: &str = "Memograph M RSG45 Modbus supplement, 2.6.11 to 2.6.13";

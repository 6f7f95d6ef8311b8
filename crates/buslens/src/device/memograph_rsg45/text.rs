//! Text as the Memograph takes it: ASCII, two characters in a register, padded with a space to
//! whole registers. The device takes no notice of that space.

use std::cmp::Ordering;

use crate::field::{Argument, Format, Message, Role, Severity, Spec};
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
                message!("{label} contains non-ASCII characters; allowed are 20h to 7Eh", label = label);
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

/// Whether the number that `text` writes, with or without decimal point and exponent, is below, at or above
/// zero; says so where it is none.
pub fn check_number(label: &'static str, text: &str, say: Say<'_>) -> Option<Ordering> {
    let sign = sign(text);
    if sign.is_none() {
        let message = message!(
            "{label} is “{text}”, which is not a number: write it like 12.5, -0.5 or 1.2E-3",
            label = Argument::Term(label),
            text = text.to_owned()
        );
        say("not-a-number", message);
    }
    sign
}

/// The largest float of 4 bytes is 3.4E38.
const LARGEST_MAGNITUDE: i32 = 39;

/// How a written number compares to zero. Only its spelling is looked at: reading floats would more than
/// double what this folder adds to the page.
fn sign(text: &str) -> Option<Ordering> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let (mantissa, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((unsigned, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    // More digits before the point than the largest float has: 1E99 is a number to us, not to the device.
    let exponent = exponent.parse::<i16>().map_or(i32::MAX / 2, i32::from);
    let magnitude = whole.trim_start_matches('0').len() as i32 + exponent;
    let is_number = digits(whole)
        && digits(fraction)
        && whole.len() + fraction.len() > 0
        && magnitude <= LARGEST_MAGNITUDE;
    let zero = !mantissa.bytes().any(|byte| (b'1'..=b'9').contains(&byte));
    is_number.then_some(match (zero, text.starts_with('-')) {
        (true, _) => Ordering::Equal,
        (false, true) => Ordering::Less,
        (false, false) => Ordering::Greater,
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_told_by_their_spelling() {
        for (text, sign_of) in [
            ("12.5", Some(Ordering::Greater)),
            ("-0.5", Some(Ordering::Less)),
            ("+1.2E-3", Some(Ordering::Greater)),
            ("-.0e7", Some(Ordering::Equal)),
            ("5.", Some(Ordering::Greater)),
            ("", None),
            (".", None),
            ("-", None),
            ("1e", None),
            ("1e+", None),
            ("1,5", None),
            ("1.2.3", None),
            ("--1", None),
            ("NaN", None),
            ("3.4E38", Some(Ordering::Greater)),
            ("1E99", None),
            ("1E99999999999", None),
        ] {
            assert_eq!(sign(text), sign_of, "{text}");
        }
    }
}

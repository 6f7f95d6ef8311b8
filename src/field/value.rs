use super::{Argument, Format, Message, Spec};
use crate::message;

/// What a field held.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Nothing of its own: its children say it.
    Group,
    /// An unsigned number of `width` bytes as it is on the wire.
    Number { raw: u64, width: usize },
    /// A number that chose what follows it; the name is that of the choice.
    Selector { raw: u64, width: usize, chosen: &'static Spec },
    /// Bytes without a meaning that we know.
    Bytes,
    /// Check bytes.
    Check(Check),
    /// A field of `width` bytes of which `found` are there; the telegram ends too early.
    Missing { width: usize, found: usize },
}

/// Check bytes as found and as they should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Check {
    /// The stable name of the algorithm, such as `crc-16/modbus`.
    pub kind: &'static str,
    /// How many bytes it has.
    pub width: usize,
    /// The wire's bytes, the first one most significant.
    pub found: u64,
    pub computed: u64,
    /// The wire sends the low byte first.
    pub low_first: bool,
}

impl Check {
    pub fn ok(&self) -> bool {
        self.found == self.computed
    }

    /// The bytes as found, as they are on the wire: `84 35`.
    pub fn found_bytes(&self) -> String {
        hex(&self.found.to_be_bytes()[8 - self.width..])
    }

    /// The bytes as they should be.
    pub fn computed_bytes(&self) -> String {
        hex(&self.computed.to_be_bytes()[8 - self.width..])
    }

    /// The found bytes as a number: `84 35`, low byte first, is 3584h.
    pub fn found_value(&self) -> u64 {
        self.number(self.found)
    }

    pub fn computed_value(&self) -> u64 {
        self.number(self.computed)
    }

    fn number(&self, wire: u64) -> u64 {
        if self.low_first { wire.swap_bytes() >> (64 - 8 * self.width) } else { wire }
    }
}

impl Value {
    /// The number that the field held, if it held one.
    pub fn raw(&self) -> Option<u64> {
        match *self {
            Self::Number { raw, .. } | Self::Selector { raw, .. } => Some(raw),
            Self::Check(check) => Some(check.found_value()),
            Self::Group | Self::Bytes | Self::Missing { .. } => None,
        }
    }

    pub(super) fn text(&self, format: Format) -> String {
        match *self {
            Self::Number { raw, width } | Self::Selector { raw, width, .. } => match format {
                Format::Hex | Format::HexAddress => hex_value(raw, width),
                Format::Decimal | Format::Reference(_) | Format::Register => raw.to_string(),
            },
            Self::Check(check) => hex_value(check.found_value(), check.width),
            Self::Group | Self::Bytes | Self::Missing { .. } => String::new(),
        }
    }

    pub(super) fn meaning(&self, spec: &'static Spec) -> Option<Message> {
        match *self {
            Self::Number { raw, width } => match spec.name(raw) {
                Some(name) => Some(Message::term(name.label)),
                None => shown_otherwise(raw, width, spec.format),
            },
            Self::Selector { chosen, .. } => Some(Message::term(chosen.label)),
            Self::Check(check) if check.ok() => Some(message!("matches the bytes before it")),
            Self::Check(check) => {
                Some(message!("does not match: computed {computed}", computed = check.computed_bytes()))
            }
            Self::Missing { width, found: 0 } => {
                Some(message!("missing, {bytes} expected", bytes = Message::bytes(width)))
            }
            Self::Missing { width, found } => Some(message!(
                "cut off, {found} of {width} there",
                found = found,
                width = Message::bytes(width)
            )),
            Self::Group | Self::Bytes => None,
        }
    }
}

/// The number's other notations, where a person may need them.
fn shown_otherwise(raw: u64, width: usize, format: Format) -> Option<Message> {
    match format {
        Format::Decimal | Format::Hex => None,
        Format::Reference(digit) => Some(message!(
            "{hex}, register {one_based}, reference {reference}",
            hex = hex_value(raw, width),
            one_based = raw + 1,
            reference = reference(digit, raw)
        )),
        Format::HexAddress => Some(message!("decimal {raw}", raw = raw)),
        Format::Register => Some(match signed(raw, width) {
            negative @ ..0 => message!(
                "{hex}, signed {signed}",
                hex = hex_value(raw, width),
                signed = Argument::Text(format!("\u{2212}{}", negative.unsigned_abs()))
            ),
            _ => message!("{hex}", hex = hex_value(raw, width)),
        }),
    }
}

/// The 4xxxx notation of a zero-based address: five digits as long as they suffice, else six.
fn reference(digit: char, address: u64) -> String {
    if address < 9999 { format!("{digit}{:04}", address + 1) } else { format!("{digit}{:05}", address + 1) }
}

fn signed(raw: u64, width: usize) -> i64 {
    let unused = 64 - 8 * width as u32;
    ((raw << unused) as i64) >> unused
}

/// Bytes in upper case hex with a space between: `01 03 00 C8`.
pub fn hex(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 16] = b"0123456789ABCDEF";
    let mut text = String::with_capacity(3 * bytes.len());
    for (index, byte) in bytes.iter().enumerate() {
        if index > 0 {
            text.push(' ');
        }
        text.push(DIGITS[usize::from(byte >> 4)].into());
        text.push(DIGITS[usize::from(byte & 15)].into());
    }
    text
}

/// A number of `width` bytes as the manuals write it: `00C8h`.
pub fn hex_value(value: u64, width: usize) -> String {
    format!("{value:0digits$X}h", digits = 2 * width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_shown_in_all_notations() {
        let spec = &const { Spec::new("start", "Start").format(Format::Reference('4')) };
        let meaning = |raw| Value::Number { raw, width: 2 }.meaning(spec).unwrap().to_string();
        assert_eq!(meaning(200), "00C8h, register 201, reference 40201");
        assert_eq!(meaning(9998), "270Eh, register 9999, reference 49999");
        assert_eq!(meaning(9999), "270Fh, register 10000, reference 410000");
        assert_eq!(meaning(65535), "FFFFh, register 65536, reference 465536");
    }

    #[test]
    fn a_check_is_shown_as_bytes_and_as_a_value() {
        let check =
            Check { kind: "crc-16/modbus", width: 2, found: 0x8435, computed: 0x8435, low_first: true };
        assert_eq!(check.found_bytes(), "84 35");
        assert_eq!(check.found_value(), 0x3584);
    }

    #[test]
    fn registers_are_shown_signed_where_that_differs() {
        let spec = &const { Spec::new("value", "Register").format(Format::Register) };
        let meaning = |raw| Value::Number { raw, width: 2 }.meaning(spec).unwrap().to_string();
        assert_eq!(meaning(128), "0080h");
        assert_eq!(meaning(0xFFFF), "FFFFh, signed \u{2212}1");
        assert_eq!(meaning(0x8000), "8000h, signed \u{2212}32768");
    }
}

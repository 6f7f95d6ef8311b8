use super::number::{float, hex, hex_value, number_text, push_number, reference, signed};
use super::{Argument, Bits, Format, Message, Name, Numbering, Range, Span, Spec};
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
    /// Bytes that are characters, [`escaped`] where they cannot be shown.
    Text(String),
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
    /// The bytes that it is over.
    pub covered: Span,
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
            Self::Group | Self::Bytes | Self::Text(_) | Self::Missing { .. } => None,
        }
    }

    pub(super) fn push_text(&self, text: &mut String, spec: &Spec) {
        match self {
            Self::Number { raw, width } | Self::Selector { raw, width, .. } => {
                push_number(text, *raw, *width, spec.format);
                if !spec.unit.is_empty() {
                    text.push(' ');
                    text.push_str(spec.unit);
                }
            }
            Self::Check(check) => hex_value(check.found_value(), check.width).push_to(text),
            Self::Text(own) => {
                for part in ["“", own, "”"] {
                    text.push_str(part);
                }
            }
            Self::Group | Self::Bytes | Self::Missing { .. } => {}
        }
    }

    pub(super) fn meaning(&self, spec: &'static Spec, number: Option<Numbering>) -> Option<Message> {
        match *self {
            Self::Text(ref text) => spec.told.and_then(|told| told(text)),
            Self::Number { raw, width } => match spec.name(raw) {
                Some(name) => Some(Message::term(name.label)),
                None if spec.range(raw).is_some() => spec.range(raw).map(|range| in_range(range, raw, width)),
                None if !spec.bits.is_empty() => Some(bits(raw, spec)),
                None if spec.format == Format::Switches => Some(switches(raw, number)),
                None => shown_otherwise(raw, width, spec.format),
            },
            Self::Selector { raw, chosen, .. } => Some(match chosen.name(raw) {
                Some(name) => Message::term(name.label),
                None if !chosen.bits.is_empty() => bits(raw, chosen),
                None => Message::term(chosen.label),
            }),
            Self::Check(check) if check.ok() => Some(message!("valid")),
            Self::Check(check) => {
                Some(message!("wrong: computed {computed}", computed = check.computed_bytes()))
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

/// What a value is called by where it lies, with the value itself: two of them can differ.
fn in_range(range: &'static Range, raw: u64, width: usize) -> Message {
    message!("{range} ({value})", range = Argument::Term(range.label), value = hex_value(raw, width))
}

/// "handshake 1, 2 bytes, write": the flags that are set and the numbers of the other parts. Three
/// or more flags in a row are "set 0 to set 7".
fn bits(raw: u64, spec: &'static Spec) -> Message {
    let mut said = Vec::new();
    let mut parts = spec.bits;
    let mut known = 0;
    let mut flags = 0;
    while let Some((part, rest)) = parts.split_first() {
        let alike = |other: &&Bits| is_set(other, raw) && numbered(part.label) == numbered(other.label);
        let run = if numbered(part.label).is_some() { parts.iter().take_while(alike).count() } else { 0 };
        let (next, left) = match parts.get(run.saturating_sub(1)) {
            Some(last) if run > 2 => (
                Some(message!(
                    "{from} to {to}",
                    from = Argument::Term(part.label),
                    to = Argument::Term(last.label)
                )),
                parts.split_at(run).1,
            ),
            _ => (part_said(part, raw), rest),
        };
        flags += usize::from(is_set(part, raw));
        known |= parts.iter().take(parts.len() - left.len()).fold(0, |mask, part| part.put(mask, u64::MAX));
        parts = left;
        said.extend(next);
    }
    if raw & !known != 0 {
        said.push(message!("bits without a meaning"));
    }
    match (Message::list(said), spec.flagged) {
        (Some(said), Some((set, _))) if flags > 0 => {
            message!("{flags} {set}", flags = said, set = Argument::Term(set))
        }
        (Some(said), _) => said,
        (None, Some((_, none))) => Message::term(none),
        (None, None) => message!("nothing set"),
    }
}

/// "set" of "set 7": what a label says before its number, if it ends with one.
fn numbered(label: &str) -> Option<&str> {
    let name = label.trim_end_matches(|c: char| c.is_ascii_digit());
    (name != label).then_some(name)
}

/// Whether a part is a flag without names, and set.
fn is_set(part: &Bits, raw: u64) -> bool {
    part.count == 1 && !part.reserved && part.names.is_empty() && part.of(raw) == 1
}

/// What a part says, where it says something.
fn part_said(part: &'static Bits, raw: u64) -> Option<Message> {
    let value = part.of(raw);
    match (part.name(value), part.count) {
        (Some(Name { label: "", .. }), _) => None,
        (Some(name), _) => Some(Message::term(name.label)),
        (None, _) if part.range(value).is_some() => {
            part.range(value).map(|range| in_range(range, value, part.count.div_ceil(8) as usize))
        }
        (None, _) if part.reserved => (value != 0).then(|| message!("reserved bits")),
        (None, 1) => (value != 0).then(|| Message::term(part.label)),
        (None, count) => Some(message!(
            "{part} {n}",
            part = Argument::Term(part.label),
            n = number_text(value, count.div_ceil(8) as usize, part.format)
        )),
    }
}

/// "16, 18 on": which of eight switches are, the first one's number where it is known.
fn switches(raw: u64, number: Option<Numbering>) -> Message {
    let (sign, first) = match number {
        Some(Numbering::At(first)) => ("", first),
        Some(Numbering::Offset(first)) => ("+", first),
        None => ("+", 0),
    };
    let on: Vec<String> =
        (0..8).filter(|bit| raw >> bit & 1 == 1).map(|bit| format!("{sign}{}", first + bit)).collect();
    match on.len() {
        0 => message!("all off"),
        8 => message!("all on"),
        _ => message!("{which} on", which = on.join(", ")),
    }
}

/// The number's other notations, where a person may need them.
fn shown_otherwise(raw: u64, width: usize, format: Format) -> Option<Message> {
    match format {
        Format::Decimal | Format::Hex | Format::Switches | Format::Text => None,
        Format::Float if float(raw, width).starts_with("NaN") => None,
        Format::Signed | Format::Float | Format::Places(_) => {
            Some(message!("{hex}", hex = hex_value(raw, width)))
        }
        Format::DayMonthYear => Some(message!(
            "{day}.{month}., year ending in {digit}",
            day = raw / 1000,
            month = format!("{:02}", raw / 10 % 100),
            digit = raw % 10
        )),
        Format::Reference(digit @ ('0' | '1')) => Some(message!(
            "{hex}, number {one_based}, reference {reference}",
            hex = hex_value(raw, width),
            one_based = raw + 1,
            reference = reference(digit, raw)
        )),
        Format::Reference(digit) => Some(message!(
            "{hex}, register {one_based}, reference {reference}",
            hex = hex_value(raw, width),
            one_based = raw + 1,
            reference = reference(digit, raw)
        )),
        Format::HexAddress => Some(message!("decimal {raw}", raw = raw)),
        Format::Register => Some(match signed(raw, width) {
            negative @ ..0 => {
                message!("{hex}, signed {signed}", hex = hex_value(raw, width), signed = negative)
            }
            _ => message!("{hex}", hex = hex_value(raw, width)),
        }),
    }
}

/// Characters as text; what is not a printable one, and the backslash, as `\\x5C`.
pub fn escaped(bytes: &[u8]) -> String {
    let mut text = String::new();
    for byte in bytes {
        match byte {
            b'\\' | ..b' ' | 0x7F.. => text.push_str(&format!("\\x{byte:02X}")),
            _ => text.push(char::from(*byte)),
        }
    }
    text
}

/// The bytes of such a text; `Err` is what cannot be one byte.
pub fn unescaped(text: &str) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let mut rest = text.chars();
    while let Some(c) = rest.next() {
        let code = if c == '\\' {
            let written: String = rest.by_ref().take(3).collect();
            let digits = written.strip_prefix('x').filter(|digits| digits.len() == 2);
            digits
                .and_then(|digits| u8::from_str_radix(digits, 16).ok())
                .ok_or_else(|| format!("\\{written}"))?
        } else {
            u8::try_from(c).map_err(|_| c.to_string())?
        };
        bytes.push(code);
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_comes_back() {
        let all: Vec<u8> = (0..=255).collect();
        assert_eq!(unescaped(&escaped(&all)), Ok(all));
        assert_eq!(escaped(b"a\\\0"), "a\\x5C\\x00");
        assert!(unescaped("\\x1").is_err());
        assert!(unescaped("€").is_err());
    }

    #[test]
    fn switches_are_named_by_number() {
        assert_eq!(switches(5, Some(Numbering::At(16))).to_string(), "16, 18 on");
        assert_eq!(switches(128, Some(Numbering::Offset(8))).to_string(), "+15 on");
        assert_eq!(switches(0, None).to_string(), "all off");
    }

    #[test]
    fn addresses_are_shown_in_all_notations() {
        let spec = &const { Spec::new("start", "Start").format(Format::Reference('4')) };
        let meaning = |raw| Value::Number { raw, width: 2 }.meaning(spec, None).unwrap().to_string();
        assert_eq!(meaning(200), "00C8h, register 201, reference 40201");
        assert_eq!(meaning(9998), "270Eh, register 9999, reference 49999");
        assert_eq!(meaning(9999), "270Fh, register 10000, reference 410000");
        assert_eq!(meaning(65535), "FFFFh, register 65536, reference 465536");
    }

    #[test]
    fn a_check_is_shown_as_bytes_and_as_a_value() {
        let check = Check {
            kind: "crc-16/modbus",
            width: 2,
            found: 0x8435,
            computed: 0x8435,
            low_first: true,
            covered: Span::new(0, 6),
        };
        assert_eq!(check.found_bytes(), "84 35");
        assert_eq!(check.found_value(), 0x3584);
    }

    #[test]
    fn registers_are_shown_signed_where_that_differs() {
        let spec = &const { Spec::new("value", "Register").format(Format::Register) };
        let meaning = |raw| Value::Number { raw, width: 2 }.meaning(spec, None).unwrap().to_string();
        assert_eq!(meaning(128), "0080h");
        assert_eq!(meaning(0xFFFF), "FFFFh, signed \u{2212}1");
        assert_eq!(meaning(0x8000), "8000h, signed \u{2212}32768");
    }
}

//! Numbers and bytes as text.

use std::fmt;

use super::Format;

/// A number of `width` bytes as a form shows it and takes it again.
pub fn number_text(raw: u64, width: usize, format: Format) -> String {
    let mut text = String::new();
    push_number(&mut text, raw, width, format);
    text
}

/// The same behind what `text` holds.
pub fn push_number(text: &mut String, raw: u64, width: usize, format: Format) {
    match format {
        Format::Hex | Format::HexAddress | Format::Switches => hex_value(raw, width).push_to(text),
        Format::Signed => push_signed(text, signed(raw, width)),
        Format::Float => text.push_str(&float(raw, width)),
        Format::Places(places) => {
            let one = 10_u64.pow(places);
            push_digits(text, raw / one, 1);
            text.push('.');
            push_digits(text, raw % one, places as usize);
        }
        Format::Decimal | Format::Reference(_) | Format::Register | Format::DayMonthYear | Format::Text => {
            push_digits(text, raw, 1);
        }
    }
}

/// The decimal digits of a number, with zeros before it where it has less than `least`.
///
/// The standard library does the same, in three times the time: the JSON of a telegram has forty numbers.
pub fn push_digits(text: &mut String, number: u64, least: usize) {
    if number > 9 || least > 1 {
        push_digits(text, number / 10, least.saturating_sub(1));
    }
    text.push(char::from(b'0' + (number % 10) as u8));
}

/// The IEEE 754 number of `width` bytes, as short as it can be told apart from its neighbours.
///
/// The standard library does the same, for 20 kB in the page.
pub fn float(raw: u64, width: usize) -> String {
    let mut buffer = [0; lexical_core::BUFFER_SIZE];
    // The shortest digits of a number depend on how wide it is.
    let (text, finite) = if width == 4 {
        let value = f32::from_bits(raw as u32);
        (lexical_core::write(value, &mut buffer), value.is_finite())
    } else {
        let value = f64::from_bits(raw);
        (lexical_core::write(value, &mut buffer), value.is_finite())
    };
    if !finite {
        let infinite = raw << (65 - 8 * width) == if width == 4 { 0xFF00_0000 << 32 } else { 0x7FF0 << 49 };
        return match (infinite, raw >> (8 * width - 1)) {
            (true, 0) => "infinity".to_owned(),
            (true, _) => "\u{2212}infinity".to_owned(),
            // Which of the many it is, so that writing it gives the same bytes.
            (false, _) => format!("NaN({})", hex_value(raw, width)),
        };
    }
    let text = str::from_utf8(text).unwrap_or_default();
    text.strip_suffix(".0").unwrap_or(text).replace(".0e", "e").replace('-', "\u{2212}")
}

/// A number as short as it can be told apart from its neighbours.
pub fn shortest(value: f64) -> String {
    float(value.to_bits(), 8)
}

/// A number with so many places behind the point, at most 9, a half rounded away from 0; "0.0" for what is no number.
///
/// The standard library does the same, for 20 kB in the page.
///
/// ```
/// use buslens::field::decimal;
///
/// assert_eq!(decimal(2.05, 1), "2.1");
/// assert_eq!(decimal(-0.04, 1), "-0.0");
/// assert_eq!(decimal(99.6, 0), "100");
/// ```
pub fn decimal(value: f64, places: u32) -> String {
    let one = 10_u64.pow(places.min(9));
    // What is larger than the type is its largest, as is everywhere with `as`.
    let rounded = (value.abs() * one as f64 + 0.5) as u64;
    let sign = if value.is_sign_negative() { "-" } else { "" };
    let whole = rounded / one;
    match places {
        0 => format!("{sign}{whole}"),
        _ => format!("{sign}{whole}.{:0digits$}", rounded % one, digits = places as usize),
    }
}

/// The bits of the number that `text` writes, in `width` bytes; `None` where it is no number, or one
/// that is too large.
///
/// ```
/// use buslens::field::parse_float;
///
/// assert_eq!(parse_float("123.456", 4), Some(0x42F6_E979));
/// assert_eq!(parse_float("1e99", 4), None);
/// ```
pub fn parse_float(text: &str, width: usize) -> Option<u64> {
    let infinity = |text: &str| text.trim_start_matches('-') == "infinity";
    let text = text.replace('\u{2212}', "-");
    let value: f64 = lexical_core::parse(text.as_bytes()).ok()?;
    // Rounding twice gives the same as rounding once for everything of less than 17 digits.
    let (raw, finite) = match width {
        4 => ((value as f32).to_bits().into(), (value as f32).is_finite()),
        _ => (value.to_bits(), value.is_finite()),
    };
    // 1e99 is a number to us, and infinity to a float of 4 bytes: nobody means that.
    (finite || infinity(&text)).then_some(raw)
}

/// The 4xxxx notation of a zero-based address: five digits as long as they suffice, else six.
pub(super) fn reference(digit: char, address: u64) -> String {
    let mut text = String::from(digit);
    push_digits(&mut text, address + 1, if address < 9999 { 4 } else { 5 });
    text
}

/// The number in two's complement.
pub(super) fn signed(raw: u64, width: usize) -> i64 {
    let unused = 64 - 8 * width as u32;
    ((raw << unused) as i64) >> unused
}

/// A number that may be below 0, with the sign for it.
pub(super) fn push_signed(text: &mut String, number: i64) {
    if number < 0 {
        text.push('\u{2212}');
    }
    push_digits(text, number.unsigned_abs(), 1);
}

/// Bytes in upper case hex with a space between: `01 03 00 C8`.
pub fn hex(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(3 * bytes.len());
    push_hex(&mut text, bytes);
    text
}

/// The same behind what `text` holds.
pub fn push_hex(text: &mut String, bytes: &[u8]) {
    for (index, byte) in bytes.iter().enumerate() {
        if index > 0 {
            text.push(' ');
        }
        text.push(DIGITS[usize::from(byte >> 4)].into());
        text.push(DIGITS[usize::from(byte & 15)].into());
    }
}

/// A number of `width` bytes as the manuals write it: `00C8h`.
pub const fn hex_value(value: u64, width: usize) -> HexValue {
    HexValue { value, width }
}

/// A number that is shown in hex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HexValue {
    value: u64,
    width: usize,
}

impl HexValue {
    pub(super) fn push_to(self, text: &mut String) {
        let needed = 16 - self.value.leading_zeros() as usize / 4;
        for place in (0..needed.max(2 * self.width)).rev() {
            let digit = self.value.checked_shr(4 * place as u32).unwrap_or_default() & 15;
            text.push(DIGITS[digit as usize].into());
        }
        text.push('h');
    }
}

impl fmt::Display for HexValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::new();
        self.push_to(&mut text);
        f.write_str(&text)
    }
}

const DIGITS: &[u8; 16] = b"0123456789ABCDEF";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_are_as_short_as_they_can_be() {
        for (raw, width, text) in [
            (0x42F6_E979, 4, "123.456"),
            (0x405E_DD2F_1A9F_BE77, 8, "123.456"),
            (0x42A4_0000, 4, "82"),
            (0xC974_23F0, 4, "\u{2212}999999"),
            (0x0000_0001, 4, "1e\u{2212}45"),
            (0x7F80_0000, 4, "infinity"),
            (0xFF80_0000, 4, "\u{2212}infinity"),
            (0x7FF0_0000_0000_0000, 8, "infinity"),
            (0x7FC0_0001, 4, "NaN(7FC00001h)"),
        ] {
            assert_eq!(float(raw, width), text, "{raw:X}");
        }
    }

    #[test]
    fn digits_are_those_of_the_standard_library() {
        let digits = |number, least| {
            let mut text = String::new();
            push_digits(&mut text, number, least);
            text
        };
        for number in [0, 1, 9, 10, 99, 100, 65535, 1_000_000_007, u64::MAX] {
            assert_eq!(digits(number, 1), number.to_string());
            assert_eq!(digits(number, 3), format!("{number:03}"));
            assert_eq!(hex_value(number, 2).to_string(), format!("{number:04X}h"));
            assert_eq!(hex_value(number, 8).to_string(), format!("{number:016X}h"));
        }
        assert_eq!(number_text(5, 2, Format::Places(2)), "0.05");
    }
}

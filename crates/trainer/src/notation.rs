//! Numbers as people write them: decimal, hex and binary in every usual way, with a comma or a point.

use buslens::field::{Argument, Format, Message, hex_value, number_text, parse_float};
use buslens::message;

/// How a number is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Notation {
    /// In whatever way; what does not say otherwise is decimal.
    #[default]
    Any,
    Decimal,
    /// Digits by themselves are hex.
    Hex,
    /// Digits by themselves are binary.
    Binary,
}

/// A number that was read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Written {
    /// Its bits, in the width that was asked for.
    pub raw: u64,
    /// How it was written: never [`Notation::Any`].
    pub notation: Notation,
    /// Significant digits, for rounded ones.
    pub digits: usize,
}

/// Reads a number of `width` bytes: `200`, `0xC8`, `C8h`, `$C8`, `16#C8`, `0b11001000`, `1100 1000b`, `−5`,
/// `82,4724`, `1e6`. `notation` says what digits by themselves are. A minus is two's complement.
pub fn read(text: &str, width: usize, format: Format, notation: Notation) -> Result<Written, Message> {
    let plain = squeezed(text);
    let widest = u64::MAX >> (64 - 8 * width);
    if plain.is_empty() {
        return Err(message!("there is no number in it"));
    }
    let (marked, digits) = match marked(&plain) {
        Some((marked, digits)) => (marked, digits),
        None => (notation, plain.as_str()),
    };
    let whole = |radix, written| {
        u64::from_str_radix(digits, radix).ok().filter(|_| !digits.starts_with('+')).map(|raw| Written {
            raw,
            notation: written,
            digits: digits.len(),
        })
    };
    let read = match marked {
        Notation::Hex => whole(16, Notation::Hex),
        Notation::Binary => whole(2, Notation::Binary),
        Notation::Any | Notation::Decimal => decimal(digits, width, format),
    };
    read.filter(|written| written.raw <= widest).ok_or_else(|| {
        message!(
            "“{text}” is not a number that fits here: write it like {examples}",
            text = text.trim().to_owned(),
            examples = Argument::Term(match (format, notation) {
                (Format::Float | Format::Places(_), _) => "82.5 or −0.25",
                (_, Notation::Hex) => "00C8 or 00C8h",
                (_, Notation::Binary) => "1100 1000",
                _ => "200, 00C8h or 0xC8",
            })
        )
    })
}

/// Without what only groups the digits, in small letters, with a minus that programs know.
fn squeezed(text: &str) -> String {
    let keep = |c: &char| !c.is_whitespace() && !matches!(c, '_' | '\'' | '’');
    let minus = |c| if c == '\u{2212}' || c == '–' { '-' } else { c };
    text.trim().chars().filter(keep).map(minus).map(|c| c.to_ascii_lowercase()).collect()
}

/// What says by itself how it is written, and its digits.
fn marked(plain: &str) -> Option<(Notation, &str)> {
    let prefixes = [
        ("0x", Notation::Hex),
        ("\\x", Notation::Hex),
        ("16#", Notation::Hex),
        ("&h", Notation::Hex),
        ("$", Notation::Hex),
        ("0b", Notation::Binary),
        ("2#", Notation::Binary),
        ("%", Notation::Binary),
        ("10#", Notation::Decimal),
    ];
    for (prefix, notation) in prefixes {
        if let Some(digits) = plain.strip_prefix(prefix).filter(|digits| !digits.is_empty()) {
            // 0B1 with nothing but binary digits is binary; 0BFFh is not.
            let binary = digits.bytes().all(|digit| matches!(digit, b'0' | b'1'));
            if notation != Notation::Binary || binary {
                return Some((notation, digits));
            }
        }
    }
    let is = |digits: &str, known: fn(&u8) -> bool| !digits.is_empty() && digits.as_bytes().iter().all(known);
    let hex = plain.strip_suffix('h').filter(|digits| is(digits, u8::is_ascii_hexdigit));
    let binary =
        plain.strip_suffix('b').filter(|digits| digits.len() > 3 && is(digits, |d| matches!(d, b'0' | b'1')));
    let only_hex = is(plain, u8::is_ascii_hexdigit) && plain.bytes().any(|digit| digit.is_ascii_alphabetic());
    // What is no exponent, and has letters that only hex has.
    let letters =
        only_hex && !(plain.contains('e') && plain.bytes().all(|d| d.is_ascii_digit() || d == b'e'));
    match (hex, binary) {
        (Some(digits), _) => Some((Notation::Hex, digits)),
        (None, Some(digits)) => Some((Notation::Binary, digits)),
        _ => letters.then_some((Notation::Hex, plain)),
    }
}

fn decimal(plain: &str, width: usize, format: Format) -> Option<Written> {
    // One comma is a point, as much of Europe writes it.
    let text = match plain.matches(',').count() {
        1 if !plain.contains('.') => plain.replace(',', "."),
        _ => plain.to_owned(),
    };
    let known = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e');
    if !text.chars().all(known) || !text.chars().any(|c| c.is_ascii_digit()) {
        return None;
    }
    let mantissa = text.split('e').next().unwrap_or_default();
    let digits =
        mantissa.trim_start_matches(['-', '+', '0', '.']).chars().filter(char::is_ascii_digit).count().max(1);
    let written = |raw| Written { raw, notation: Notation::Decimal, digits };
    let widest = u64::MAX >> (64 - 8 * width);
    match format {
        Format::Float => parse_float(text.trim_start_matches('+'), width).map(written),
        Format::Places(places) => {
            let (whole, behind) = text.split_once('.').unwrap_or((&text, ""));
            let behind = behind.trim_end_matches('0');
            if behind.len() > places as usize {
                return None;
            }
            let padded = format!("{whole}{behind:0<digits$}", digits = places as usize);
            padded.parse().ok().map(written)
        }
        _ => {
            // 200.0 is 200.
            let whole = match text.split_once('.') {
                Some((whole, behind)) if behind.bytes().all(|digit| digit == b'0') => whole,
                Some(_) => return None,
                None => text.as_str(),
            };
            match whole.strip_prefix('-') {
                Some(digits) => {
                    let amount: u64 = digits.parse().ok().filter(|amount| *amount <= widest / 2 + 1)?;
                    Some(written(amount.wrapping_neg() & widest))
                }
                None => whole.parse().ok().map(written),
            }
        }
    }
}

/// A number in hex and decimal, for remarks: "200 (00C8h)".
pub fn both(raw: u64, width: usize) -> String {
    format!("{} ({})", number_text(raw, width, Format::Decimal), hex_value(raw, width))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(text: &str, notation: Notation) -> Option<(u64, Notation)> {
        read(text, 2, Format::Decimal, notation).ok().map(|written| (written.raw, written.notation))
    }

    #[test]
    fn every_usual_way_is_read() {
        for text in
            ["0xC8", "0XC8", "C8h", "00c8H", "$C8", "16#C8", "&HC8", "C8", "0x 00 C8", "0x00_C8", "00C8 h"]
        {
            assert_eq!(whole(text, Notation::Any), Some((200, Notation::Hex)), "{text}");
        }
        for text in ["200", " 0200 ", "200.0", "2 00", "10#200", "+200"] {
            assert_eq!(whole(text, Notation::Any), Some((200, Notation::Decimal)), "{text}");
        }
        for text in ["0b11001000", "1100 1000b", "2#11001000", "%11001000"] {
            assert_eq!(whole(text, Notation::Any), Some((200, Notation::Binary)), "{text}");
        }
        assert_eq!(whole("200", Notation::Hex), Some((0x200, Notation::Hex)));
        assert_eq!(whole("00C8", Notation::Hex), Some((200, Notation::Hex)));
        assert_eq!(whole("1100 1000", Notation::Binary), Some((200, Notation::Binary)));
        assert_eq!(whole("−2", Notation::Any), Some((0xFFFE, Notation::Decimal)));
        for text in
            ["", "no", "1.5", "70000", "-40000", "0x", "0xG1", "12h4", "1-2", "--1", "1,2,3", "0x10000"]
        {
            assert_eq!(whole(text, Notation::Any), None, "{text}");
        }
    }

    #[test]
    fn floats_have_a_point_or_a_comma() {
        for text in ["82.5", "82,5", "8.25e1", "82.50", "+82.5"] {
            let read = read(text, 4, Format::Float, Notation::Any).unwrap();
            assert_eq!(read.raw, u64::from(82.5_f32.to_bits()), "{text}");
        }
        assert_eq!(read("1,5", 2, Format::Places(1), Notation::Any).unwrap().raw, 15);
        assert_eq!(read("1.50", 2, Format::Places(1), Notation::Any).unwrap().raw, 15);
        assert!(read("1.55", 2, Format::Places(1), Notation::Any).is_err());
        assert_eq!(read("0.0120", 4, Format::Float, Notation::Any).unwrap().digits, 3);
    }
}

//! Texts that are not UTF-8.

use std::borrow::Cow;

/// How a text file's characters are coded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// ASCII, UTF-8, or one of the old code pages: digits are the same in all.
    Bytes,
    Utf16LittleEndian,
    Utf16BigEndian,
    /// No text.
    Binary,
}

/// Tells the encoding from the beginning of a file.
pub fn encoding(beginning: &[u8]) -> Encoding {
    match beginning {
        [0xFF, 0xFE, ..] => return Encoding::Utf16LittleEndian,
        [0xFE, 0xFF, ..] => return Encoding::Utf16BigEndian,
        _ => {}
    }
    const ENOUGH: usize = 4096;
    let looked = &beginning[..beginning.len().min(ENOUGH)];
    let zeros = |parity: usize| looked.iter().skip(parity).step_by(2).filter(|c| **c == 0).count();
    let (even, odd) = (zeros(0), zeros(1));
    let text = |parity: usize| {
        let mut half = looked.iter().skip(parity).step_by(2);
        looked.len() > 3 && half.all(|c| matches!(c, b'\t' | b'\n' | b'\r' | b' '..=b'~'))
    };
    if even == 0 && odd == looked.len() / 2 && text(0) {
        return Encoding::Utf16LittleEndian;
    }
    if odd == 0 && even == looked.len().div_ceil(2) && text(1) {
        return Encoding::Utf16BigEndian;
    }
    let odd_controls = looked.iter().filter(|c| matches!(c, 0..=6 | 14..=26 | 28..=31 | 127)).count();
    if odd_controls * 50 > looked.len() { Encoding::Binary } else { Encoding::Bytes }
}

impl Encoding {
    pub const fn is_utf16(self) -> bool {
        matches!(self, Self::Utf16LittleEndian | Self::Utf16BigEndian)
    }

    /// How many of `bytes` are whole characters, when more may come.
    pub fn whole(self, bytes: &[u8]) -> usize {
        let even = bytes.len() & !1;
        let last = bytes.get(even.wrapping_sub(2)..even).unwrap_or_default();
        let high = match self {
            Self::Utf16LittleEndian => last.last(),
            Self::Utf16BigEndian => last.first(),
            Self::Bytes | Self::Binary => return bytes.len(),
        };
        // The first half of a character that takes two units.
        if high.is_some_and(|high| matches!(high, 0xD8..=0xDB)) { even - 2 } else { even }
    }

    /// The beginning of a text as bytes of which each digit is one: UTF-16 as UTF-8, without its mark
    /// and with � for halves of characters.
    pub fn text(self, bytes: &[u8]) -> Cow<'_, [u8]> {
        let mark = match self {
            Self::Utf16LittleEndian => [0xFF, 0xFE],
            Self::Utf16BigEndian => [0xFE, 0xFF],
            Self::Bytes | Self::Binary => return Cow::Borrowed(bytes),
        };
        let mut unmarked = bytes;
        while let Some(rest) = unmarked.strip_prefix(&mark) {
            unmarked = rest;
        }
        self.further(unmarked)
    }

    /// The same of what comes behind the beginning.
    pub fn further(self, bytes: &[u8]) -> Cow<'_, [u8]> {
        let unit: fn([u8; 2]) -> u16 = match self {
            Self::Utf16LittleEndian => u16::from_le_bytes,
            Self::Utf16BigEndian => u16::from_be_bytes,
            Self::Bytes | Self::Binary => return Cow::Borrowed(bytes),
        };
        let (pairs, _) = bytes.as_chunks();
        let units = pairs.iter().map(|pair| unit(*pair));
        let mut utf8 = Vec::with_capacity(bytes.len() / 2);
        for c in char::decode_utf16(units) {
            let c = c.unwrap_or(char::REPLACEMENT_CHARACTER);
            utf8.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes());
        }
        Cow::Owned(utf8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encodings_are_told() {
        assert_eq!(encoding(b"01 03 00 C8"), Encoding::Bytes);
        assert_eq!(encoding(b""), Encoding::Bytes);
        assert_eq!(encoding(&[1, 3, 0, 200, 0, 3, 0x84, 0x35]), Encoding::Binary);
        for (big, marked) in [(false, false), (false, true), (true, false), (true, true)] {
            let text: String = if marked { "\u{FEFF}TX: 01 é".into() } else { "TX: 01 03".into() };
            let bytes: Vec<u8> = text
                .encode_utf16()
                .flat_map(|unit| if big { unit.to_be_bytes() } else { unit.to_le_bytes() })
                .collect();
            let found = encoding(&bytes);
            let expected = if big { Encoding::Utf16BigEndian } else { Encoding::Utf16LittleEndian };
            assert_eq!(found, expected, "{text}");
            assert_eq!(found.text(&bytes), text.trim_start_matches('\u{FEFF}').as_bytes());
        }
    }

    #[test]
    fn characters_of_two_units_stay_whole() {
        for (encoding, text) in [
            (Encoding::Utf16LittleEndian, [0x3D, 0xD8, 0x00, 0xDE, 0x41, 0x00]),
            (Encoding::Utf16BigEndian, [0xD8, 0x3D, 0xDE, 0x00, 0x00, 0x41]),
        ] {
            let whole: Vec<usize> = (0..=6).map(|length| encoding.whole(&text[..length])).collect();
            assert_eq!(whole, [0, 0, 0, 0, 4, 4, 6], "{encoding:?}");
            assert_eq!(encoding.text(&text), "\u{1F600}A".as_bytes());
        }
        assert_eq!(Encoding::Bytes.whole(b"abc"), 3);
        // A mark within a text is a character of it.
        assert_eq!(Encoding::Utf16BigEndian.further(&[0xFE, 0xFF]), "\u{FEFF}".as_bytes());
    }
}

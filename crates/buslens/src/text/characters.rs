//! What characters stand for: bytes with escapes, numbers, what parts them.

/// The byte of a character in a string, and how long it is there.
pub fn character(text: &[u8]) -> (u8, usize) {
    let octal = text.iter().skip(1).take(3).take_while(|c| (b'0'..=b'7').contains(c)).count();
    match text {
        [b'\\', b'x' | b'X', a, b, ..] if a.is_ascii_hexdigit() && b.is_ascii_hexdigit() => {
            (hex_value(&[*a, *b]), 4)
        }
        [b'\\', b'u', b'0', b'0', a, b, ..] | [b'\\', b'x', b'{', a, b, b'}', ..]
            if a.is_ascii_hexdigit() && b.is_ascii_hexdigit() =>
        {
            (hex_value(&[*a, *b]), 6)
        }
        [b'\\', ..] if octal > 0 => {
            let value = text[1..=octal].iter().fold(0_u32, |sum, c| sum * 8 + u32::from(c - b'0'));
            (value as u8, 1 + octal)
        }
        [b'\\', c, ..] => {
            let byte = match c {
                b'n' => b'\n',
                b'r' => b'\r',
                b't' => b'\t',
                b'a' => 7,
                b'b' => 8,
                b'v' => 11,
                b'f' => 12,
                c => *c,
            };
            (byte, 2)
        }
        // A letter of Latin-1 in UTF-8 is its byte.
        [lead @ (0xC2 | 0xC3), next @ 0x80..0xC0, ..] => (((lead & 3) << 6) + (next & 0x3F), 2),
        [c, ..] => (*c, 1),
        [] => (0, 1),
    }
}

/// The number of the escape that begins `text`, read as a decimal one, and how long it is: `\148`.
pub fn decimal_escape(text: &[u8]) -> Option<(u64, usize)> {
    const LONGEST: usize = 4;
    digits(&text[..text.len().min(LONGEST)], 1).filter(|_| text[0] == b'\\')
}

/// Whether a text has an escape of three digits that are no octal byte: its others are decimal, too.
pub fn has_decimal_escapes(text: &[u8]) -> bool {
    let decimal = |at: usize| match text.get(at + 1..at + 4) {
        Some(digits) => {
            digits.iter().all(u8::is_ascii_digit)
                && (digits[0] > b'3' || digits.iter().any(|c| matches!(c, b'8' | b'9')))
        }
        None => false,
    };
    memchr::memchr_iter(b'\\', text).any(decimal)
}

/// Whether `c` is a letter or a digit. Beyond ASCII this goes by blocks: the tables of Unicode would be 2 kB of
/// the page.
pub const fn is_letter_or_digit(c: char) -> bool {
    match c {
        '×' | '÷' => false,
        'ª' | 'µ' | 'º' | 'À'..='\u{1FFF}' | '\u{2C00}'..='\u{2DFF}' | '\u{3040}'..='\u{D7FF}' => true,
        _ => c.is_ascii_alphanumeric(),
    }
}

/// What kind of separator `gap` is: its first mark, or a blank; `None` if it parts more than bytes. Colours
/// of a terminal and marks of emphasis are nothing.
pub fn separator(gap: &[u8]) -> Option<u8> {
    const LONGEST: usize = 24;
    let (mut blank, mut mark, mut emphasis) = (false, 0, 0);
    let mut at = 0;
    if gap.len() > LONGEST {
        return None;
    }
    while let Some(c) = gap.get(at) {
        match c {
            // An ellipsis: bytes are left out.
            b'.' if gap.get(at + 1) == Some(&b'.') => return None,
            b' ' | b'\t' => blank = true,
            b'*' | b'_' | b'~' => emphasis = if emphasis == 0 { *c } else { emphasis },
            // Bytes follow it.
            b'%' if gap[at..] == *URL_BLANK => {
                blank = true;
                break;
            }
            b',' | b';' | b':' | b'.' | b'-' | b'|' | b'/' | b'[' | b']' | b'<' | b'>' | b'"' | b'\''
            | b'$' | b'%' | b'#' => mark = if mark == 0 { *c } else { mark },
            &ESCAPE => at += escape_sequence(&gap[at..]).checked_sub(1)?,
            0x80.. => {
                at += blank_character(&gap[at..]).checked_sub(1)?;
                blank = true;
            }
            _ => return None,
        }
        at += 1;
    }
    Some(match (mark, blank, emphasis) {
        (0, true, _) => b' ',
        (0, false, emphasis) => emphasis,
        (mark, ..) => mark,
    })
}

/// A blank in an address of the web.
const URL_BLANK: &[u8] = b"%20";

/// How long the blank of an address is that begins `text`: one that bytes follow, in two digits or with a prefix; else
/// 0.
pub fn url_blank(text: &[u8]) -> usize {
    let bytes = match text.strip_prefix(URL_BLANK) {
        Some([b'0', b'x' | b'X', ..]) => true,
        Some([a, b, rest @ ..]) => {
            a.is_ascii_hexdigit() && b.is_ascii_hexdigit() && !rest.first().is_some_and(|c| is_word(*c))
        }
        _ => false,
    };
    if bytes { URL_BLANK.len() } else { 0 }
}

pub const ESCAPE: u8 = 0x1B;

/// How long the sequence for a terminal is that begins `text`: `ESC [ 0 m`; 0 if it is none.
pub fn escape_sequence(text: &[u8]) -> usize {
    const LONGEST: usize = 16;
    let [ESCAPE, b'[', rest @ ..] = text else { return 0 };
    let length = rest.iter().take(LONGEST).take_while(|c| is_digit(**c) || matches!(c, b';' | b'?')).count();
    match rest.get(length) {
        Some(c) if c.is_ascii_alphabetic() => 2 + length + 1,
        _ => 0,
    }
}

/// How long the character that begins `text` is, if it is a blank beyond ASCII or a dash or quote in the
/// place of the plain one; else 0.
pub fn blank_character(text: &[u8]) -> usize {
    match text {
        [0xC2, 0xA0, ..] => 2,
        // Wide, narrow and invisible blanks, hyphens, quotes.
        [0xE2, 0x80, 0x80..=0x9F | 0xAF, ..] | [0xE3, 0x80, 0x80 | 0x81, ..] | [0xEF, 0xBB, 0xBF, ..] => 3,
        _ => 0,
    }
}

/// The value of decimal digits and nothing else.
pub fn decimal(text: &[u8]) -> Option<usize> {
    let (value, to) = digits(text, 0)?;
    (to == text.len()).then(|| usize::try_from(value).ok()).flatten()
}

/// Whether all of a text is one decimal number that begins with no zero, as serial numbers are.
pub fn is_serial_number(text: &[u8]) -> bool {
    text.first() != Some(&b'0') && text.iter().all(|c| is_digit(*c))
}

/// Whether a text is a number that one dials, in five pairs, none of them of zeros: `01 42 17 03 55`.
pub fn is_phone_number(text: &[u8]) -> bool {
    const LENGTH: usize = 14;
    let pairs = || text.chunks(3).map(|pair| &pair[..pair.len().min(2)]);
    text.len() == LENGTH
        && text[0] == b'0'
        && pairs().all(|pair| pair != b"00" && pair.iter().all(|c| is_digit(*c)))
        && text.chunks_exact(3).all(|pair| pair[2] == text[2])
}

/// Whether digits are the bits of a number: `00010000`, `0b00010000`.
pub fn is_bits(text: &[u8]) -> bool {
    let marked = text.starts_with(b"0b") || text.starts_with(b"0B");
    let bits = if marked { &text[2..] } else { text };
    matches!(bits.len(), 8 | 16 | 32)
        && bits.iter().all(|c| matches!(c, b'0' | b'1'))
        && (marked || bits.contains(&b'1'))
}

/// Whether `at..to` is all that a cell of a table has, in capital letters: `| BDCB |`.
pub fn fills_cell(line: &[u8], at: usize, to: usize) -> bool {
    let before = line[..at].trim_ascii_end().last();
    let behind = line[to..].trim_ascii_start().first();
    before == Some(&b'|') && behind == Some(&b'|') && line[at..to].iter().all(u8::is_ascii_uppercase)
}

/// A number for a word: the same for the same letters, whatever digits are among them.
pub fn word_of(word: &[u8]) -> u32 {
    let letters = word.iter().filter(|c| c.is_ascii_alphabetic());
    letters.fold(0x811C_9DC5, |hash, c| (hash ^ u32::from(c | 0x20)).wrapping_mul(0x0100_0193))
}

/// The end of an IP address, with its port: four decimal numbers with dots between, and no more.
pub fn address(line: &[u8], at: usize) -> Option<usize> {
    let mut to = at;
    for part in 0..4 {
        if part > 0 {
            to = (line.get(to) == Some(&b'.')).then_some(to + 1)?;
        }
        let (value, end) = digits(line, to)?;
        to = (value < 256 && end - to <= 3).then_some(end)?;
    }
    match line.get(to) {
        Some(b':') => Some(digits(line, to + 1).map_or(to, |(_, end)| end)),
        // tcpdump parts the port with a dot: no byte is so high.
        Some(b'.') if line.get(to + 1).is_some_and(u8::is_ascii_hexdigit) => {
            digits(line, to + 1).filter(|(value, _)| *value > 255).map(|(_, end)| end)
        }
        Some(c) if is_word(*c) => None,
        _ => Some(to),
    }
}

/// The number behind an address: the client has a high one.
pub fn service(address: &[u8]) -> Option<u64> {
    let marks = |c: &u8| matches!(c, b'.' | b':');
    let mut places = (0..address.len()).filter(|at| marks(&address[*at]));
    digits(address, places.nth(3)? + 1).map(|(number, _)| number)
}

/// Whether a word names a serial port.
pub fn is_port(word: &[u8]) -> bool {
    if !matches!(word, [b'c' | b'C' | b't' | b'T', .., last] if is_digit(*last)) {
        return false;
    }
    let numbered = |prefix: &[u8]| {
        word.split_at_checked(prefix.len()).is_some_and(|(name, number)| {
            name.eq_ignore_ascii_case(prefix) && number.iter().all(|c| is_digit(*c))
        })
    };
    [b"com".as_slice(), b"ttyusb", b"ttys", b"ttyacm", b"ttyama"].into_iter().any(numbered)
}

/// The number whose digits begin at `at`, and where they end.
pub fn digits(line: &[u8], at: usize) -> Option<(u64, usize)> {
    const MOST: usize = 15;
    let (mut value, mut to) = (0, at);
    while let Some(c) = line.get(to).filter(|c| is_digit(**c) && to - at <= MOST) {
        value = value * 10 + u64::from(c - b'0');
        to += 1;
    }
    (1..=MOST).contains(&(to - at)).then_some((value, to))
}

pub fn is_digit(c: u8) -> bool {
    c.is_ascii_digit()
}

/// Whether a character is part of a word: letters and digits of ASCII, and the two bytes that letters of
/// Latin alphabets have in UTF-8. Other scripts' signs part words.
pub fn is_word(c: u8) -> bool {
    c.is_ascii_alphanumeric() || (0xC3..=0xC9).contains(&c)
}

/// What a character can be, in bits.
static CLASSES: [u8; 256] = {
    let mut classes = [0; 256];
    let mut c = 0;
    while c < 128 {
        let character = c as u8;
        classes[c] = if character.is_ascii_digit() { DIGIT } else { 0 }
            | if character.is_ascii_hexdigit() { HEX } else { 0 }
            | if character.is_ascii_alphanumeric() { WORD } else { 0 };
        c += 1;
    }
    classes
};
pub const DIGIT: u8 = 1;
pub const HEX: u8 = 2;
const WORD: u8 = 4;

/// Letters and digits that stand together.
#[derive(Clone, Copy, Debug)]
pub struct Word {
    /// Where it ends.
    pub to: usize,
    /// What all of its characters are, and what some of them are: [`DIGIT`], [`HEX`].
    pub all: u8,
    pub any: u8,
}

/// The word that begins at `at`; it may be empty.
pub fn word(line: &[u8], at: usize) -> Word {
    let mut word = Word { to: at, all: u8::MAX, any: 0 };
    loop {
        let rest = line.get(word.to..).unwrap_or_default();
        let class = rest.first().map_or(0, |c| CLASSES[usize::from(*c)]);
        if class == 0 && !begins_word(rest) {
            return word;
        }
        word.to += if class == 0 { 2 } else { 1 };
        word.all &= class;
        word.any |= class;
    }
}

/// Whether a text begins with a letter or digit. One of Latin alphabets has two bytes, and may be cut.
pub fn begins_word(text: &[u8]) -> bool {
    match text {
        [0xC3..=0xC9, next, ..] => (0x80..0xC0).contains(next),
        [c, ..] => c.is_ascii_alphanumeric(),
        [] => false,
    }
}

/// The full-width digit or letter that begins `text`, as East Asian keyboards write it, in ASCII.
pub fn wide(text: &[u8]) -> Option<u8> {
    match text {
        [0xEF, 0xBC, low @ 0x81..0xC0, ..] => Some(low - 0x60),
        [0xEF, 0xBD, low @ 0x80..0x9F, ..] => Some(low - 0x20),
        _ => None,
    }
}

/// The value of each hex digit; of all other characters, more than 15.
pub static DIGITS: [u8; 256] = {
    let mut digits = [0xFF; 256];
    let mut at = 0;
    while at < 16 {
        digits[b"0123456789ABCDEF"[at] as usize] = at as u8;
        digits[b"0123456789abcdef"[at] as usize] = at as u8;
        at += 1;
    }
    digits
};

/// The value of up to two hex digits.
pub fn hex_value(digits: &[u8]) -> u8 {
    digits.iter().fold(0, |value, c| {
        value * 16 + if is_digit(*c) { c - b'0' } else { c.to_ascii_lowercase() - b'a' + 10 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_no_bytes() {
        for text in ["10110001", "0b00000000", "0B1011000110110001"] {
            assert!(is_bits(text.as_bytes()), "{text}");
        }
        for text in ["00000000", "1011000", "101100012", "0b1011", ""] {
            assert!(!is_bits(text.as_bytes()), "{text}");
        }
    }

    #[test]
    fn letters_that_fill_a_cell() {
        assert!(fills_cell(b"| 03 | BDCB |", 7, 11));
        assert!(!fills_cell(b"| 03 | bdcb |", 7, 11));
        assert!(!fills_cell(b"| 03 | BDCB 01 |", 7, 11));
        assert!(!fills_cell(b"| 03 BDCB |", 5, 9));
        assert!(!fills_cell(b"| 03 | BDCB", 7, 11));
    }
}

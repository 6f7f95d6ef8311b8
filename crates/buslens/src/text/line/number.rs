//! How bytes are written in a line: as hex and decimal numbers with and without a mark, in escapes and strings.

use super::Scan;
use super::run::{DECIMAL, Kind, Numbers, PLAIN, Style, marked};
use crate::field::Span;
use crate::text::characters::{
    DIGIT, DIGITS, HEX, Word, character, decimal_escape, digits, fills_cell, has_decimal_escapes, hex_value,
    is_bits, is_digit, separator, word,
};

/// What a token's digits are.
pub(super) enum Token {
    /// Bytes were added.
    Bytes(Kind),
    Word,
}

impl Scan {
    /// Adds the bytes that a word at `at` stands for.
    pub(super) fn token(&mut self, line: &[u8], at: usize, word: Word) -> Token {
        let to = word.to;
        let text = &line[at..to];
        if let [b'0', b'x' | b'X', ..] = text {
            return self.prefixed(line, at, to);
        }
        if word.all & HEX != 0 {
            return self.plain(line, at, word);
        }
        let [digits @ .., b'h' | b'H'] = text.strip_suffix(b"ex").unwrap_or(text) else { return Token::Word };
        let suffixed = digits.iter().all(u8::is_ascii_hexdigit)
            // "ach" is a word.
            && (digits.iter().any(|c| is_digit(*c)) || digits.iter().all(u8::is_ascii_uppercase));
        match (suffixed, digits) {
            (true, [_] | [_, _] | [b'0', _, _]) => {
                self.push_marked(hex_value(digits), at, to);
                Token::Bytes(marked(Style::Suffixed))
            }
            (true, [_, _, _, _]) => {
                self.push_marked(hex_value(&digits[..2]), at, at + 2);
                self.push_marked(hex_value(&digits[2..]), at + 2, to);
                Token::Bytes(marked(Style::Suffixed))
            }
            _ => Token::Word,
        }
    }

    /// Hex digits without a mark, which may be decimal: `01`, `0103`, `200`.
    fn plain(&mut self, line: &[u8], at: usize, Word { to, all, any }: Word) -> Token {
        let text = &line[at..to];
        let count = text.len();
        let letters = count > 2 && any & DIGIT == 0;
        let groups = || self.open().is_some_and(|run| run.style == Style::Contiguous);
        // Words such as "faced" are no bytes, and a row of bits is none either.
        let word = letters && !(count == 4 && (groups() || fills_cell(line, at, to)));
        if !self.in_row && (word || is_bits(text)) {
            return Token::Word;
        }
        let decimal = all & DIGIT != 0 && count <= 3 && !self.hex_only();
        let value = if decimal { text.iter().fold(0, |sum, c| sum * 10 + u32::from(c - b'0')) } else { 256 };
        let hex = (count == 1 || count.is_multiple_of(2)) && self.numbers != Some(Numbers::Decimal);
        match (hex, value < 256) {
            (false, false) => Token::Word,
            (false, true) => {
                self.push(0, value as u8, at, to);
                Token::Bytes(DECIMAL)
            }
            (true, decimal) if count <= 2 => {
                self.push(hex_value(text), value as u8, at, to);
                Token::Bytes(Kind { decimal, ..PLAIN })
            }
            (true, _) => {
                self.push_pairs(line, at, to);
                Token::Bytes(Kind { style: Style::Contiguous, ..PLAIN })
            }
        }
    }

    /// Adds the bytes of an even number of hex digits.
    pub(super) fn push_pairs(&mut self, line: &[u8], at: usize, to: usize) {
        let pairs = line[at..to].chunks_exact(2);
        self.hex.extend(pairs.map(|pair| DIGITS[usize::from(pair[0])] * 16 + DIGITS[usize::from(pair[1])]));
        if !self.hex_only() {
            self.decimal.resize(self.hex.len(), 0);
        }
        self.places.extend((at..to).step_by(2).map(|pair| Span::new(pair, pair + 2)));
    }

    /// `0x1`, `0x01`, `0x0103`, `0x010x03`, and with the suffix of an integer's type.
    fn prefixed(&mut self, line: &[u8], at: usize, to: usize) -> Token {
        let mut from = at;
        while let [b'0', b'x' | b'X', digits @ ..] = &line[from..to] {
            let mut count = digits.iter().take_while(|c| c.is_ascii_hexdigit()).count();
            // The zero before the next x is its own.
            if matches!(digits.get(count), Some(b'x' | b'X')) {
                count = count.saturating_sub(1);
            }
            if count == 0 || (count != 1 && !count.is_multiple_of(2)) {
                return Token::Word;
            }
            for pair in (0..count).step_by(2) {
                let place = if pair == 0 { from } else { from + 2 + pair };
                let end = from + 2 + (pair + 2).min(count);
                self.push_marked(hex_value(&line[from + 2 + pair..end]), place, end);
            }
            from += 2 + count;
        }
        match &line[from..to] {
            [] => Token::Bytes(marked(Style::Prefixed)),
            suffix @ [b'u' | b'U' | b'l' | b'L' | b'i', ..] if suffix.len() <= 3 => {
                Token::Bytes(marked(Style::Prefixed))
            }
            _ => Token::Word,
        }
    }

    /// `16#01`, as programs for controllers have it.
    pub(super) fn based(&mut self, line: &[u8], at: usize) -> usize {
        let from = at + 3;
        let to = word(line, from).to;
        let text = &line[from..to];
        if matches!(text.len(), 1 | 2) && text.iter().all(u8::is_ascii_hexdigit) {
            let first = self.hex.len();
            self.push_marked(hex_value(text), at, to);
            self.join(line, at, to, first, marked(Style::Prefixed));
        } else {
            self.stranger();
        }
        to
    }

    /// `&H01`, as Basic has it.
    pub(super) fn of_basic(&mut self, line: &[u8], at: usize) -> usize {
        let from = at + 2;
        let to = from + line[from..].iter().take_while(|c| c.is_ascii_hexdigit()).count();
        if !(1..=2).contains(&(to - from)) {
            return at + 1;
        }
        let first = self.hex.len();
        self.push_marked(hex_value(&line[from..to]), at, to);
        self.join(line, at, to, first, marked(Style::Prefixed));
        to
    }

    /// Whether a number below 0 begins at a minus, as some languages write bytes: `4, -40, 0`.
    pub(super) fn is_negative(line: &[u8], at: usize) -> bool {
        let apart = at.checked_sub(1).is_some_and(|before| matches!(line[before], b' ' | b',' | b'[' | b'{'));
        let number =
            digits(line, at + 1).filter(|(value, _)| (1..=128).contains(value) && line[at + 1] != b'0');
        let ends = |to: usize| line.get(to).is_none_or(|c| matches!(c, b' ' | b',' | b']' | b'}' | b';'));
        apart && number.is_some_and(|(_, to)| ends(to))
    }

    pub(super) fn negative(&mut self, line: &[u8], at: usize) -> usize {
        let Some((value, to)) = digits(line, at + 1) else { return at + 1 };
        let first = self.hex.len();
        self.push(0, (value as u8).wrapping_neg(), at, to);
        self.join(line, at, to, first, DECIMAL);
        to
    }

    /// Reads a row of octal numbers: bytes of three digits, and words of six with the low byte first.
    pub fn read_octal(&mut self, line: &[u8], from: usize) {
        self.clear();
        self.numbers = Some(Numbers::Hex);
        let mut at = from;
        while let rest @ [_, ..] = &line[at..] {
            let count = rest.iter().take_while(|c| (b'0'..=b'7').contains(*c)).count();
            let digits = &rest[..count];
            let value = digits.iter().take(6).fold(0_u32, |value, c| value * 8 + u32::from(c - b'0'));
            let first = self.hex.len();
            match (count, value) {
                (3, ..=0xFF) => self.push(value as u8, 0, at, at + 3),
                (6, ..=0xFFFF) => {
                    self.push(value as u8, 0, at + 3, at + 6);
                    self.push((value >> 8) as u8, 0, at, at + 3);
                }
                (0, _) => {}
                _ => return self.close(),
            }
            if count > 0 {
                self.join(line, at, at + count, first, PLAIN);
            }
            at += count.max(1);
        }
        self.close();
    }

    /// `\x01` or `\01` outside of quotes. Letters and digits right behind the former are characters, as in the
    /// `\x845` that Python prints for 84 35.
    pub(super) fn escape(&mut self, line: &[u8], at: usize) -> usize {
        /// So many characters without an escape are a text.
        const LONGEST: usize = 16;
        if let Some((byte, length)) = self.short_escape(line, at) {
            let first = self.hex.len();
            self.push_marked(byte, at, at + length);
            self.join(line, at, at + length, first, marked(Style::Escaped));
            return at + length;
        }
        // A string in brackets or none, whose numbers have three digits: `[A\003\000]`.
        let three = |at: usize| {
            line.get(at..at + 4).is_some_and(|it| it[0] == b'\\' && it[1..].iter().all(u8::is_ascii_digit))
        };
        if three(at) && three(at + 4) {
            let ends =
                |c: &u8| c.is_ascii_whitespace() || matches!(c, b'[' | b']' | b'(' | b')' | b'"' | b'\'');
            let from = line[..at].iter().rposition(ends).map_or(0, |before| before + 1);
            let to = at + line[at..].iter().position(ends).unwrap_or(line.len() - at);
            self.close();
            while let Some(run) = self.runs.pop_if(|run| run.span.from >= from) {
                self.forget(run.first);
            }
            self.string(line, Span::new(from, to), Span::new(from, to));
            self.close();
            return to;
        }
        let hex = |at: usize| match line.get(at..at + 4) {
            Some([b'\\', b'x' | b'X', digits @ ..]) if digits.iter().all(u8::is_ascii_hexdigit) => {
                Some(hex_value(digits))
            }
            _ => None,
        };
        let Some(byte) = hex(at) else { return at + 1 };
        let first = self.hex.len();
        self.push_marked(byte, at, at + 4);
        let mut to = at + 4;
        let plain = |c: &u8| c.is_ascii_alphanumeric();
        // Signs that part no bytes are characters, too, where the next escape comes right behind: `\x01%\xA3`.
        let sign = |c: &u8| {
            c.is_ascii_graphic()
                && !matches!(c, b'\\' | b'"' | b'\'' | b'`' | b',' | b';' | b':' | b'|' | b'-' | b'/')
        };
        let behind = line[to..].iter().take(LONGEST).take_while(|c| plain(c) || sign(c)).count();
        let glued = hex(to + behind).is_some();
        while let Some(c) = line.get(to).copied().filter(|c| plain(c) || (glued && sign(c))) {
            self.push_marked(c, to, to + 1);
            to += 1;
        }
        self.join(line, at, to, first, marked(Style::Escaped));
        to
    }

    /// The byte of `\01`, or of the `\n` right behind such, and how long that is.
    fn short_escape(&self, line: &[u8], at: usize) -> Option<(u8, usize)> {
        let goes_on = self.open().is_some_and(|run| run.style == Style::Escaped && run.span.to == at);
        let ends = |to: usize| line.get(to).is_none_or(|c| *c == b'\\' || c.is_ascii_whitespace());
        match line.get(at + 1..)? {
            [a, b, ..] if a.is_ascii_hexdigit() && b.is_ascii_hexdigit() && ends(at + 3) => {
                Some((hex_value(&[*a, *b]), 3))
            }
            [b'n' | b'r' | b't', ..] if goes_on && ends(at + 2) => Some((character(&line[at..]).0, 2)),
            _ => None,
        }
    }

    /// A string with escapes in it is bytes, each character one: `b'\x01\x03E'`.
    pub(super) fn quoted(&mut self, line: &[u8], at: usize) -> usize {
        /// What can follow a backslash, but in a path of Windows.
        const ESCAPES: &[u8] = b"xX0123456789tnrabvfeu\\\"'";
        let quote = line[at];
        let [single, double] = &mut self.unclosed;
        let unclosed = match quote {
            b'"' => double,
            _ => single,
        };
        if *unclosed {
            return at + 1;
        }
        let mut to = at + 1;
        let (mut escaped, mut path) = (false, false);
        while to < line.len() && line[to] != quote {
            // A character that no byte stands for, such as Ā: it is text.
            path |= line[to] >= 0xC4 && line.get(to + 1).is_some_and(|next| (0x80..0xC0).contains(next));
            if line[to] == b'\\' {
                let next = line.get(to + 1).copied().unwrap_or_default();
                let control = |digits: &[u8]| matches!(digits, [b'0', b'0', b'0' | b'1', ..]);
                // Line ends and tabs are of texts, too.
                escaped |=
                    matches!(next, b'x' | b'X' | b'0'..=b'9') || (next == b'u' && control(&line[to + 2..]));
                path |= !ESCAPES.contains(&next);
                to += 1;
            }
            to += 1;
        }
        *unclosed = to >= line.len();
        if !escaped || path || to >= line.len() {
            return at + 1;
        }
        self.close();
        self.string(line, Span::new(at + 1, to), Span::new(at, to + 1));
        self.close();
        to + 1
    }

    /// Adds the bytes that the characters of a string stand for.
    fn string(&mut self, line: &[u8], Span { mut from, to }: Span, whole: Span) {
        let first = self.hex.len();
        // What its numbers are, the bytes tell, where they can be octal and decimal.
        let decimal_only = has_decimal_escapes(&line[from..to]);
        let (mut fits, mut differs) = (true, false);
        while from < to {
            let rest = &line[from..to];
            let (mut byte, mut length) = character(rest);
            let mut decimal = byte;
            if let Some((number, digits)) = decimal_escape(rest) {
                (fits, decimal) = (fits && number < 256 && digits == length, number as u8);
                if decimal_only {
                    (byte, length) = (decimal, digits);
                }
            }
            differs |= decimal != byte;
            self.push(byte, decimal, from, from + length);
            from += length;
        }
        let kind = Kind { decimal: fits && differs, ..marked(Style::Escaped) };
        self.join(line, whole.from, whole.to, first, kind);
    }

    /// A word within bytes that is nearly one: a slip of typing, or bytes into whose line another program
    /// wrote (`00MQTT is up`). Returns where it ends.
    pub(super) fn slip(&mut self, line: &[u8], at: usize, to: usize) -> Option<usize> {
        if !self.is_open && self.words > 0 {
            return None;
        }
        let text = &line[at..to];
        let hex = text.iter().filter(|c| c.is_ascii_hexdigit()).count();
        let blank = self.open().is_none_or(|run| separator(&line[run.span.to..at]) == Some(b' '));
        let typing = hex == text.len() && hex > 2 && self.words == 0 && self.time.is_none() && blank;
        // Of a long number of which little is wrong, the good pairs are read.
        let nearly = text.len() >= 6
            && (text.len() - hex) * 4 < text.len()
            && (1..=2).contains(&(text.len() - hex))
            && self.words == 0;
        if (typing || nearly) && is_digit(text[0]) && !is_bits(text) {
            let first = self.hex.len();
            for pair in (at..to).step_by(2) {
                let end = (pair + 2).min(to);
                if end - pair == 2 && line[pair..end].iter().all(u8::is_ascii_hexdigit) {
                    self.push(hex_value(&line[pair..end]), 0, pair, end);
                }
            }
            self.slips += 1;
            self.join(line, at, to, first, Kind { style: Style::Contiguous, ..PLAIN });
            return Some(to);
        }
        let run = self.open_mut().filter(|run| run.hex && !run.marked)?;
        let separated = blank && run.style == Style::Separated;
        let typed = match text {
            [_] => !is_digit(text[0]) && !matches!(text[0], b'x' | b'X'),
            [a, b] => hex == 1 && (is_digit(*a) || matches!(a, b'O' | b'o' | b'l' | b'I') || is_digit(*b)),
            _ => false,
        };
        if separated && typed && run.tokens > 1 {
            run.pause(to);
            self.slips += 1;
            return Some(to);
        }
        let [a, b, behind, ..] = text else { return None };
        let glued = a.is_ascii_hexdigit()
            && b.is_ascii_hexdigit()
            && behind.is_ascii_uppercase()
            && !behind.is_ascii_hexdigit();
        if separated && glued && run.tokens > 2 && run.padded && (is_digit(*a) || is_digit(*b)) {
            let first = self.hex.len();
            self.push(hex_value(&text[..2]), 0, at, at + 2);
            self.join(line, at, at + 2, first, PLAIN);
            self.close();
            return Some(at + 2);
        }
        None
    }
}

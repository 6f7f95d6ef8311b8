//! Hex as people paste it: `01 03`, `0103`, `01,03`, `0x01 0x03`, `\x01\x03`, `01h 03h`, `[01][03]`,
//! `<01><03>`, `01.03`, `01-03`, `01:03`, and the arrays of C, Python, Rust and their kin.
//!
//! A line is a telegram, and so is an array over several lines. What cannot be read is marked where
//! it stands; the rest of the line is read all the same. Everything takes linear time.

use crate::field::{Argument, Message, Severity, Span};
use crate::message;

/// All lines that hold bytes, or should.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    pub lines: Vec<Line>,
    /// How most bytes were written; `None` where there are none.
    pub style: Option<Style>,
}

/// The bytes of one telegram in the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Counted from 1.
    pub number: usize,
    /// The line in the text, without its end.
    pub span: Span,
    pub bytes: Vec<u8>,
    /// Where each of `bytes` stands in the text.
    pub places: Vec<Span>,
    pub remarks: Vec<Remark>,
    /// The bytes are hex digits behind a colon, without anything between: `:0103…`.
    pub colon: bool,
}

/// Something in the text that is not as it should be, or was read in a way worth telling.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Stable kebab-case word.
    pub code: &'static str,
    pub severity: Severity,
    pub message: Message,
    /// Its place in the text.
    pub span: Span,
}

/// How bytes are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// `01 03`, with any separator.
    Separated,
    /// `0103`.
    Contiguous,
    /// `0x01`, `$01`.
    Prefixed,
    /// `01h`.
    Suffixed,
    /// `\x01`.
    Escaped,
}

impl Style {
    const ALL: [Self; 5] = [Self::Separated, Self::Contiguous, Self::Prefixed, Self::Suffixed, Self::Escaped];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Separated => "separate hex bytes",
            Self::Contiguous => "hex digits without spaces",
            Self::Prefixed => "hex numbers with a prefix",
            Self::Suffixed => "hex bytes with an h",
            Self::Escaped => "an escaped string",
        }
    }
}

/// Reads the bytes of `text`, a telegram for each line.
pub fn read(text: &str) -> Reading {
    let mut lines = Vec::new();
    let mut styles = [0; Style::ALL.len()];
    let mut physical = physical_lines(text).enumerate();
    while let Some((index, mut span)) = physical.next() {
        let mut open = Brackets::default();
        let mut letters = letters(text, span);
        open.count(&letters);
        while open.continues() {
            let Some((_, next)) = physical.next() else { break };
            let more = self::letters(text, next);
            open.count(&more);
            // The line end parts what stands before and after it.
            letters.push(Letter { at: span.to, c: '\n' });
            letters.extend(more);
            span.to = next.to;
        }
        let mut scan = Scan {
            letters,
            end: span.to,
            line: Line { number: index + 1, span, ..Line::default() },
            lone: Vec::new(),
            styles: &mut styles,
        };
        scan.run();
        if open.continues() {
            scan.remark(
                "bracket-open",
                Severity::Warning,
                span,
                message!("a bracket opened here is not closed"),
            );
        }
        if !scan.line.bytes.is_empty() || !scan.line.remarks.is_empty() {
            lines.push(scan.line);
        }
    }
    let most =
        Style::ALL.into_iter().zip(styles).filter(|(_, count)| *count > 0).max_by_key(|(_, count)| *count);
    Reading { lines, style: most.map(|(style, _)| style) }
}

/// The lines of `text` without their ends: `\n`, `\r\n` or `\r`.
fn physical_lines(text: &str) -> impl Iterator<Item = Span> {
    let mut from = 0;
    std::iter::from_fn(move || {
        if from > text.len() {
            return None;
        }
        let rest = &text.as_bytes()[from..];
        let length = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
        let end = if rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
        let span = Span::new(from, from + length);
        from += length + end;
        Some(span)
    })
}

/// A character of the line and its place in the text.
#[derive(Clone, Copy, Debug)]
struct Letter {
    at: usize,
    c: char,
}

fn letters(text: &str, span: Span) -> Vec<Letter> {
    text[span.from..span.to].char_indices().map(|(at, c)| Letter { at: span.from + at, c: fold(c) }).collect()
}

/// The plain character for one that word processors, web pages and East Asian keyboards put in its
/// place.
fn fold(c: char) -> char {
    match c {
        // Full-width forms of the printable ASCII characters.
        '\u{FF01}'..='\u{FF5E}' => char::from_u32(c as u32 - 0xFEE0).unwrap_or(c),
        '\u{A0}' | '\u{2000}'..='\u{200D}' | '\u{2028}' | '\u{202F}' | '\u{3000}' | '\u{FEFF}' => ' ',
        '\u{2010}'..='\u{2015}' | '\u{2212}' => '-',
        '\u{2018}' | '\u{2019}' => '\'',
        '\u{201C}' | '\u{201D}' => '"',
        '\u{3001}' => ',',
        _ => c,
    }
}

/// Whether an array goes on in the next line.
#[derive(Default)]
struct Brackets {
    depth: i32,
    /// An `=` before the bracket, or a bracket at the end of the line, makes it an array.
    array: bool,
}

impl Brackets {
    fn count(&mut self, letters: &[Letter]) {
        let mut last = ' ';
        let mut assigned = false;
        let mut digits = false;
        for (index, letter) in letters.iter().enumerate() {
            if comment_length(&letters[index..]).is_some_and(|length| index + length == letters.len()) {
                break;
            }
            match letter.c {
                '=' => assigned = true,
                c if c.is_ascii_digit() => digits = true,
                '{' | '[' | '(' => {
                    self.depth += 1;
                    self.array |= assigned;
                }
                '}' | ']' | ')' => self.depth -= 1,
                _ => {}
            }
            if !letter.c.is_whitespace() {
                last = letter.c;
            }
        }
        // Behind bytes, a bracket at the end of a line opens nothing: `RX 01 03 [`.
        self.array |= matches!(last, '{' | '[' | '(') && !digits;
    }

    fn continues(&self) -> bool {
        self.array && self.depth > 0
    }
}

/// How many letters a comment that begins here has.
fn comment_length(letters: &[Letter]) -> Option<usize> {
    let c = |index: usize| letters.get(index).map(|letter| letter.c);
    let line_end = || letters.iter().position(|letter| letter.c == '\n').unwrap_or(letters.len());
    match (c(0)?, c(1)) {
        ('/', Some('/')) => Some(line_end()),
        ('#', next) if !next.is_some_and(|c| c.is_ascii_hexdigit()) => Some(line_end()),
        ('/', Some('*')) => {
            let end = letters.windows(2).skip(2).position(|pair| pair[0].c == '*' && pair[1].c == '/');
            Some(end.map_or(letters.len(), |end| end + 4))
        }
        _ => None,
    }
}

struct Scan<'a> {
    letters: Vec<Letter>,
    /// Where the line ends in the text.
    end: usize,
    line: Line,
    /// Which bytes were written with a single digit.
    lone: Vec<usize>,
    styles: &'a mut [usize; Style::ALL.len()],
}

impl Scan<'_> {
    fn run(&mut self) {
        let mut at = self.after_declaration();
        self.line.colon = self.is_behind_colon(at);
        let in_code = at > 0;
        while at < self.letters.len() {
            if let Some(length) = comment_length(&self.letters[at..]) {
                at += length;
                continue;
            }
            let c = self.letters[at].c;
            at = match c {
                '"' | '\'' => self.quoted(at),
                '\\' if self.hex_escape(at).is_some() => self.escapes(at),
                // Prefixes of other languages: $01 (Pascal), #01 and %01 (web), &H01 (Basic).
                '$' | '#' | '%' if self.is_hex(at + 1) => at + 1,
                '&' if matches!(self.c(at + 1), Some('H' | 'h')) && self.is_hex(at + 2) => at + 2,
                _ if is_separator(c) => at + 1,
                _ => self.word(at, in_code),
            };
        }
        self.settle_lone_digits();
    }

    /// Whether from `at` on there is nothing but a colon and at least three bytes in one run.
    fn is_behind_colon(&self, at: usize) -> bool {
        let letters = self.letters[at..].iter().map(|letter| letter.c);
        let mut rest = letters.skip_while(|c| c.is_whitespace()).peekable();
        let colon = rest.next() == Some(':');
        let digits = std::iter::from_fn(|| rest.next_if(char::is_ascii_hexdigit)).count();
        colon && digits >= 6 && rest.all(char::is_whitespace)
    }

    fn c(&self, at: usize) -> Option<char> {
        self.letters.get(at).map(|letter| letter.c)
    }

    fn is_hex(&self, at: usize) -> bool {
        self.c(at).is_some_and(|c| c.is_ascii_hexdigit())
    }

    /// The text's span of the letters `from` to `to`.
    fn span(&self, from: usize, to: usize) -> Span {
        let place = |index: usize| self.letters.get(index).map_or(self.end, |letter| letter.at);
        Span::new(place(from), place(to))
    }

    fn text(&self, from: usize, to: usize) -> String {
        self.letters[from..to].iter().map(|letter| letter.c).collect()
    }

    fn push(&mut self, byte: u8, from: usize, to: usize, style: Style) {
        let place = self.span(from, to);
        self.line.bytes.push(byte);
        self.line.places.push(place);
        self.styles[style as usize] += 1;
    }

    fn remark(&mut self, code: &'static str, severity: Severity, span: Span, message: Message) {
        self.line.remarks.push(Remark { code, severity, message, span });
    }

    fn not_hex(&mut self, from: usize, to: usize) {
        let text = self.text(from, to);
        let message = match text.as_str() {
            "O" | "o" => message!("this is the letter O, not a zero: hex digits are 0 to 9 and A to F"),
            "l" | "I" => message!("this is a letter, not a one: hex digits are 0 to 9 and A to F"),
            _ if to - from == 1 => {
                message!("“{text}” is not a hex digit: 0 to 9 and A to F are", text = text)
            }
            _ => {
                message!("“{text}” is not hex: expected bytes of two digits, 0 to 9 and A to F", text = text)
            }
        };
        self.remark("not-hex", Severity::Error, self.span(from, to), message);
    }

    /// Where the bytes begin: after the `=` of `uint8_t frame[8] = {…`, `let frame = [`, `TX=…`.
    fn after_declaration(&self) -> usize {
        let Some(equals) = self.letters.iter().position(|letter| letter.c == '=') else { return 0 };
        let declared = &self.letters[..equals];
        let names = declared.iter().any(|letter| is_letter(letter.c) && !letter.c.is_ascii_hexdigit());
        let mut value =
            self.letters[equals + 1..].iter().map(|letter| letter.c).skip_while(|c| c.is_whitespace());
        let opens = value.next().is_some_and(|c| matches!(c, '{' | '[' | '(' | '"' | '\'' | '&'));
        if names || opens { equals + 1 } else { 0 }
    }

    /// A quoted string: with escapes in it, each character is a byte; otherwise it holds hex, and
    /// only the quote is passed.
    fn quoted(&mut self, at: usize) -> usize {
        let quote = self.letters[at].c;
        let mut end = at + 1;
        let mut escaped = false;
        while let Some(c) = self.c(end).filter(|c| *c != quote) {
            escaped |= c == '\\';
            end += if c == '\\' { 2 } else { 1 };
        }
        let end = end.min(self.letters.len());
        if !escaped {
            return at + 1;
        }
        let mut inside = at + 1;
        while inside < end {
            inside = self.character(inside, end);
        }
        end + 1
    }

    /// One character of a string, or its escape.
    fn character(&mut self, at: usize, end: usize) -> usize {
        let c = self.letters[at].c;
        if c != '\\' {
            match u8::try_from(c) {
                Ok(byte) if c != '\n' => self.push(byte, at, at + 1, Style::Escaped),
                Ok(_) => {}
                Err(_) => self.not_hex(at, at + 1),
            }
            return at + 1;
        }
        if let Some(byte) = self.hex_escape(at) {
            self.push(byte, at, at + 4, Style::Escaped);
            return at + 4;
        }
        let octal = (at + 1..end.min(at + 4)).take_while(|at| matches!(self.c(*at), Some('0'..='7'))).count();
        if octal > 0 {
            let value = u32::from_str_radix(&self.text(at + 1, at + 1 + octal), 8).unwrap_or(u32::MAX);
            match u8::try_from(value) {
                Ok(byte) => self.push(byte, at, at + 1 + octal, Style::Escaped),
                Err(_) => self.not_hex(at, at + 1 + octal),
            }
            return at + 1 + octal;
        }
        let byte = match self.c(at + 1) {
            Some('n') => b'\n',
            Some('r') => b'\r',
            Some('t') => b'\t',
            Some('a') => 7,
            Some('b') => 8,
            Some('v') => 11,
            Some('f') => 12,
            Some('\n') | None => return at + 2,
            Some(c @ ('\\' | '"' | '\'')) => c as u8,
            Some(_) => {
                self.not_hex(at, at + 2);
                return at + 2;
            }
        };
        self.push(byte, at, at + 2, Style::Escaped);
        at + 2
    }

    /// The byte of `\x01` at `at`.
    fn hex_escape(&self, at: usize) -> Option<u8> {
        let marked = self.c(at) == Some('\\') && matches!(self.c(at + 1), Some('x' | 'X'));
        let digit = |at: usize| self.c(at).and_then(|c| c.to_digit(16));
        (marked).then(|| Some((digit(at + 2)? << 4 | digit(at + 3)?) as u8)).flatten()
    }

    /// Escapes without quotes; letters and digits right behind one are characters, as in the
    /// `\x845` that Python prints for 84 35.
    fn escapes(&mut self, at: usize) -> usize {
        let mut at = self.character(at, self.letters.len());
        while self.c(at).is_some_and(|c| c.is_ascii_alphanumeric()) {
            at = self.character(at, self.letters.len());
        }
        at
    }

    /// A run of letters and digits.
    fn word(&mut self, from: usize, in_code: bool) -> usize {
        let mut to = from + 1;
        while self.c(to).is_some_and(|c| !is_separator(c) && !matches!(c, '$' | '#' | '%')) {
            to += 1;
        }
        let hex = |scan: &Self, from: usize, to: usize| (from..to).all(|at| scan.is_hex(at));
        if self.is_prefix(from) {
            self.prefixed(from, to);
        } else if self.is_code(from, to, in_code) {
            // bytes.fromhex(…), vec![…], b"…": the wrapping of an array, not its content.
        } else if hex(self, from, to) {
            self.digits(from, to);
        } else if matches!(self.c(to - 1), Some('h' | 'H')) && to - from > 1 && hex(self, from, to - 1) {
            self.number(from, from, to - 1, Style::Suffixed);
        } else {
            self.unreadable(from, to);
        }
        to
    }

    fn is_prefix(&self, at: usize) -> bool {
        self.c(at) == Some('0') && matches!(self.c(at + 1), Some('x' | 'X'))
    }

    /// Whether a word belongs to the code around an array.
    fn is_code(&self, from: usize, to: usize, in_code: bool) -> bool {
        let plain = (from..to).all(|at| self.is_hex(at));
        let opens = |at: usize| matches!(self.c(at), Some('(' | '[' | '{' | '"' | '\''));
        let goes_on = |at: usize| self.c(at).is_some_and(is_letter);
        // Behind digits, a bracket or quote closes or parts bytes: [01][03], "0103".
        let named = self.c(from).is_some_and(is_letter);
        let calls = opens(to)
            || (self.c(to) == Some('!') && opens(to + 1))
            || (self.c(to - 1) == Some('!') && opens(to))
            || (self.c(to) == Some('.') && goes_on(to + 1))
            || (self.c(to) == Some(':') && self.c(to + 1) == Some(':'));
        let odd_mark = to - from == 1 && matches!(self.c(to), Some('"' | '\''));
        named && ((!plain && (calls || in_code)) || (plain && odd_mark))
    }

    /// `0x01`, `0x0103`, `0x010x03`, with the suffix of an integer's type.
    fn prefixed(&mut self, from: usize, to: usize) {
        let mut at = from;
        while at < to && self.is_prefix(at) {
            let digits = at + 2;
            let mut end = digits;
            while end < to && self.is_hex(end) && !(end > digits && self.is_prefix(end)) {
                end += 1;
            }
            self.number(at, digits, end, Style::Prefixed);
            at = end;
        }
        let suffix = self.text(at, to).to_ascii_lowercase();
        if at < to && !matches!(suffix.as_str(), "u" | "l" | "ul" | "u8" | "u16" | "u32" | "i32" | "uy") {
            self.not_hex(at, to);
        }
    }

    /// The digits `first..to` of a number that begins at `from`, high byte first.
    fn number(&mut self, from: usize, first: usize, to: usize, style: Style) {
        let count = to - first;
        if count == 0 {
            let message = message!("hex digits are missing after “{prefix}”", prefix = self.text(from, to));
            self.remark("digit-missing", Severity::Error, self.span(from, to), message);
            return;
        }
        // Assemblers want a zero before a letter: 0C8h is one byte.
        let padded = style == Style::Suffixed && count == 3 && self.c(first) == Some('0');
        let mut at = if padded { first + 1 } else { first };
        if (to - at) % 2 == 1 {
            self.pair(from, at, at + 1, style);
            at += 1;
        }
        while at < to {
            // The prefix is shown as part of the first byte.
            let start = if at == first { from } else { at };
            self.pair(start, at, at + 2, style);
            at += 2;
        }
    }

    /// Plain digits: two for each byte.
    fn digits(&mut self, from: usize, to: usize) {
        let style = if to - from > 2 { Style::Contiguous } else { Style::Separated };
        if to - from == 1 {
            self.lone.push(self.line.bytes.len());
        }
        let even = if to - from == 1 { to } else { to - (to - from) % 2 };
        for at in (from..even).step_by(2) {
            self.pair(at, at, (at + 2).min(to), style);
        }
        if even < to {
            let message = message!("{n} digits: one is left over, since a byte has two", n = to - from);
            self.remark("odd-digits", Severity::Error, self.span(even, to), message);
        }
    }

    /// The byte of the digits `from..to`, one or two, shown from `start` on.
    fn pair(&mut self, start: usize, from: usize, to: usize, style: Style) {
        let digits = self.letters[from..to].iter().filter_map(|letter| letter.c.to_digit(16));
        let byte = digits.fold(0, |byte, digit| byte << 4 | digit);
        self.push(byte as u8, start, to, style);
    }

    /// A word with something in it that is no hex digit: its good pairs are read, or, where little
    /// of it is hex, it is passed as a whole.
    fn unreadable(&mut self, from: usize, to: usize) {
        let bad = (from..to).filter(|at| !self.is_hex(*at)).count();
        if to - from > 2 && bad * 2 >= to - from {
            self.not_hex(from, to);
            return;
        }
        for at in (from..to).step_by(2) {
            let end = (at + 2).min(to);
            match (at..end).find(|at| !self.is_hex(*at)) {
                Some(bad) if bad + 1 < end && !self.is_hex(bad + 1) => self.not_hex(bad, end),
                Some(bad) => self.not_hex(bad, bad + 1),
                None => self.digits(at, end),
            }
        }
    }

    /// Single digits are bytes where a line has several of them; one at the end is being typed.
    fn settle_lone_digits(&mut self) {
        let Some(first) = self.lone.first().copied() else { return };
        let place = self.line.places[first];
        if self.lone.len() == 1 && first + 1 == self.line.bytes.len() {
            self.line.bytes.pop();
            self.line.places.pop();
            self.styles[Style::Separated as usize] -= 1;
            let message = message!("one digit: a byte has two, a second one is missing");
            self.remark("digit-missing", Severity::Error, place, message);
        } else {
            let byte = Argument::Text(format!("{:02X}", self.line.bytes[first]));
            let message = message!("single digits are read as bytes: this one as {byte}", byte = byte);
            self.remark("single-digit", Severity::Warning, place, message);
        }
    }
}

/// Whether `c` can begin a word. The tables of all letters would be kilobytes of the page.
fn is_letter(c: char) -> bool {
    c.is_ascii_alphabetic() || !c.is_ascii()
}

/// Whether `c` can stand between bytes.
fn is_separator(c: char) -> bool {
    c.is_whitespace()
        || matches!(
            c,
            ',' | ';'
                | ':'
                | '.'
                | '-'
                | '_'
                | '|'
                | '/'
                | '('
                | ')'
                | '['
                | ']'
                | '{'
                | '}'
                | '<'
                | '>'
                | '='
                | '+'
                | '*'
                | '&'
                | '\\'
                | '`'
                | '~'
                | '^'
                | '"'
                | '\''
        )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::hex;

    const TELEGRAM: &str = "01 03 00 C8 00 03 84 35";

    /// The bytes of the only line, which must be free of remarks.
    fn clean(text: &str) -> String {
        let reading = read(text);
        let [line] = reading.lines.as_slice() else { panic!("{text:?}: {} lines", reading.lines.len()) };
        assert_eq!(line.remarks, [], "{text:?}");
        hex(&line.bytes)
    }

    /// The bytes of the only line, and each remark's code with the text it marks.
    fn marked(text: &str) -> (String, Vec<(&'static str, &str)>) {
        let reading = read(text);
        let [line] = reading.lines.as_slice() else { panic!("{text:?}: {} lines", reading.lines.len()) };
        let remarks = line.remarks.iter().map(|r| (r.code, &text[r.span.from..r.span.to])).collect();
        (hex(&line.bytes), remarks)
    }

    #[test]
    fn separators() {
        for text in [
            "01 03 00 C8 00 03 84 35",
            "  01  03 00 c8 00 03 84 35  ",
            "010300C800038435",
            "0103 00c8 0003 8435",
            "01,03,00,C8,00,03,84,35",
            "01, 03, 00, C8, 00, 03, 84, 35,",
            "01;03;00;C8;00;03;84;35",
            "01\t03\t00\tC8\t00\t03\t84\t35",
            "01.03.00.C8.00.03.84.35",
            "01-03-00-C8-00-03-84-35",
            "01:03:00:C8:00:03:84:35",
            "01_03_00_C8_00_03_84_35",
            "01|03|00|C8|00|03|84|35",
            "[01][03][00][C8][00][03][84][35]",
            "<01><03><00><C8><00><03><84><35>",
            "<01 03 00 C8 00 03 84 35>",
            "\"01 03 00 C8 00 03 84 35\"",
            "01\u{A0}03\u{A0}00\u{A0}C8\u{2009}00\u{3000}03 84 35",
            "０１ ０３ ００ Ｃ８ ００ ０３ ８４ ３５",
            "01\u{2013}03\u{2013}00\u{2013}C8\u{2013}00\u{2013}03\u{2013}84\u{2013}35",
        ] {
            assert_eq!(clean(text), TELEGRAM, "{text}");
        }
    }

    #[test]
    fn a_bracket_behind_bytes_does_not_take_the_next_lines() {
        for text in ["RX[8] 01 03 [\n01 03 00", "7e:0a[\n01 03 00"] {
            assert_eq!(read(text).lines.len(), 2, "{text}");
        }
        assert_eq!(read("frame = [\n01 03\n]").lines.len(), 1);
        assert_eq!(read("vec![\n0x01, 0x03\n]").lines.len(), 1);
    }

    #[test]
    fn a_colon_before_a_run_of_digits_is_told() {
        for (text, colon) in [
            (":010300C80003", true),
            ("  :010300c80003\r\n", true),
            ("01:03:00", false),
            (":01", false),
            (":01 03 00 C8", false),
            (":0103G0", false),
            (":010300G", false),
        ] {
            assert_eq!(read(text).lines[0].colon, colon, "{text}");
        }
    }

    #[test]
    fn prefixes_suffixes_and_escapes() {
        for text in [
            "0x01 0x03 0x00 0xC8 0x00 0x03 0x84 0x35",
            "0X01,0X03,0X00,0XC8,0X00,0X03,0X84,0X35",
            "0x010x030x000xC80x000x030x840x35",
            "0x010300C800038435",
            "0x0103 0x00C8 0x0003 0x8435",
            "0x1 0x3 0x0 0xC8 0x0 0x3 0x84 0x35",
            "01h 03h 00h C8h 00h 03h 84h 35h",
            "01H, 03H, 00H, 0C8H, 00H, 03H, 84H, 35H",
            "0103h 00C8h 0003h 8435h",
            "$01 $03 $00 $C8 $00 $03 $84 $35",
            "%01%03%00%C8%00%03%84%35",
            "&H01 &H03 &H00 &HC8 &H00 &H03 &H84 &H35",
            r"\x01\x03\x00\xC8\x00\x03\x84\x35",
            r"\x01\x03\x00\xc8\x00\x03\x845",
            r#""\x01\x03\x00\xc8\x00\x03\x845""#,
            r#"b'\x01\x03\x00\xc8\x00\x03\x845'"#,
            r#"b"\x01\x03\0\xc8\x00\x03\x84\x35""#,
            r"'\001\003\000\310\000\003\2045'",
        ] {
            assert_eq!(clean(text), TELEGRAM, "{text}");
        }
    }

    #[test]
    fn arrays_of_programming_languages() {
        for text in [
            "{0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35}",
            "uint8_t request[8] = {0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35};",
            "const unsigned char abc[] = { 0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35 }; // read",
            "frame = bytes([0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35])",
            "bytearray([0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35])",
            "bytes.fromhex(\"01 03 00 C8 00 03 84 35\")",
            "data = b'\\x01\\x03\\x00\\xc8\\x00\\x03\\x845'",
            "let frame: [u8; 8] = [0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35];",
            "let frame = vec![0x01u8, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35];",
            "vec![0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35]",
            "&[0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35]",
            "byte[] a = new byte[] { 0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35 };",
            "Buffer.from([0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35])",
            "TX=01 03 00 C8 00 03 84 35",
            "uint8_t request[] = {\n    0x01, 0x03, // unit, function\n    0x00, 0xC8,\n    0x00, 0x03, /* crc */ 0x84, 0x35\n};",
            "[\r\n  0x01, 0x03, 0x00, 0xC8,\r\n  0x00, 0x03, 0x84, 0x35\r\n]",
        ] {
            assert_eq!(clean(text), TELEGRAM, "{text}");
        }
    }

    #[test]
    fn a_telegram_a_line() {
        let reading = read("01 03\n\n# a comment\n05 06\r\n07");
        let lines: Vec<_> = reading.lines.iter().map(|line| (line.number, hex(&line.bytes))).collect();
        assert_eq!(lines, [(1, "01 03".into()), (4, "05 06".into()), (5, "07".into())]);
        let reading = read("a = [0x01,\n0x02]\nb = [0x03]");
        let lines: Vec<_> = reading.lines.iter().map(|line| (line.number, hex(&line.bytes))).collect();
        assert_eq!(lines, [(1, "01 02".into()), (3, "03".into())]);
    }

    #[test]
    fn each_byte_knows_its_place() {
        let text = "é 0x01 03h [C8]";
        let line = &read(text).lines[0];
        let places: Vec<_> = line.places.iter().map(|place| &text[place.from..place.to]).collect();
        assert_eq!(places, ["0x01", "03", "C8"]);
    }

    #[test]
    fn a_bad_character_is_marked_and_the_rest_is_read() {
        assert_eq!(marked("01 0G C8"), ("01 C8".into(), vec![("not-hex", "G")]));
        assert_eq!(marked("01 O3 C8"), ("01 C8".into(), vec![("not-hex", "O")]));
        assert_eq!(marked("0103G0C8"), ("01 03 C8".into(), vec![("not-hex", "G")]));
        assert_eq!(marked("Tx 01 03"), ("01 03".into(), vec![("not-hex", "Tx")]));
        assert_eq!(marked("01 送信 03"), ("01 03".into(), vec![("not-hex", "送信")]));
        assert_eq!(marked("01 03 ?"), ("01 03".into(), vec![("not-hex", "?")]));
        assert_eq!(marked("hello"), (String::new(), vec![("not-hex", "hello")]));
        assert_eq!(
            marked("0x01 0xZZ 03"),
            ("01 03".into(), vec![("digit-missing", "0x"), ("not-hex", "ZZ")])
        );
    }

    #[test]
    fn odd_digits() {
        assert_eq!(marked("01 03 0"), ("01 03".into(), vec![("digit-missing", "0")]));
        assert_eq!(marked("01 030 C8"), ("01 03 C8".into(), vec![("odd-digits", "0")]));
        assert_eq!(marked("01030"), ("01 03".into(), vec![("odd-digits", "0")]));
        assert_eq!(marked("1 3 0 C8"), ("01 03 00 C8".into(), vec![("single-digit", "1")]));
        assert_eq!(marked("1"), (String::new(), vec![("digit-missing", "1")]));
        assert_eq!(marked("01 0x"), ("01".into(), vec![("digit-missing", "0x")]));
    }

    #[test]
    fn nothing_is_fine() {
        for text in ["", " ", "\n\n", "\t\r\n", "[]", "// nothing", "{};", "\"\"", "\\"] {
            assert_eq!(read(text).lines, [], "{text:?}");
        }
        assert_eq!(read("").style, None);
    }

    #[test]
    fn an_open_bracket_is_said() {
        assert_eq!(marked("a = {0x01,\n0x03\n").1, [("bracket-open", "a = {0x01,\n0x03\n")]);
    }

    #[test]
    fn the_style_is_what_most_bytes_have() {
        assert_eq!(read("01 03 04").style, Some(Style::Separated));
        assert_eq!(read("010304").style, Some(Style::Contiguous));
        assert_eq!(read("0x01 03h 0x04").style, Some(Style::Prefixed));
        assert_eq!(read(r"\x01\x02").style, Some(Style::Escaped));
        assert_eq!(read("1").style, None);
    }
}

//! One line: its time, who speaks in it, and its runs of bytes.
//!
//! A run is numbers that follow each other with hardly more than marks between them. Where these marks
//! change within it (`7B 04'00 C8`, `8: 01 03`), it has a break: whether it is one telegram or a part of it
//! is, the evidence decides.

use super::characters::{
    DIGITS, ESCAPE, address, blank_character, character, decimal, digits, escape_sequence, fills_cell,
    hex_value, is_bits, is_digit, is_port, is_word, separator, service, wide, word_end, word_of,
};
use super::time;
use super::words::{self, About, Sender, Weight};
use crate::field::{Direction, Span};

/// How bytes without a mark of their own are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    Hex,
    Decimal,
}

/// How bytes are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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
    pub const ALL: [Self; 5] =
        [Self::Separated, Self::Contiguous, Self::Prefixed, Self::Suffixed, Self::Escaped];

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

/// Bytes that follow each other with only marks between them.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// Its bytes in [`Scan::hex`], [`Scan::decimal`] and [`Scan::places`].
    pub first: usize,
    pub end: usize,
    /// Its place in the line.
    pub span: Span,
    /// All its numbers can be hex.
    pub hex: bool,
    /// All its numbers can be decimal, and none is more than 255.
    pub decimal: bool,
    /// Written as `0x01`, `\x01` or `01h`: certainly bytes.
    pub marked: bool,
    pub style: Style,
    /// One run of digits behind a colon, as Modbus ASCII has it.
    pub colon: bool,
    /// Who speaks, by what stands before it.
    pub sender: Option<(Sender, Weight)>,
    /// No other word is between the one that says who speaks and the run.
    pub said: bool,
    /// The word before it, as [`word_of`] makes it a number.
    pub word: u32,
    /// Its breaks in [`Scan::breaks`].
    pub breaks: Span,
    tokens: usize,
    /// Where the last token's bytes begin.
    last: usize,
    /// How many tokens there are since the last break.
    since: usize,
    /// It has a byte of one digit without a zero before it, and one with a zero.
    single: bool,
    padded: bool,
    /// Where the second token's bytes begin, counted from the last break.
    second: usize,
    /// The same in the line.
    second_at: usize,
    separator: u8,
    /// How wide the first separator is.
    gap: usize,
}

impl Run {
    /// How many bytes it has.
    pub fn len(&self) -> usize {
        self.end - self.first
    }

    /// How many numbers they are written as.
    pub fn tokens(&self) -> usize {
        self.tokens
    }

    /// Whether commas stand between its numbers.
    pub fn is_list(&self) -> bool {
        self.tokens > 1 && self.separator == b','
    }

    /// What stands between its bytes, `otherwise` where it has only one number so far.
    fn separator_or(&self, otherwise: u8) -> u8 {
        if self.since < 2 { otherwise } else { self.separator }
    }
}

/// What was found in a line. It is used for line after line, so that none allocates.
#[derive(Debug, Default)]
pub struct Scan {
    pub hex: Vec<u8>,
    pub decimal: Vec<u8>,
    /// Where each byte stands in the line.
    pub places: Vec<Span>,
    pub runs: Vec<Run>,
    /// Bytes behind which what stands between them changes.
    pub breaks: Vec<usize>,
    pub time: Option<i64>,
    /// Words that are neither bytes nor time.
    pub words: usize,
    /// Words that telegrams have near them, and words for what is left over.
    pub of_telegrams: bool,
    pub of_leftovers: bool,
    /// Behind the bytes they stand as characters.
    pub column: bool,
    /// Characters within runs that are no hex, as slips of typing are.
    pub slips: usize,
    /// Who speaks, by words anywhere in the line.
    pub sender: Option<(Sender, Weight)>,
    /// The line calls for both: `Request | Response`.
    pub both: bool,
    /// What tells several lines or connections apart: `COM8`, `ttyUSB0`, or the addresses of both ends,
    /// the client's first, whoever speaks. Empty where none is said.
    pub port: Vec<u8>,
    /// The addresses in the line.
    ends: [Option<Span>; 2],
    /// The last word that says who speaks is an arrow, and it points back.
    arrow: Option<bool>,
    open: Option<Run>,
    /// The words that say who speaks, since the last run: the last strong one and the last weak one.
    strong: Option<Sender>,
    weak: Option<Sender>,
    words_since: usize,
    /// The last word, see [`word_of`].
    last_word: u32,
    /// No quote of this kind comes behind this place any more: `'`, `"`.
    unclosed: [bool; 2],
    /// What comes first in the line was read already: here are bytes.
    in_row: bool,
    /// Decimal numbers are not asked for.
    hex_only: bool,
    /// Any number with a fraction is a time in units of so many microseconds.
    time_unit: Option<i64>,
}

/// Where a line begins.
#[derive(Clone, Copy, Debug, Default)]
pub struct Start {
    pub from: usize,
    /// What comes before was read already: here are bytes.
    pub in_row: bool,
}

/// What a token's digits are.
enum Token {
    /// Bytes were added: all can be hex, all can be decimal, they are marked as bytes.
    Bytes(Kind),
    Word,
}

/// What bytes of a token are.
#[derive(Clone, Copy, Debug)]
struct Kind {
    /// They can be hex.
    hex: bool,
    /// They can be decimal.
    decimal: bool,
    marked: bool,
    style: Style,
}

/// Hex digits without a mark.
const PLAIN: Kind = Kind { hex: true, decimal: false, marked: false, style: Style::Separated };

/// Bytes that are certainly hex.
const fn marked(style: Style) -> Kind {
    Kind { hex: true, decimal: false, marked: true, style }
}

impl Scan {
    /// For times that are plain numbers of units of so many microseconds.
    pub fn timed(time_unit: Option<i64>) -> Self {
        Self { time_unit, ..Self::default() }
    }

    /// Reads what of `line` was not read yet. `numbers` says how bytes are written, if that is known.
    pub fn read(&mut self, line: &[u8], Start { from, in_row }: Start, numbers: Option<Numbers>) {
        self.clear();
        self.hex_only = numbers == Some(Numbers::Hex);
        self.in_row = in_row;
        let mut at = from;
        let first =
            line[from.min(line.len())..].iter().take_while(|c| c.is_ascii_whitespace()).count() + from;
        while at < line.len() {
            at = self.same_again(line, at, numbers);
            let Some(c) = line.get(at).copied() else { break };
            at = match c {
                b'\\' => self.escape(line, at),
                b'"' | b'\'' => self.quoted(line, at),
                b'<' | b'>' | b'-' | b'=' => match words::arrow(line, at) {
                    Some((sender, to)) => {
                        self.close();
                        self.say(self.party(sender).unwrap_or(sender), Weight::Strong);
                        self.arrow = Some(sender == Sender::Other);
                        to
                    }
                    None if at == first && matches!(c, b'<' | b'>') => self.points(line, at),
                    None if c == b'-' && self.is_negative(line, at) => self.negative(line, at),
                    None => at + 1,
                },
                b'&' if matches!(line.get(at + 1), Some(b'H' | b'h')) => self.of_basic(line, at),
                ESCAPE => at + escape_sequence(&line[at..]).max(1),
                b'S' | b'E' if at == first && self.runs.is_empty() => {
                    self.label(line, at).unwrap_or_else(|| self.word(line, at, numbers))
                }
                // A letter can be cut, or its first byte one of another kind.
                _ if is_word(c) && word_end(line, at) > at => self.word(line, at, numbers),
                0x80.. => self.sign(line, at),
                b' ' | b'\t' | b'|' => {
                    match self.open.as_ref().is_some_and(|run| self.is_column(line, run)) {
                        true => {
                            self.column = true;
                            break;
                        }
                        false => at + line[at..].iter().take_while(|other| **other == c).count(),
                    }
                }
                _ => at + 1,
            };
        }
        self.close();
    }

    /// `>` or `<` at the beginning of a line, unless it is a bracket around a byte or around all: `<01><03>`.
    fn points(&mut self, line: &[u8], at: usize) -> usize {
        let word = word_end(line, at + 1);
        let around = line[at] == b'<' && line.trim_ascii_end().ends_with(b">");
        if line.get(word) != Some(&b'>') && !around {
            let sender = if line[at] == b'>' { Sender::Logger } else { Sender::Other };
            self.say(sender, Weight::Weak);
            self.words -= 1;
        }
        at + 1
    }

    /// A sign or letter of another script than ours: it parts words and bytes.
    fn sign(&mut self, line: &[u8], at: usize) -> usize {
        const WIDE: usize = 3;
        let blank = blank_character(&line[at..]);
        if blank > 0 {
            return at + blank;
        }
        let digit = |at: usize| wide(line.get(at..)?).filter(u8::is_ascii_hexdigit);
        if let (Some(high), Some(low)) = (digit(at), digit(at + WIDE)) {
            let (first, to) = (self.hex.len(), at + 2 * WIDE);
            self.push(hex_value(&[high, low]), 0, at, to);
            self.join(line, at, to, first, PLAIN);
            return to;
        }
        self.drop_counted(line, at);
        self.close();
        match words::sign(line, at) {
            Some((About::Sender(sender, weight), to)) => {
                self.say(sender, weight);
                // ← and → point as arrows do.
                if line[at] == 0xE2 {
                    self.arrow = Some(sender == Sender::Other);
                }
                to
            }
            Some((_, to)) => to,
            None => at + 1 + line[at + 1..].iter().take(3).take_while(|c| (0x80..0xC0).contains(*c)).count(),
        }
    }

    /// A number with an ideograph right behind it counts something: `16进制`, `2字节`.
    fn drop_counted(&mut self, line: &[u8], at: usize) {
        let ideograph = (0xE4..=0xE9).contains(&line[at]);
        let counts = |run: &Run| run.tokens == 1 && run.decimal && !run.padded && run.span.to == at;
        if let Some(run) = self.open.take_if(|run| ideograph && counts(run)) {
            for numbers in [&mut self.hex, &mut self.decimal] {
                numbers.truncate(run.first);
            }
            self.places.truncate(run.first);
            self.stranger();
        }
    }

    fn clear(&mut self) {
        self.hex.clear();
        self.decimal.clear();
        self.places.clear();
        self.runs.clear();
        self.port.clear();
        (self.time, self.sender, self.both, self.open) = (None, None, false, None);
        (self.ends, self.arrow) = ([None; 2], None);
        (self.strong, self.weak, self.words, self.words_since) = (None, None, 0, 0);
        (self.of_telegrams, self.of_leftovers, self.slips, self.column) = (false, false, 0, false);
        (self.last_word, self.unclosed) = (0, [false; 2]);
        self.breaks.clear();
    }

    /// Reads a row of octal numbers: bytes of three digits, and words of six with the low byte first.
    pub fn read_octal(&mut self, line: &[u8], from: usize) {
        self.clear();
        self.hex_only = true;
        let mut at = from;
        while at < line.len() {
            let count = line[at..].iter().take_while(|c| (b'0'..=b'7').contains(*c)).count();
            let digits = &line[at..at + count];
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

    /// Most of a log are bytes of two hex digits with the same between them: they are read without
    /// asking what else they could be. Returns where that ends.
    #[inline]
    fn same_again(&mut self, line: &[u8], mut at: usize, numbers: Option<Numbers>) -> usize {
        let Some(run) = &mut self.open else { return at };
        let width = run.gap;
        let known = run.since >= 2
            && run.hex
            && !run.marked
            && !run.single
            && run.span.to == at
            && (1..=2).contains(&width);
        if !known || numbers == Some(Numbers::Decimal) {
            return at;
        }
        let gap = [line[run.second_at - width], line[run.second_at - 1]];
        while let Some(next) = line.get(at..at + width + 2) {
            let (between, digits) = next.split_at(width);
            let (high, low) = (DIGITS[usize::from(digits[0])], DIGITS[usize::from(digits[1])]);
            let same = between[0] == gap[0] && between[width - 1] == gap[1];
            let ends = line.get(at + width + 2).is_none_or(|c| !is_word(*c));
            if !same || (high | low) > 15 || !ends {
                break;
            }
            let place = Span::new(at + width, at + width + 2);
            self.hex.push(high << 4 | low);
            if !self.hex_only {
                self.decimal.push(high.wrapping_mul(10).wrapping_add(low));
            }
            self.places.push(place);
            run.decimal &= (high < 10) & (low < 10);
            run.padded |= high == 0;
            run.tokens += 1;
            run.since += 1;
            at = place.to;
        }
        if at > run.span.to {
            (run.last, run.end) = (self.hex.len() - 1, self.hex.len());
            (run.span.to, run.colon) = (at, false);
        }
        at
    }

    /// Whether the first number of a run counts the bytes behind it.
    pub fn counts(&self, run: &Run) -> bool {
        // Counts are decimal, whatever the bytes are.
        let first = self.hex[run.first];
        let count = if run.hex { first / 16 * 10 + first % 16 } else { self.decimal[run.first] };
        run.len() > 4 && run.tokens() == run.len() && usize::from(count) + 1 == run.len()
    }

    /// Takes the first number out of runs where it counts the bytes behind it.
    pub fn drop_counts(&mut self) {
        for at in 0..self.runs.len() {
            if self.counts(&self.runs[at]) {
                let run = &mut self.runs[at];
                run.first += 1;
                run.span.from = self.places[run.first].from;
            }
        }
    }

    /// The bytes of `run`, decimal only where they must be or are known to be.
    pub fn bytes(&self, run: &Run, numbers: Numbers) -> &[u8] {
        let decimal =
            !self.hex_only && run.decimal && (!run.hex || numbers == Numbers::Decimal) && !run.marked;
        &(if decimal { &self.decimal } else { &self.hex })[run.first..run.end]
    }

    /// The bytes of `run` read as decimal numbers, if they can be.
    pub fn decimal_bytes(&self, run: &Run) -> Option<&[u8]> {
        // Who writes 01 means hex, unless other numbers of the list have a mark.
        let meant = !run.hex || !run.padded || run.marked;
        (run.decimal && meant && !self.hex_only).then(|| &self.decimal[run.first..run.end])
    }

    /// Whether another number of the line says how many bytes `run` has.
    pub fn is_counted(&self, line: &[u8], run: &Run) -> bool {
        let number = |other: &Run| other.tokens == 1 && decimal(other.span.of(line)) == Some(run.len());
        run.len() > 1 && self.near(run).iter().any(|other| other.first != run.first && number(other))
    }

    /// The runs around `run`: of a line with thousands, those far away say nothing of it.
    pub fn near(&self, run: &Run) -> &[Run] {
        const NEAR: usize = 32;
        let at = self.runs.partition_point(|other| other.first < run.first);
        &self.runs[at.saturating_sub(NEAR)..self.runs.len().min(at + NEAR)]
    }

    /// Whether `run` is the one byte of a short acknowledgement of PROFIBUS behind its name: `SC E5`.
    pub fn is_acknowledgement(&self, run: &Run) -> bool {
        const SC: u8 = 0xE5;
        run.len() == 1 && self.hex[run.first] == SC && run.word == word_of(b"SC")
    }

    /// The last number of the line, in decimal; 0 if there is none.
    pub fn last_number(&self, line: &[u8]) -> usize {
        let last = self.runs.last().and_then(|run| {
            let digits = run.span.of(line);
            let from = digits.iter().rposition(|c| !is_digit(*c)).map_or(0, |at| at + 1);
            decimal(&digits[from..])
        });
        last.unwrap_or_default()
    }

    /// Whether nothing but marks stands behind `run`.
    pub fn tail_is_plain(&self, line: &[u8], run: &Run) -> bool {
        !line[run.span.to..].iter().any(u8::is_ascii_alphanumeric)
    }

    /// `S1:` and `E1:` at the beginning of a line, as manuals number what is sent and what comes back.
    fn label(&mut self, line: &[u8], at: usize) -> Option<usize> {
        let sender = match line[at] {
            b'S' => Sender::Says(Direction::Request),
            b'E' => Sender::Says(Direction::Response),
            _ => return None,
        };
        let (_, to) =
            digits(line, at + 1).filter(|(number, to)| *number < 100 && line.get(*to) == Some(&b':'))?;
        self.say(sender, Weight::Strong);
        Some(to)
    }

    fn word(&mut self, line: &[u8], at: usize, numbers: Option<Numbers>) -> usize {
        if is_digit(line[at]) {
            // Bytes with dots or colons can go on like an address or a time.
            let goes_on = self.open.as_ref().is_some_and(|run| {
                run.span.to + 1 == at && (run.tokens > 1 || matches!(line[run.span.to], b'.' | b':' | b'-'))
            });
            let end = at + line[at..].iter().take_while(|c| is_digit(**c)).count();
            let mark = line.get(end).copied().filter(|_| !goes_on).unwrap_or_default();
            if mark == b'.'
                && let Some(to) = address(line, at)
            {
                self.end_of_connection(line, Span::new(at, to));
                return to;
            }
            if matches!(mark, b':' | b'-' | b'/' | b'.')
                && let Some(found) = self.time_at(line, at)
            {
                self.close();
                self.time = self.time.or(Some(found.micros));
                return found.to;
            }
        }
        if line[at..].starts_with(b"16#") {
            return self.based(line, at);
        }
        let to = word_end(line, at);
        let first = self.hex.len();
        // The letter before a string says what kind of string it is: b"…".
        if to - at == 1 && line[at].is_ascii_alphabetic() && matches!(line.get(to), Some(b'"' | b'\'')) {
            self.close();
            return to;
        }
        match self.token(line, at, to, numbers) {
            Token::Bytes(kind) => {
                self.join(line, at, to, first, kind);
                to
            }
            Token::Word => {
                self.hex.truncate(first);
                self.decimal.truncate(first);
                self.places.truncate(first);
                if let Some(to) = self.slip(line, at, to) {
                    return to;
                }
                self.close();
                self.last_word = word_of(&line[at..to]);
                match words::word(&line[at..to]) {
                    Some(About::Sender(sender, weight)) => self.say(sender, weight),
                    Some(About::Telegrams) => {
                        self.of_telegrams = true;
                        self.stranger();
                    }
                    Some(About::Leftovers) => {
                        self.of_leftovers = true;
                        self.stranger();
                    }
                    None => self.stranger(),
                }
                if is_port(&line[at..to]) {
                    self.port.clear();
                    self.port.extend_from_slice(&line[at..to]);
                }
                to
            }
        }
    }

    /// A word within bytes that is nearly one: a slip of typing, or bytes into whose line another program
    /// wrote (`00MQTT is up`). Returns where it ends.
    fn slip(&mut self, line: &[u8], at: usize, to: usize) -> Option<usize> {
        let text = &line[at..to];
        let hex = text.iter().filter(|c| c.is_ascii_hexdigit()).count();
        let blank = self.open.as_ref().is_none_or(|run| separator(&line[run.span.to..at]) == Some(b' '));
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
        let run = self.open.as_mut().filter(|run| run.hex && !run.marked && run.tokens > 0)?;
        let separated = blank && run.style == Style::Separated;
        let typed = match text {
            [_] => !is_digit(text[0]) && !matches!(text[0], b'x' | b'X'),
            [a, b] => hex == 1 && (is_digit(*a) || matches!(a, b'O' | b'o' | b'l' | b'I') || is_digit(*b)),
            _ => false,
        };
        if separated && typed && run.tokens > 1 {
            run.span.to = to;
            run.since = 0;
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

    /// `&H01`, as Basic has it.
    fn of_basic(&mut self, line: &[u8], at: usize) -> usize {
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

    fn time_at(&self, line: &[u8], at: usize) -> Option<time::Found> {
        self.time_unit.and_then(|unit| time::number(line, at, unit)).or_else(|| time::at(line, at))
    }

    /// Adds the bytes that the letters and digits `at..to` stand for.
    fn token(&mut self, line: &[u8], at: usize, to: usize, numbers: Option<Numbers>) -> Token {
        let text = &line[at..to];
        if let [b'0', b'x' | b'X', ..] = text {
            return self.prefixed(line, at, to);
        }
        let count = text.len();
        let digits = text.iter().all(|c| is_digit(*c));
        if digits || text.iter().all(u8::is_ascii_hexdigit) {
            let letters = count > 2 && !text.iter().any(|c| is_digit(*c));
            let groups = || self.open.as_ref().is_some_and(|run| run.style == Style::Contiguous);
            // Words such as "faced" are no bytes, and a row of bits is none either.
            let word = letters && !(count == 4 && (groups() || fills_cell(line, at, to)));
            if !self.in_row && (word || is_bits(text)) {
                return Token::Word;
            }
            let decimal = digits && count <= 3 && numbers != Some(Numbers::Hex);
            let value =
                if decimal { text.iter().fold(0, |sum, c| sum * 10 + u32::from(c - b'0')) } else { 256 };
            let hex =
                count != 3 && (count < 2 || count.is_multiple_of(2)) && numbers != Some(Numbers::Decimal);
            return match (hex, value < 256) {
                (false, false) => Token::Word,
                (false, true) => {
                    self.push(0, value as u8, at, to);
                    Token::Bytes(Kind { hex: false, decimal: true, marked: false, style: Style::Separated })
                }
                (true, decimal) => {
                    for pair in (at..to).step_by(2) {
                        let end = (pair + 2).min(to);
                        self.push(hex_value(&line[pair..end]), value as u8, pair, end);
                    }
                    let style = if count > 2 { Style::Contiguous } else { Style::Separated };
                    Token::Bytes(Kind { hex: true, decimal: decimal && count <= 2, marked: false, style })
                }
            };
        }
        let digits = &text[..count - 1];
        let suffixed = matches!(text[count - 1], b'h' | b'H') && digits.iter().all(u8::is_ascii_hexdigit)
            // "ach" is a word.
            && (digits.iter().any(|c| is_digit(*c)) || digits.iter().all(u8::is_ascii_uppercase));
        match (suffixed, text) {
            (true, [_, _] | [_, _, _] | [b'0', _, _, _]) => {
                let from = if count == 4 { at + 1 } else { at };
                self.push_marked(hex_value(&line[from..to - 1]), at, to);
                Token::Bytes(marked(Style::Suffixed))
            }
            (true, [_, _, _, _, _]) => {
                self.push_marked(hex_value(&text[..2]), at, at + 2);
                self.push_marked(hex_value(&text[2..4]), at + 2, to);
                Token::Bytes(marked(Style::Suffixed))
            }
            _ => Token::Word,
        }
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
            if count == 0 || (count > 2 && count % 2 == 1) {
                return Token::Word;
            }
            for pair in (0..count).step_by(2) {
                let place = if pair == 0 { from } else { from + 2 + pair };
                let end = from + 2 + (pair + 2).min(count);
                self.push_marked(hex_value(&line[from + 2 + pair..end]), place, end);
            }
            from += 2 + count;
        }
        match line[from..to].first() {
            None | Some(b'u' | b'U' | b'l' | b'L' | b'i') if to - from <= 3 => {
                Token::Bytes(marked(Style::Prefixed))
            }
            _ => Token::Word,
        }
    }

    /// `16#01`, as programs for controllers have it.
    fn based(&mut self, line: &[u8], at: usize) -> usize {
        let from = at + 3;
        let to = word_end(line, from);
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

    fn push(&mut self, hex: u8, decimal: u8, from: usize, to: usize) {
        self.hex.push(hex);
        if !self.hex_only {
            self.decimal.push(decimal);
        }
        self.places.push(Span::new(from, to));
    }

    /// A byte with a mark of its own is the same in a list of decimal numbers.
    fn push_marked(&mut self, value: u8, from: usize, to: usize) {
        self.push(value, value, from, to);
    }

    /// Takes the bytes from `first` on into the open run, or begins a new one.
    fn join(&mut self, line: &[u8], at: usize, to: usize, first: usize, kind: Kind) {
        /// A run with more breaks is none.
        const BREAKS: usize = 8;
        /// A number of so many bytes can be a telegram by itself.
        const LONG: usize = 4;
        let short = kind.style == Style::Separated && to - at <= 2;
        let single = short && to - at == 1;
        let padded = short && to - at == 2 && line[at] == b'0';
        if let Some(run) = &mut self.open {
            let gap = &line[run.span.to..at];
            let between = separator(gap);
            let both = (run.hex && kind.hex) || (run.decimal && kind.decimal);
            // In a list, decimal numbers can stand beside hex ones with a mark.
            let list = between == Some(b',') && run.separator_or(b',') == b',';
            // Long numbers in a list are a telegram each; in the rows of a dump they are words.
            let long = first - run.last >= LONG || self.hex.len() - first >= LONG;
            let fits = !(long && between != Some(b' '))
                && ((both && run.marked == kind.marked) || (list && (both || run.marked || kind.marked)));
            // `a 01 03`, `01 03 0`: who writes zeros before one digit writes them before each.
            let apart = between == Some(b' ') && !kind.marked && run.tokens > 0;
            let odd = apart && ((padded && run.single && run.tokens == 1) || (single && run.padded));
            if let Some(mark) = between.filter(|_| fits && !odd) {
                if run.since == 0 {
                    (run.separator, run.gap) = (0, 0);
                } else if run.since == 1 {
                    (run.separator, run.gap, run.second, run.second_at) = (mark, gap.len(), first, at);
                } else if mark != run.separator && !(run.tokens == 8 && run.separator == b' ' && gap == b"-")
                {
                    // `8: 01 03 …`: what stands between them changes behind the first one already.
                    let restart = run.since == 2;
                    let place = if restart { run.second } else { first };
                    // What was decimal before a break need not be so behind it.
                    let other = !run.hex && kind.hex;
                    if run.breaks.len() >= BREAKS || other {
                        self.close();
                        return self.begin(line, at, to, first, kind, (single, padded));
                    }
                    self.breaks.push(place);
                    run.breaks.to = self.breaks.len();
                    run.since = 0;
                    if restart {
                        run.since = 1;
                        (run.separator, run.gap, run.second, run.second_at) = (mark, gap.len(), first, at);
                    }
                }
                run.last = first;
                run.end = self.hex.len();
                run.span.to = to;
                run.tokens += 1;
                run.since += 1;
                run.decimal = (run.decimal || run.marked) && (kind.decimal || kind.marked);
                run.hex &= kind.hex;
                run.marked |= kind.marked;
                run.single |= single;
                run.padded |= padded;
                if kind.style == Style::Contiguous {
                    run.style = Style::Contiguous;
                }
                run.colon = false;
                return;
            }
        }
        self.close();
        self.begin(line, at, to, first, kind, (single, padded));
    }

    fn begin(
        &mut self,
        line: &[u8],
        at: usize,
        to: usize,
        first: usize,
        kind: Kind,
        (single, padded): (bool, bool),
    ) {
        let before = |back: usize| at.checked_sub(back).map(|place| line[place]);
        let colon = before(1) == Some(b':') && !before(2).is_some_and(|c| c.is_ascii_alphanumeric());
        let sender = self.strong.map(|sender| (sender, Weight::Strong));
        self.open = Some(Run {
            first,
            end: self.hex.len(),
            span: Span::new(at, to),
            hex: kind.hex,
            decimal: kind.decimal,
            marked: kind.marked,
            style: kind.style,
            colon: colon && to - at >= 6,
            sender: sender.or(self.weak.map(|sender| (sender, Weight::Weak))),
            said: self.words_since == 0 && (self.strong.is_some() || self.weak.is_some()),
            word: self.last_word,
            breaks: Span::new(self.breaks.len(), self.breaks.len()),
            tokens: 1,
            last: first,
            since: 1,
            single,
            padded,
            second: first,
            second_at: at,
            separator: 0,
            gap: 0,
        });
    }

    fn close(&mut self) {
        let Some(mut run) = self.open.take() else { return };
        // [01][03] is sent and <01><03> received: libmodbus writes so.
        let sender = match run.separator {
            b']' => Some(Sender::Logger),
            b'>' => Some(Sender::Other),
            _ => None,
        };
        if let Some(sender) = sender.filter(|_| run.tokens > 2 && run.sender.is_none()) {
            run.sender = Some((sender, Weight::Strong));
        }
        /// So many bytes that what is said before them is not said of the next ones.
        const TELEGRAM: usize = 4;
        if run.len() >= TELEGRAM {
            (self.strong, self.weak) = (None, None);
        }
        self.runs.push(run);
    }

    /// Who speaks where an arrow comes right behind a word for one side: `master -> slave`.
    fn party(&self, arrow: Sender) -> Option<Sender> {
        let Some(Sender::Says(before)) = self.weak.filter(|_| self.words_since == 0) else { return None };
        Some(Sender::Says(match (arrow, before) {
            (Sender::Other, Direction::Request) => Direction::Response,
            (Sender::Other, Direction::Response) => Direction::Request,
            _ => before,
        }))
    }

    /// Whether a number below 0 begins at a minus, as some languages write bytes: `4, -40, 0`.
    fn is_negative(&self, line: &[u8], at: usize) -> bool {
        let apart = at.checked_sub(1).is_some_and(|before| matches!(line[before], b' ' | b',' | b'[' | b'{'));
        let number =
            digits(line, at + 1).filter(|(value, _)| (1..=128).contains(value) && line[at + 1] != b'0');
        let ends = |to: usize| line.get(to).is_none_or(|c| matches!(c, b' ' | b',' | b']' | b'}' | b';'));
        apart && number.is_some_and(|(_, to)| ends(to))
    }

    fn negative(&mut self, line: &[u8], at: usize) -> usize {
        let Some((value, to)) = digits(line, at + 1) else { return at + 1 };
        let first = self.hex.len();
        self.push(0, (value as u8).wrapping_neg(), at, to);
        let kind = Kind { hex: false, decimal: true, marked: false, style: Style::Separated };
        self.join(line, at, to, first, kind);
        to
    }

    fn say(&mut self, sender: Sender, weight: Weight) {
        self.arrow = None;
        match weight {
            Weight::Strong => self.strong = Some(sender),
            Weight::Weak => self.weak = Some(sender),
        }
        let said = |sender| matches!(sender, Sender::Says(_));
        self.both |= self.sender.is_some_and(|(other, _)| other != sender && said(other) && said(sender));
        if self.sender.is_none_or(|(_, known)| known < weight) {
            self.sender = Some((sender, weight));
        }
        self.words += 1;
        self.words_since = 0;
    }

    /// The address of an end of a connection: of the one that sends, or behind that, of the other one.
    fn end_of_connection(&mut self, line: &[u8], place: Span) {
        self.stranger();
        let (from, to) = match self.ends {
            [None, _] => {
                self.ends[0] = Some(place);
                return self.port.extend_from_slice(place.of(line));
            }
            [Some(from), None] if from.of(line) != place.of(line) => (from, place),
            _ => return,
        };
        self.ends[1] = Some(to);
        let key = |end: Span| (service(end.of(line)), end.of(line));
        // A server waits at a known port; a client is given one of the high ones.
        let (client, server) = if key(from) > key(to) { (from, to) } else { (to, from) };
        self.port.clear();
        for part in [client.of(line), " – ".as_bytes(), server.of(line)] {
            self.port.extend_from_slice(part);
        }
        let asks = (client == from) != self.arrow.unwrap_or(false);
        if service(client.of(line)) != service(server.of(line)) {
            let direction = if asks { Direction::Request } else { Direction::Response };
            self.sender = None;
            self.say(Sender::Says(direction), Weight::Strong);
        } else if self.arrow.is_some() {
            // It shows where to, not whether that one is asked.
            (self.strong, self.sender) = (None, None);
        }
    }

    /// A word that says nothing.
    fn stranger(&mut self) {
        self.close();
        self.words += 1;
        self.words_since += 1;
    }

    /// `\x01` outside of quotes. Letters and digits right behind one are characters, as in the `\x845` that
    /// Python prints for 84 35.
    fn escape(&mut self, line: &[u8], at: usize) -> usize {
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
        while let Some(c) = line.get(to).copied().filter(u8::is_ascii_alphanumeric) {
            self.push_marked(c, to, to + 1);
            to += 1;
        }
        self.join(line, at, to, first, marked(Style::Escaped));
        to
    }

    /// A string with escapes in it is bytes, each character one: `b'\x01\x03E'`.
    fn quoted(&mut self, line: &[u8], at: usize) -> usize {
        /// What can follow a backslash, but in a path of Windows.
        const ESCAPES: &[u8] = b"xX0123456789tnrabvfeu\\\"'";
        let quote = line[at];
        let unclosed = &mut self.unclosed[usize::from(quote == b'"')];
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
                escaped |= matches!(next, b'x' | b'X' | b'0'..=b'7' | b't' | b'n' | b'r');
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
        let first = self.hex.len();
        let mut from = at + 1;
        while from < to {
            let (byte, length) = character(&line[from..to]);
            self.push_marked(byte, from, from + length);
            from += length;
        }
        self.join(line, at, to + 1, first, marked(Style::Escaped));
        self.close();
        to + 1
    }

    /// Whether what follows the open run shows its bytes as characters.
    fn is_column(&self, line: &[u8], run: &Run) -> bool {
        let rest = &line[run.span.to..];
        let wide = rest.len() > 1 && matches!(rest[1], b' ' | b'\t' | b'|') && run.gap < 2;
        let bytes = &self.hex[run.first..run.end];
        if !wide && rest[0] != b'|' {
            return false;
        }
        let text = rest.trim_ascii_end();
        let text = text.strip_suffix(b"|").unwrap_or(text);
        let blank = text.iter().take_while(|c| matches!(c, b' ' | b'\t' | b'|')).count();
        // A column can begin with blanks that stand for bytes.
        let shows = |from: usize| {
            let mut column = &text[from..];
            let mut shown = bytes.iter();
            while let Some(c) = column.first() {
                let length = if *c < 0x80 {
                    1
                } else {
                    1 + column[1..].iter().take(3).take_while(|c| (0x80..0xC0).contains(*c)).count()
                };
                let same =
                    |byte: &u8| c == byte || (!matches!(byte, b'!'..=b'~') && (*c == b'.' || *c >= 0x80));
                if !shown.next().is_some_and(same) {
                    return false;
                }
                column = &column[length..];
            }
            shown.all(|byte| *byte == b' ')
        };
        blank > 0 && text.len() <= blank + 3 * bytes.len() && (1..=blank).any(shows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::hex;

    /// The bytes of the longest run.
    fn read(text: &str) -> (String, Option<Sender>) {
        let mut scan = Scan::default();
        scan.read(text.as_bytes(), Start::default(), None);
        let Some(run) = scan.runs.iter().max_by_key(|run| run.len()) else { return (String::new(), None) };
        // What stands before the last break is something else here.
        let from = run.breaks.of(&scan.breaks).last().map_or(0, |at| at - run.first);
        (hex(&scan.bytes(run, Numbers::Hex)[from..]), run.sender.map(|(sender, _)| sender))
    }

    #[test]
    fn bytes_are_found_among_other_things() {
        for text in [
            "01 03 00 C8 00 03 84 35",
            "000017-Tx:01 03 00 C8 00 03 84 35",
            "[RTU]>Tx > 09:30:05:081 - 01  03  00  C8  00  03  84  35  ",
            "2026-03-02 09:30:05.091 DEBUG (SyncWorker_1) [pymodbus.transaction] SEND: 0x1 0x3 0x0 0xc8 0x0 0x3 0x84 0x35",
            "[09:30:05][V][modbus:222]: Modbus write: 01.03.00.C8.00.03.84.35 (8)",
            "[09:30:05][D][uart_debug:114]: >>> 01:03:00:C8:00:03:84:35",
            "Raw Request >>> {0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35}",
            "x write to instrument (expecting 7 bytes back): 01 03 00 C8 00 03 84 35 (8 bytes) in 31.4 ms. Wait 50.0 ms.",
            "Modbus.IO - TX: 1, 3, 0, 200, 0, 3, 132, 53",
            "DEBUG:modbus_tk:-> 01-03-00-c8-00-03-84-35",
            "[01][03][00][C8][00][03][84][35]",
            "    01 03 00 c8 00 03 84 35                           .......5",
            "192.168.0.10:502 > 10.0.0.7:49152 len 8: 01 03 00 C8 00 03 84 35",
            r"port.write(b'\x01\x03\x00\xc8\x00\x03\x845')",
            r"tx \x01\x03\x00\xC8\x00\x03\x84\x35",
            "I (12345) MB: 8: 01 03 00 C8 00 03 84 35",
            "send 0x010300C800038435 to COM3",
            "Tx=010300c800038435;",
            "01h 03h 00h 0C8h 00h 03h 84h 35h",
            "16#01 16#03 16#00 16#C8 16#00 16#03 16#84 16#35",
            "$01,$03,$00,$C8,$00,$03,$84,$35",
            "%01%03%00%C8%00%03%84%35",
            "sent [1, 3, 0, -56, 0, 3, -124, 53]",
        ] {
            assert_eq!(read(text).0, "01 03 00 C8 00 03 84 35", "{text}");
        }
    }

    #[test]
    fn who_speaks() {
        let says = |text| read(text).1;
        assert_eq!(says("TX: 01 03 00 C8 00"), Some(Sender::Logger));
        assert_eq!(
            says("read holding registers, Response: 01 03 02 00 00"),
            Some(Sender::Says(Direction::Response))
        );
        assert_eq!(says("-> 01 03 00 C8 00"), Some(Sender::Logger));
        assert_eq!(says("<01><03><02><00>"), Some(Sender::Other));
        assert_eq!(says("01 03 00 C8"), None);
        assert_eq!(says("master -> slave: 01 03 00 C8"), Some(Sender::Says(Direction::Request)));
        assert_eq!(says("slave -> master: 01 03 00 C8"), Some(Sender::Says(Direction::Response)));
        assert_eq!(says("master <- slave: 01 03 00 C8"), Some(Sender::Says(Direction::Response)));
    }

    #[test]
    fn times_and_ports_are_told() {
        let mut scan = Scan::default();
        scan.read(b"[02/03/2026 09:30:05] Written data (COM8)", Start::default(), None);
        assert_eq!((scan.runs.len(), scan.time.is_some(), scan.words), (0, true, 3));
        assert_eq!(scan.port, b"COM8");
    }

    #[test]
    fn both_directions_of_a_connection_are_one_port() {
        let mut scan = Scan::default();
        let mut read = |text: &str| {
            scan.read(text.as_bytes(), Start::default(), None);
            let run = scan.runs.last().expect("bytes");
            (
                String::from_utf8_lossy(&scan.port).into_owned(),
                run.sender.map(|(sender, _)| sender),
                run.len(),
            )
        };
        let port = "10.0.0.7:49152 – 192.168.0.10:502".to_owned();
        let (asks, answers) = (Sender::Says(Direction::Request), Sender::Says(Direction::Response));
        for (text, sender) in [
            ("10.0.0.7:49152 -> 192.168.0.10:502: 01 06 00 C8 00 03", asks),
            ("192.168.0.10:502 -> 10.0.0.7:49152: 01 06 00 C8 00 03", answers),
            ("192.168.0.10:502 <- 10.0.0.7:49152: 01 06 00 C8 00 03", asks),
            ("src=10.0.0.7:49152 dst=192.168.0.10:502 01 06 00 C8 00 03", asks),
        ] {
            assert_eq!(read(text), (port.clone(), Some(sender), 6), "{text}");
        }
        assert_eq!(read("10.0.0.7 -> 10.0.0.1: 01 06 00 C8 00 03"), ("10.0.0.7 – 10.0.0.1".into(), None, 6));
        assert_eq!(read("10.0.0.1 -> 10.0.0.7: 01 06 00 C8 00 03"), ("10.0.0.7 – 10.0.0.1".into(), None, 6));
        let one = read("[10.0.0.7:49152] TX 01 06 00 C8 00 03");
        assert_eq!(one, ("10.0.0.7:49152".into(), Some(Sender::Logger), 6));
    }
}

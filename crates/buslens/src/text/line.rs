//! One line: its time, who speaks in it, and its runs of bytes.
//!
//! A run is numbers that follow each other with hardly more than marks between them. Where these marks
//! change within it (`7B 04'00 C8`, `8: 01 03`), it has a break: whether it is one telegram or a part of it
//! is, the evidence decides. `number` says how a number is written, `run` how numbers follow each other.

mod alike;
mod number;
mod run;

use std::cmp::{max_by_key, min_by_key};

use super::characters::{
    ESCAPE, address, begins_word, blank_character, decimal, digits, escape_sequence, hex_value, is_digit,
    is_port, service, url_blank, wide, word, word_of,
};
use super::time;
use super::words::{self, About, Sender, Weight};
use crate::field::{Direction, Span};
pub use alike::{Alike, Like, Told};
use number::Token;
use run::PLAIN;
pub use run::{Numbers, Run, Style};

/// What was found in a line. It is used for line after line, so that none allocates.
#[derive(Clone, Debug, Default)]
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
    /// Where bytes stand as pairs of hex digits at equal distances, if that is known: see [`Piece::pairs`].
    ///
    /// [`Piece::pairs`]: super::Piece::pairs
    pub pairs: Option<(usize, u8)>,
    /// Who speaks, by words anywhere in the line.
    pub sender: Option<(Sender, Weight)>,
    /// The line calls for both: `Request | Response`.
    pub both: bool,
    /// What tells several lines or connections apart: `COM8`, `ttyUSB0`, or the addresses of both ends,
    /// the client's first, whoever speaks. Empty where none is said.
    pub port: Vec<u8>,
    /// Where the time stands.
    time_place: Option<Span>,
    /// The addresses in the line.
    ends: [Option<Span>; 2],
    /// The last word that says who speaks is an arrow, and it points back.
    arrow: Option<bool>,
    /// The last run goes on, if the next number fits.
    is_open: bool,
    /// The words that say who speaks, since the last run: the last strong one and the last weak one.
    strong: Option<Sender>,
    weak: Option<Sender>,
    words_since: usize,
    /// The last word.
    last_word: Option<Span>,
    /// No quote of this kind comes behind this place any more: `'`, `"`.
    unclosed: [bool; 2],
    /// What comes first in the line was read already: here are bytes.
    in_row: bool,
    /// How bytes are written, if that is known.
    numbers: Option<Numbers>,
    /// Any number with a fraction is a time in units of so many microseconds.
    time_unit: Option<i64>,
    /// Of each number is asked what it could be, also where those before it are written in the same way.
    #[cfg(test)]
    pub slow: bool,
}

/// Where a line begins.
#[derive(Clone, Copy, Debug, Default)]
pub struct Start {
    pub from: usize,
    /// What comes before was read already: here are bytes.
    pub in_row: bool,
}

impl Scan {
    /// For times that are plain numbers of units of so many microseconds.
    pub fn timed(time_unit: Option<i64>) -> Self {
        Self { time_unit, ..Self::default() }
    }

    /// Reads what of `line` was not read yet. `numbers` says how bytes are written, if that is known.
    pub fn read(&mut self, line: &[u8], Start { from, in_row }: Start, numbers: Option<Numbers>) {
        self.clear();
        (self.numbers, self.in_row) = (numbers, in_row);
        let mut at = from;
        let first =
            line[from.min(line.len())..].iter().take_while(|c| c.is_ascii_whitespace()).count() + from;
        loop {
            at = self.same_again(line, at);
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
                    None if c == b'-' && !self.hex_only() && Self::is_negative(line, at) => {
                        self.negative(line, at)
                    }
                    None => at + 1,
                },
                // Bytes of their own may have the sign, too: `%01%20`.
                b'%' if self.open().is_some_and(|run| !run.is_parted_by(b'%')) => {
                    at + url_blank(&line[at..]).max(1)
                }
                b'&' if matches!(line.get(at + 1), Some(b'H' | b'h')) => self.of_basic(line, at),
                ESCAPE => at + escape_sequence(&line[at..]).max(1),
                b'S' | b'E' if at == first && self.runs.is_empty() => {
                    self.label(line, at).unwrap_or_else(|| self.word(line, at))
                }
                _ if begins_word(&line[at..]) => self.word(line, at),
                0x80.. => self.sign(line, at),
                b' ' | b'\t' | b'|' => match self.open().is_some_and(|run| self.is_column(line, run)) {
                    true => {
                        self.column = true;
                        break;
                    }
                    false => at + line[at..].iter().take_while(|other| **other == c).count(),
                },
                _ => at + 1,
            };
        }
        self.close();
        self.join_casts(line);
    }

    /// `>` or `<` at the beginning of a line, unless it is a bracket around a byte or around all: `<01><03>`.
    fn points(&mut self, line: &[u8], at: usize) -> usize {
        let word = word(line, at + 1).to;
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
        if ideograph && self.open().is_some_and(counts) {
            self.drop_open();
            self.stranger();
        }
    }

    fn clear(&mut self) {
        self.hex.clear();
        self.decimal.clear();
        self.places.clear();
        self.runs.clear();
        self.port.clear();
        (self.time, self.sender, self.both, self.is_open) = (None, None, false, false);
        (self.ends, self.arrow, self.time_place) = ([None; 2], None, None);
        (self.strong, self.weak, self.words, self.words_since) = (None, None, 0, 0);
        (self.of_telegrams, self.of_leftovers, self.slips, self.column) = (false, false, 0, false);
        (self.last_word, self.unclosed, self.pairs) = (None, [false; 2], None);
        self.breaks.clear();
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

    fn word(&mut self, line: &[u8], at: usize) -> usize {
        if is_digit(line[at]) {
            // Bytes with dots or colons can go on like an address or a time.
            let goes_on = |run: &Run| {
                run.span.to + 1 == at && (run.tokens > 1 || matches!(line[run.span.to], b'.' | b':' | b'-'))
            };
            let end = at + line[at..].iter().take_while(|c| is_digit(**c)).count();
            let mark = line.get(end).copied().unwrap_or_default();
            if let Some(to) = samples(line, at).filter(|_| self.words == 0 && self.runs.is_empty()) {
                self.stranger();
                return to;
            }
            let timed = matches!(mark, b':' | b'-' | b'/' | b'.') || end - at == time::MILLISECONDS;
            if timed && !self.open().is_some_and(goes_on) {
                if mark == b'.'
                    && let Some(to) = address(line, at)
                {
                    self.end_of_connection(line, Span::new(at, to));
                    return to;
                }
                if let Some(found) = self.time_at(line, at) {
                    self.close();
                    if self.time.is_none() {
                        (self.time, self.time_place) = (Some(found.micros), Some(Span::new(at, found.to)));
                    }
                    return found.to;
                }
            }
        }
        if line[at..].starts_with(b"16#") {
            return self.based(line, at);
        }
        let word = word(line, at);
        let (to, first) = (word.to, self.hex.len());
        // The letter before a string says what kind of string it is: b"…".
        if to - at == 1 && line[at].is_ascii_alphabetic() && matches!(line.get(to), Some(b'"' | b'\'')) {
            self.close();
            return to;
        }
        match self.token(line, at, word) {
            Token::Bytes(kind) => {
                self.join(line, at, to, first, kind);
                to
            }
            Token::Word => {
                self.forget(first);
                // What makes a number a byte: `0x84.toByte()`, `0x84_u8`, `17 hex`.
                let gap = |run: &Run| &line[run.span.to..at];
                let ends = matches!(line.get(to), Some(b'(' | b',' | b')' | b']' | b'}' | b';'));
                let of_number = |run: &Run| match gap(run) {
                    b"." | b"_" => run.marked && ends,
                    b" " => line[at..to].eq_ignore_ascii_case(b"hex"),
                    _ => false,
                };
                if let Some(run) = self.open_mut().filter(|run| of_number(run)) {
                    let parentheses = if line[to..].starts_with(b"()") { 2 } else { 0 };
                    run.span.to = to + parentheses;
                    return run.span.to;
                }
                if let Some(to) = self.slip(line, at, to) {
                    return to;
                }
                self.close();
                // The blank behind a word is missing: `Ask01 04`.
                if let Some(to) = glued(&line[at..to]).map(|length| at + length)
                    && let Some(About::Sender(sender, weight)) = words::word(&line[at..to])
                {
                    self.say(sender, weight);
                    return to;
                }
                self.last_word = Some(Span::new(at, to));
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
                    None => match words::part(&line[at..to]) {
                        Some(sender) => self.say(sender, Weight::Strong),
                        None => self.stranger(),
                    },
                }
                if is_port(&line[at..to]) {
                    self.port.clear();
                    self.port.extend_from_slice(&line[at..to]);
                }
                to
            }
        }
    }

    fn time_at(&self, line: &[u8], at: usize) -> Option<time::Found> {
        self.time_unit.and_then(|unit| time::number(line, at, unit)).or_else(|| time::at(line, at))
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
        let key = |end: &Span| (service(end.of(line)), end.of(line));
        // A server waits at a known port; a client is given one of the high ones.
        let (client, server) = (max_by_key(from, to, key), min_by_key(from, to, key));
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

    /// Takes over what was read of another line.
    fn like(&mut self, other: &Self) {
        self.hex.clone_from(&other.hex);
        self.places.clone_from(&other.places);
        self.runs.clone_from(&other.runs);
        self.port.clone_from(&other.port);
        self.breaks.clone_from(&other.breaks);
        self.decimal.clone_from(&other.decimal);
        (self.numbers, self.sender, self.both) = (other.numbers, other.sender, other.both);
        (self.words, self.slips, self.column) = (other.words, other.slips, other.column);
        (self.of_telegrams, self.of_leftovers) = (other.of_telegrams, other.of_leftovers);
    }

    /// A word that says nothing.
    fn stranger(&mut self) {
        self.close();
        self.words += 1;
        self.words_since += 1;
    }

    /// Whether what follows the open run shows its bytes as characters.
    fn is_column(&self, line: &[u8], run: &Run) -> bool {
        let rest = &line[run.span.to..];
        let wide = rest.len() > 1 && matches!(rest[1], b' ' | b'\t' | b'|');
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
                let length = 1 + column[1..].iter().take(3).take_while(|c| (0x80..0xC0).contains(*c)).count();
                let same =
                    |byte: &u8| c == byte || (!matches!(byte, b'!'..=b'~') && (*c == b'.' || *c >= 0x80));
                if !shown.next().is_some_and(same) {
                    return false;
                }
                column = &column[length..];
            }
            shown.all(|byte| *byte == b' ')
        };
        (1..=blank).any(shows)
    }
}

/// What was read.
impl Scan {
    /// Decimal numbers are not asked for.
    fn hex_only(&self) -> bool {
        self.numbers == Some(Numbers::Hex)
    }

    /// Whether the first number of a run counts the bytes behind it.
    pub fn counts(&self, run: &Run) -> bool {
        // Counts are decimal, whatever the bytes are.
        let first = self.hex[run.first];
        let count = if run.hex {
            first / 16 * 10 + first % 16
        } else {
            self.decimal.get(run.first).copied().unwrap_or_default()
        };
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
            !self.hex_only() && run.decimal && (!run.hex || numbers == Numbers::Decimal) && !run.marked;
        &(if decimal { &self.decimal } else { &self.hex })[run.first..run.end]
    }

    /// The bytes of `run` read as decimal numbers, if they can be.
    pub fn decimal_bytes(&self, run: &Run) -> Option<&[u8]> {
        // Who writes 01 means hex, unless other numbers of the list have a mark.
        let meant = !run.hex || !run.padded || run.marked;
        (run.decimal && meant && !self.hex_only()).then(|| &self.decimal[run.first..run.end])
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

    /// The numbers of a line that stand behind running ones, with another sign between than before the next one:
    /// `0: 17, 1: 03, 2: 00`.
    pub fn behind_indices(&self, line: &[u8]) -> Option<impl Iterator<Item = usize> + use<>> {
        /// Fewer are no list.
        const LEAST: usize = 5;
        let number = |at: usize| decimal(self.places.get(at)?.of(line));
        let runs = |at: usize| {
            let first = number(at).filter(|first| *first < 2)?;
            let gap = |at: usize| Some(&line[self.places.get(at)?.to..self.places.get(at + 1)?.from]);
            if gap(at) == gap(at + 1) {
                return None;
            }
            let pairs = 0..self.places.len().saturating_sub(at) / 2;
            let count = pairs.take_while(|nth| number(at + 2 * nth) == Some(first + nth)).count();
            (count >= LEAST).then_some((at + 1..at + 2 * count).step_by(2))
        };
        (0..2).find_map(runs)
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
}

/// Where a range of samples ends, as logic analysers number them: `41200-41208 UART: RX data: 01`.
fn samples(line: &[u8], at: usize) -> Option<usize> {
    const LEAST: usize = 4;
    let (first, to) = digits(line, at).filter(|(_, to)| to - at >= LEAST)?;
    let (last, to) = (line.get(to) == Some(&b'-')).then(|| digits(line, to + 1))??;
    (first < last && line.get(to) == Some(&b' ')).then_some(to)
}

/// How long the word is that has a byte glued to its end, if it may: one of two digits, and small letters.
fn glued(word: &[u8]) -> Option<usize> {
    let length = word.len().checked_sub(2).filter(|length| *length > 2)?;
    let (word, byte) = word.split_at(length);
    (is_digit(byte[0]) && byte[1].is_ascii_hexdigit() && word.iter().all(u8::is_ascii_alphabetic))
        .then_some(length)
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

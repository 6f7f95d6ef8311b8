//! Lines like one before: most lines of a log differ from another one only in their time, their counters, and their
//! bytes. They are read by comparing them, and what comes out is what [`Scan::read`] would make of them.
//!
//! A line is a pattern for others where nothing that it says can depend on the values of its numbers: its bytes are
//! hex, two digits each with the same around them (`01 03`, `0x01, 0x03`, `01h 03h`, `0103`, `"\x01\x03"`); what stands
//! before and behind them are the same words and marks; of the numbers before them, the time is read again, and the
//! others are so long that they are no bytes, or bytes whatever their value. Where more than brackets stands behind the
//! bytes, there have to be as many. A line without bytes is a pattern, too, where it is there again.

use super::{Numbers, Scan, Style};
use crate::field::{Facts, Span};
use crate::text::characters::{DIGITS, decimal, is_bits, is_digit, separator};
use crate::text::dump::has_offset;
use crate::text::words::Sender;

/// The patterns of a text.
#[derive(Debug)]
pub struct Alike {
    /// Those that were of use more often stand rather before the others.
    #[expect(clippy::vec_box, reason = "they change their places often")]
    patterns: Vec<Box<Pattern>>,
    /// How many patterns were learned since one was of use.
    idle: usize,
    /// Where the pattern is that was of use for the last line of about this length: lines that count their bytes differ
    /// in little else.
    hints: [u8; HINTS],
    /// What [`outline`] told of the last line of about this length that had no bytes and is no pattern.
    once: [usize; HINTS],
    /// The bytes of the line in hand.
    bytes: Vec<u8>,
    /// The pattern of the line that was read last.
    latest: Option<usize>,
}

const HINTS: usize = 64;

/// What a line like one before says besides its bytes and its time, where that is known.
#[derive(Clone, Copy, Debug, Default)]
pub struct Told {
    pub facts: Facts,
    pub sender: Option<Sender>,
}

/// How a line is like one before.
#[derive(Debug)]
pub enum Like<'a> {
    /// It is not.
    None,
    /// All was read of it.
    Read,
    /// Nothing but its bytes was read: the rest is as it was told before.
    Told { told: Told, bytes: &'a [u8], time: Option<i64>, pairs: Pairs, port: &'a [u8] },
}

/// Where bytes stand as pairs of hex digits at equal distances: where the first one begins, how long the mark before
/// its digits is, how wide it is with its marks, and how far it is to the next.
#[derive(Clone, Copy, Debug)]
pub struct Pairs {
    from: usize,
    mark: usize,
    width: usize,
    step: usize,
}

impl Pairs {
    pub fn places(self, count: usize) -> impl Iterator<Item = Span> {
        let begins = move |nth| self.from + nth * self.step;
        (0..count).map(move |nth| Span::new(begins(nth), begins(nth) + self.width))
    }

    /// As [`Scan::pairs`] has them.
    pub fn digits(self) -> Option<(usize, u8)> {
        Some((self.from + self.mark, u8::try_from(self.step).ok()?))
    }
}

#[derive(Debug)]
struct Pattern {
    /// What stands before the bytes: all of the line, if it has none.
    head: Head,
    /// The time in it.
    time: Option<Span>,
    /// The bytes of numbers in it that may be others.
    numbers: Vec<usize>,
    row: Option<Row>,
    scan: Scan,
    /// What was said of the bytes, where nothing that stands around them says more.
    told: Option<Told>,
}

/// How the bytes of a line stand in it.
#[derive(Debug)]
struct Row {
    /// Which of the runs they are.
    run: usize,
    pairs: Pairs,
    /// A byte as a word: what stands around its digits, and which of the characters that are; and the latter for
    /// the last byte, behind which something else stands.
    cell: [u64; 3],
    /// What stands behind the last one.
    tail: Head,
    /// How many characters the bytes have, where others cannot have more or less.
    length: Option<usize>,
}

/// What stands before or behind the bytes, where some digits may be other ones.
#[derive(Debug)]
struct Head {
    /// With a [`HOLE`] for each of these.
    text: Vec<u8>,
    /// The same in words of eight characters, the last one filled up with what stands before it, or with zeros: what
    /// they have to be, and the characters of these digits.
    words: Vec<[u64; 2]>,
}

/// Stands for any digit.
const HOLE: u8 = 0;

/// So many bytes are no time and no address.
const SHORTEST: usize = 5;

/// So much stands between two bytes at most.
const WIDEST: usize = 4;

impl Default for Alike {
    fn default() -> Self {
        let (hints, once) = ([0; HINTS], [0; HINTS]);
        Self { patterns: Vec::new(), idle: 0, hints, once, bytes: Vec::new(), latest: None }
    }
}

impl Alike {
    /// Reads a line, if it is like one before; with `told`, what was told of that one need not be read again.
    #[inline]
    pub fn read(&mut self, line: &[u8], scan: &mut Scan, told: bool) -> Like<'_> {
        let Self { patterns, bytes, hints, .. } = self;
        let mut time = None;
        let mut reads = |pattern: &Pattern| {
            bytes.clear();
            let compared = pattern.compare(line, scan, bytes);
            compared.is_some_and(|found| {
                time = found;
                (told && pattern.told.is_some()) || pattern.take_over(line, bytes, found, scan)
            })
        };
        let hint = &mut hints[line.len() % HINTS];
        if !patterns.get(usize::from(*hint)).is_some_and(|pattern| reads(pattern)) {
            let Some(place) = patterns.iter().position(|pattern| reads(pattern)) else { return Like::None };
            let before = place.saturating_sub(1);
            patterns.swap(before, place);
            *hint = before as u8;
        }
        let place = usize::from(*hint);
        (self.idle, self.latest) = (0, Some(place));
        let pattern = &self.patterns[place];
        match (pattern.told.filter(|_| told), &pattern.row) {
            (Some(mut told), Some(row)) => {
                told.facts.counted = pattern.is_counted(row, line, self.bytes.len());
                let (pairs, port) = (row.pairs, pattern.scan.port.as_slice());
                let width = (self.bytes.len() - 1) * pairs.step + pairs.width;
                told.facts.digits = pattern.scan.runs[row.run].is_of_digits(&line[pairs.from..][..width]);
                Like::Told { told, bytes: &self.bytes, time, pairs, port }
            }
            _ => Like::Read,
        }
    }

    /// Of the line that was read last, or learned, this was told, with nothing in the lines before it that could say
    /// more.
    pub fn tell(&mut self, line: &[u8], told: Told) {
        /// As [`Scan::near`] has it.
        const NEAR: usize = 32;
        let Some(pattern) = self.latest.and_then(|latest| self.patterns.get_mut(latest)) else { return };
        let table = memchr::memchr_iter(b'|', line).nth(1).is_some();
        let Pattern { row, scan, .. } = &**pattern;
        let sure = |row: &Row| scan.hex_only() || scan.runs[row.run].marked;
        let row = row.as_ref().is_some_and(|row| !row.shows_characters() && sure(row));
        if !table && row && pattern.scan.runs.len() <= NEAR {
            pattern.told = Some(told);
        }
    }

    /// `line` was read into `scan`: others may be like it.
    pub fn learn(&mut self, line: &[u8], scan: &Scan) {
        /// Request and response, of a few units or ports, each with some lengths.
        const MOST: usize = 64;
        /// Where so many were of no use, one of so many more is tried.
        const USELESS: usize = 64;
        /// Longer ones are no lines of a log, and their patterns would take memory.
        const LONGEST: usize = 1 << 12;
        self.latest = None;
        if line.len() > LONGEST || !self.comes_again(line, scan) {
            return;
        }
        if self.idle > USELESS {
            self.idle += 1;
            if !self.idle.is_multiple_of(USELESS) {
                return;
            }
            self.patterns.clear();
        }
        let Some(pattern) = Pattern::of(line, scan) else { return };
        self.idle += 1;
        if self.patterns.len() == MOST {
            self.patterns.pop();
        }
        self.latest = Some(self.patterns.len());
        self.patterns.push(Box::new(pattern));
    }

    /// Whether a line has bytes, or seems to be there again: most others are of no use.
    fn comes_again(&mut self, line: &[u8], scan: &Scan) -> bool {
        let before = &mut self.once[line.len() % HINTS];
        let own = outline(scan);
        scan.runs.iter().any(|run| run.len() >= SHORTEST) || std::mem::replace(before, own) == own
    }
}

/// A number for what a line says in words and numbers: hardly another line of its length has the same.
fn outline(scan: &Scan) -> usize {
    let last = scan.last_word.map_or(0, |word| word.from);
    scan.hex.iter().fold(scan.words + 64 * last, |sum, byte| sum.wrapping_mul(251) + usize::from(*byte))
}

impl Head {
    fn new(text: Vec<u8>) -> Self {
        let short = 8 * WORD.saturating_sub(text.len());
        let words = (0..text.len()).step_by(WORD).map(|at| {
            let word = &text[at.min(text.len().saturating_sub(WORD))..];
            let each = |of: fn(u8) -> u8| {
                word.iter().take(WORD).rev().fold(0, |word, c| word << 8 | u64::from(of(*c))) << short
            };
            [each(|c| if c == HOLE { b'0' } else { c }), each(|c| if c == HOLE { 0x0F } else { 0 })]
        });
        let words = words.collect();
        Self { text, words }
    }

    /// Whether a line begins so; what comes behind that, if it does.
    #[inline]
    fn split<'a>(&self, line: &'a [u8]) -> Option<&'a [u8]> {
        const SIXES: u64 = u64::MAX / 0xFF * 6;
        const CARRIES: u64 = u64::MAX / 0xFF * 0x10;
        let length = self.text.len();
        let (_, behind) = line.split_at_checked(length)?;
        let fits = |word: u64, [text, digits]: [u64; 2]| {
            // A digit is 30h and no more than 9; six more than that carries nothing over.
            (word ^ text) & !digits == 0 && ((word & digits) + (SIXES & digits)) & CARRIES == 0
        };
        // Lines differ rather in what stands right before the bytes.
        let fits = match self.words[..] {
            // What comes behind a short one is shifted out.
            [own] => fits(word(line, 0) << (8 * (WORD - length.min(WORD))), own),
            ref words => words
                .iter()
                .enumerate()
                .rev()
                .all(|(nth, own)| fits(word(line, (nth * WORD).min(length - WORD)), *own)),
        };
        fits.then_some(behind)
    }
}

/// So many characters are compared at a time.
const WORD: usize = 8;

/// The word of a text that begins at `at`; there are zeros behind the text.
#[inline]
fn word(text: &[u8], at: usize) -> u64 {
    let rest = &text[at..];
    match rest.first_chunk() {
        Some(word) => u64::from_le_bytes(*word),
        None => last_word(text, rest),
    }
}

/// The word of the rest of a text that is shorter.
fn last_word(text: &[u8], rest: &[u8]) -> u64 {
    match text.last_chunk() {
        Some(word) if !rest.is_empty() => u64::from_le_bytes(*word) >> (8 * (WORD - rest.len())),
        _ => rest.iter().rev().fold(0, |word, c| word << 8 | u64::from(*c)),
    }
}

impl Pattern {
    fn of(line: &[u8], scan: &Scan) -> Option<Self> {
        let longest = scan.runs.iter().enumerate().max_by_key(|(_, run)| run.len());
        let (row, end) = match longest.filter(|(_, run)| run.len() >= SHORTEST) {
            Some((index, _)) => {
                let row = Row::of(line, scan, index)?;
                let end = row.pairs.from;
                (Some(row), end)
            }
            // A number by itself may be the end of a dump.
            None if scan.words == 0 || scan.slips > 0 || line.iter().all(is_of_number) => return None,
            None if memchr::memchr2(HOLE, b'\\', line).is_some() => return None,
            None => (None, line.len()),
        };
        if scan.column || has_offset(line) {
            return None;
        }
        let mut head = line[..end].to_vec();
        let time = scan.time_place;
        if let Some(time) = time.filter(|time| time.to <= end) {
            head[time.from..time.to].iter_mut().filter(|c| is_digit(**c)).for_each(|c| *c = HOLE);
        }
        let mut at = 0;
        for part in line[..end].chunk_by(|one, next| is_digit(*one) == is_digit(*next)) {
            let number = Span::new(at, at + part.len());
            // Where decimal numbers are asked for, short ones are some by their value.
            if row.is_some() && scan.hex_only() && is_digit(part[0]) && is_free(&line[..end], number) {
                head[number.from..number.to].fill(HOLE);
            }
            at = number.to;
        }
        let first = row.as_ref().map_or(0, |row| scan.runs[row.run].first);
        let numbers = (0..first).filter(|at| head[scan.places[*at].from] == HOLE).collect();
        Some(Self { head: Head::new(head), time, numbers, row, scan: scan.clone(), told: None })
    }

    /// Compares a line with this one: its bytes and its time, if it is like it.
    fn compare(&self, line: &[u8], scan: &Scan, bytes: &mut Vec<u8>) -> Option<Option<i64>> {
        let length =
            self.row.as_ref().map_or(Some(0), |row| row.length.map(|length| length + row.tail.text.len()));
        if length.is_some_and(|length| line.len() != self.head.text.len() + length) {
            return None;
        }
        let behind = self.head.split(line)?;
        if let Some(row) = &self.row {
            row.compare(line, behind, &self.scan, bytes)?;
        }
        match self.time {
            Some(time) => {
                Some(Some(scan.time_at(line, time.from).filter(|found| found.to == time.to)?.micros))
            }
            None => Some(None),
        }
    }

    /// Takes over what was read of this line for one that is like it.
    fn take_over(&self, line: &[u8], bytes: &[u8], time: Option<i64>, scan: &mut Scan) -> bool {
        scan.like(&self.scan);
        (scan.time, scan.pairs) = (time, None);
        if self.row.as_ref().is_some_and(|row| !row.take_over(line, bytes, scan)) {
            return false;
        }
        let Scan { hex, places, .. } = scan;
        for at in &self.numbers {
            let digits = places[*at].of(line);
            hex[*at] = DIGITS[usize::from(digits[0])] * 16 + DIGITS[usize::from(digits[1])];
        }
        true
    }

    /// See [`Scan::is_counted`], for a line like this one with so many bytes.
    fn is_counted(&self, row: &Row, line: &[u8], count: usize) -> bool {
        let (run, own) = (row.run, row.length.is_some());
        let others = self.scan.runs.iter().enumerate().filter(|(at, other)| *at != run && other.tokens == 1);
        let mut counts = others.filter(|(at, _)| *at < run || own);
        counts.any(|(_, other)| decimal(other.span.of(line)) == Some(count))
    }
}

impl Row {
    /// How the bytes of a run stand in its line, which is the longest one.
    fn of(line: &[u8], scan: &Scan, index: usize) -> Option<Self> {
        let run = &scan.runs[index];
        let place = Span::new(scan.places[run.first].from, scan.places[run.end - 1].to);
        let (before, own, tail) = (&line[..place.from], place.of(line), &line[place.to..]);
        let quoted = run.style == Style::Escaped && before.len() == run.span.from + 1;
        let (mark, width, gap) = match run.style {
            Style::Contiguous if run.tokens == 1 => (0, 2, 0),
            Style::Escaped if run.tokens == 1 && quoted => (2, 4, 0),
            _ if !(1..=WIDEST).contains(&run.gap) => return None,
            Style::Separated => (0, 2, run.gap),
            Style::Prefixed => (2, 4, run.gap),
            Style::Suffixed => (0, 3, run.gap),
            Style::Contiguous | Style::Escaped => return None,
        };
        let step = width + gap;
        let even = (run.tokens == run.len() || gap == 0)
            && run.breaks.is_empty()
            && run.span.len() == own.len() + if quoted { 2 } else { 0 }
            && own.len() + gap == run.len() * step;
        let marks = || match mark {
            0 => true,
            _ => [b"0x", b"\\x"].iter().any(|mark| own.chunks(step).all(|byte| byte.starts_with(*mark))),
        };
        let decimal = scan.numbers == Some(Numbers::Decimal);
        if !even
            || !(if run.marked { marks() } else { !decimal })
            || scan.slips > usize::from(counts(scan, index))
        {
            return None;
        }
        let gap = &own[width..step];
        let plain = tail.iter().all(|c| c.is_ascii_whitespace() || matches!(c, b']' | b')' | b'}' | b'>'));
        let words = scan.runs.len() == index + 1
            && !tail.iter().any(|c| is_digit(*c))
            && !shows_characters(tail, gap.len());
        let length = (!plain && !words).then_some(own.len());
        // What could be decimal may go on with other numbers, by its value; and it may be below zero, or in a table.
        let sure = run.marked || gap.is_empty() || scan.hex_only();
        if !sure && (length.is_some() || gap.contains(&b'-') || line.contains(&b'|')) {
            return None;
        }
        // What could be one number with the first byte.
        let apart = match before {
            [.., a, b':' | b'/'] => !is_digit(*a),
            [.., c] => !matches!(c, b'-' | b'.' | b'#'),
            [] => true,
        };
        // A date may go on as a time.
        let time = scan.time_place;
        let date = time.filter(|time| time.from < place.from).is_some_and(|time| time.to + 4 > place.from)
            && gap.first() != Some(&b' ');
        let other = scan.runs[..index].last().map(|other| &before[other.span.to..]);
        let joins = !quoted && other.is_some_and(|between| separator(between).is_some());
        // Others with so many bytes may be shown as characters behind them, and a backslash makes bytes of characters.
        let others = scan.runs.iter().filter(|run| run.len() >= SHORTEST).count() > 1
            || before.iter().chain(tail).any(|c| matches!(*c, HOLE | b'\\'));
        if !apart || date || joins || others || gap.first() == Some(&b'#') {
            return None;
        }
        let signs = |from: usize, to: usize| (from..to).fold(0, |signs, at| signs | 0xFF << (8 * at));
        let marks = signs(0, mark) | signs(mark + 2, width);
        let cell = [word(&own[..step], 0), marks | signs(width, step), marks];
        let mut tail = tail.to_vec();
        if let Some(time) = time.filter(|time| time.from >= place.to) {
            let time = Span::new(time.from - place.to, time.to - place.to);
            tail[time.from..time.to].iter_mut().filter(|c| is_digit(**c)).for_each(|c| *c = HOLE);
        }
        let pairs = Pairs { from: place.from, mark, width, step };
        let row = Self { run: index, pairs, cell, tail: Head::new(tail), length };
        // What stands between its bytes may differ.
        row.compare(line, &line[place.from..], scan, &mut Vec::new()).map(|()| row)
    }

    /// Compares the bytes of a line and what stands behind them; `behind` begins with them.
    #[inline]
    fn compare(&self, line: &[u8], behind: &[u8], scan: &Scan, bytes: &mut Vec<u8>) -> Option<()> {
        let Self { pairs: Pairs { from, mark, width, step }, cell: [text, around, at_end], tail, .. } = self;
        let (own, behind) = behind.split_at_checked(behind.len().checked_sub(tail.text.len())?)?;
        tail.split(behind)?;
        let whole = own.len() + step - width;
        let count = whole / step;
        let by_value = match (step, width) {
            (2, _) => is_value(own),
            (_, 3) => own.chunks(*step).any(is_word),
            _ => false,
        };
        if whole % step != 0 || count < SHORTEST || by_value {
            return None;
        }
        let (mut all, mut differs) = (0, 0);
        let mut byte = |cell: u64, around: u64| {
            differs |= (cell ^ text) & around;
            let digits = cell >> (8 * mark);
            let [high, low] = [digits, digits >> 8].map(|digit| DIGITS[usize::from(digit as u8)]);
            all |= high | low;
            high.wrapping_mul(16).wrapping_add(low)
        };
        bytes.resize(count, 0);
        let (last, others) = bytes.split_last_mut()?;
        let mut at = *from;
        for place in others {
            *place = byte(word(line, at), *around);
            at += step;
        }
        *last = byte(word(line, at), *at_end);
        // What stands behind them may go on with them.
        let run = &scan.runs[self.run];
        let padded = || bytes.iter().any(|byte| *byte < 0x10) && !run.marked;
        let odd = self.length.is_some() && step > width && run.padded != padded();
        (differs == 0 && all <= 15 && !odd).then_some(())
    }

    /// Takes over the bytes; `false` if something else is to be made of them.
    fn take_over(&self, line: &[u8], bytes: &[u8], scan: &mut Scan) -> bool {
        let Self { pairs, run, length, .. } = self;
        let hex_only = scan.hex_only();
        let Scan { hex, decimal, places, runs, .. } = scan;
        let run = &mut runs[*run];
        let (first, end) = (run.first, run.first + bytes.len());
        match length {
            Some(_) => hex[first..end].copy_from_slice(bytes),
            None => {
                hex.truncate(first);
                hex.extend_from_slice(bytes);
                places.truncate(first);
                places.extend(pairs.places(bytes.len()));
            }
        }
        if !hex_only {
            // A byte with a mark is the same in a list of decimal numbers.
            let value = |byte: &u8| match (run.marked, run.style) {
                (true, _) => *byte,
                (_, Style::Contiguous) => 0,
                _ => byte / 16 * 10 + byte % 16,
            };
            decimal.resize(hex.len(), 0);
            decimal[first..end].iter_mut().zip(bytes).for_each(|(decimal, byte)| *decimal = value(byte));
        }
        run.span.to = run.span.to + bytes.len() * pairs.step - run.len() * pairs.step;
        run.end = end;
        if pairs.step > pairs.width {
            (run.tokens, run.since, run.last) = (bytes.len(), bytes.len(), end - 1);
            run.padded = bytes.iter().any(|byte| *byte < 0x10) && !run.marked;
            run.decimal = run.marked || !hex_only && bytes.iter().all(|byte| *byte < 0xA0 && byte % 16 < 10);
        }
        scan.pairs = pairs.digits();
        // What stands behind them may show them as characters.
        length.is_none() || !scan.is_column(line, &scan.runs[self.run])
    }

    /// Whether what stands behind the bytes could show them as characters.
    fn shows_characters(&self) -> bool {
        self.length.is_some() && shows_characters(&self.tail.text, self.pairs.step - self.pairs.width)
    }
}

/// Whether a sign can be one of a number that is all of its line.
fn is_of_number(c: &u8) -> bool {
    c.is_ascii_hexdigit() || c.is_ascii_whitespace() || *c == b'+'
}

/// Whether the first number of a line counts lines, before those of the run `index`: it has an odd number of digits, so
/// that it looks like a slip, whatever they are.
fn counts(scan: &Scan, index: usize) -> bool {
    let first = &scan.runs[0];
    let digits = first.span.len();
    index > 0
        && scan.hex_only()
        && first.tokens == 1
        && !first.marked
        && digits > 2
        && !digits.is_multiple_of(2)
}

/// Whether what stands behind bytes, which have such a gap between them, may show them as characters.
fn shows_characters(tail: &[u8], gap: usize) -> bool {
    let wide = matches!(tail.get(1), Some(b' ' | b'\t' | b'|')) && gap < 2;
    wide || tail.first() == Some(&b'|')
}

/// Whether two hex digits with an h behind them are a word: "ach".
fn is_word(byte: &[u8]) -> bool {
    let digits = &byte[..byte.len().min(2)];
    !digits.iter().any(|c| is_digit(*c)) && !digits.iter().all(u8::is_ascii_uppercase)
}

/// Whether hex digits are a word or the bits of a number, by their value.
fn is_value(digits: &[u8]) -> bool {
    !digits.iter().any(|c| is_digit(*c)) || is_bits(digits)
}

/// Whether a number says the same of its line whatever its value is.
fn is_free(line: &[u8], number: Span) -> bool {
    let alone = |c: Option<&u8>| c.is_none_or(|c| !c.is_ascii_alphanumeric() && *c < 0x80);
    let mark = |c: &u8| matches!(c, b':' | b'-' | b'/' | b'.');
    let (before, behind) = (&line[..number.from], &line[number.to..]);
    // Times, dates and addresses have more digits behind a mark.
    let goes_on = match behind {
        [c, next, ..] => mark(c) && is_digit(*next),
        _ => false,
    };
    let went_on = match before {
        [.., last, c] => mark(c) && (is_digit(*last) || *c == b'-'),
        _ => before.last().is_some_and(mark),
    };
    number.len() > 2
        && !is_bits(number.of(line))
        && !matches!(number.len(), 8 | 16 | 32)
        && alone(before.last())
        && alone(behind.first())
        && !goes_on
        && !went_on
        && behind.first() != Some(&b'#')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::line::Start;

    /// All that a scan tells of its line.
    fn told(scan: &Scan) -> String {
        let Scan { hex, places, runs, breaks, time, words, slips, column, sender, both, port, .. } = scan;
        let (telegrams, leftovers) = (scan.of_telegrams, scan.of_leftovers);
        let decimal: Vec<_> = runs.iter().map(|run| scan.decimal_bytes(run)).collect();
        format!(
            "{hex:?} {decimal:?} {places:?} {runs:?} {breaks:?} {time:?} {words} {slips} {column} {sender:?} {both} \
             {port:?} {telegrams} {leftovers}"
        )
    }

    /// Whether `second` is read by comparing it with `first`; if so, all is as if it were read by itself.
    fn is_like(first: &str, second: &str, numbers: Option<Numbers>) -> bool {
        let (mut alike, mut scan) = (Alike::default(), Scan::default());
        scan.read(first.as_bytes(), Start::default(), numbers);
        // A line without bytes is learned when it is there again.
        alike.learn(first.as_bytes(), &scan);
        alike.learn(first.as_bytes(), &scan);
        let like = matches!(alike.read(second.as_bytes(), &mut scan, false), Like::Read);
        if like {
            let mut alone = Scan::default();
            alone.read(second.as_bytes(), Start::default(), numbers);
            assert_eq!(told(&scan), told(&alone), "{first} {second}");
        }
        like
    }

    #[test]
    fn lines_that_differ_in_their_numbers() {
        for (first, second) in [
            ("01 03 00 C8 00 03 84 35", "11 10 0F FF 00"),
            ("TX: 01 03 00 C8 00 03", "TX: FF FF FF FF FF FF FF FF FF"),
            ("09:30:05.123 TX: 01 03 00 C8 00 03", "23:59:59.999 TX: 11 10 0F FF 00"),
            ("2026-03-02 09:30:05 [x] 01-03-00-c8-00-03", "2027-12-31 23:59:59 [x] 81-03-1f-c8-00"),
            ("000017-Tx:01 03 00 C8 00 03 84 35", "000958-Tx:81 03 02 C0 F1"),
            ("id 12345 rx 01  03  00  C8  00", "id 99999 rx 21  03  1A  C8  00"),
            ("[01][03][00][C8][00][03]", "[81][03][1F][C8][00][03][04]"),
            ("<01><03><00><C8><00><03>", "<81><03><1F><C8><00><03><04>"),
            (">>> 01:03:00:C8:00:03  ", ">>> 10:15:20:30:40:50:16  "),
            (
                "10.0.0.7:49152 -> 10.0.0.1:502 01 03 00 C8 00",
                "10.0.0.7:49152 -> 10.0.0.1:502 11 03 10 C8 00",
            ),
            (":010300C800032D", ":8103020F1234567890"),
            ("Tx=010300c800038435", "Tx=123456789012"),
            ("Raw >>> {0x01, 0x03, 0x00, 0xC8, 0x00}", "Raw >>> {0x11, 0x13, 0x20, 0xFF, 0x00, 0x01}"),
            (
                "[09:30:05] rx: 01.03.00.C8.00 (5 bytes in 12 ms)",
                "[09:30:06] rx: 81.00.1F.C8.00 (5 bytes in 12 ms)",
            ),
            ("2026-03-02 01 03 00 C8 00", "2026-03-02 11 03 00 C8 00"),
            ("TX 0x01 , 0x03 , 0x00 , 0xC8 , 0x00", "TX 0x11 , 0x13 , 0x10 , 0xC8 , 0x00 , 0x05"),
            ("id:12345 rx 01 03 00 C8 00", "id:99999 rx 21 03 1A C8 00"),
            ("2026-03-02    01:03:00:C8:00", "2026-03-02    11:04:05:10:20"),
            ("TX: 01 03 00 C8 00 Modbus", "TX: 81 13 10 C8 10 12 Modbus"),
            ("01 03 00 C8 00 at 09:30:05", "11 03 00 C8 00 at 09:30:05"),
            ("01 03 00 C8 00 03 (sent) at 09:30:05", "01 03 10 C8 10 03 (sent) at 23:59:59"),
            ("{\"data\":\"01 03 00 C8 00 03\"}", "{\"data\":\"FF 03 10 C8 00\"}"),
            ("==>  [01] [03] [00] [C8] [00]", "==>  [81] [03] [1F] [C8] [00] [03]"),
            ("rx: 0x01 0x03 0x00 0xC8 0x00, len 5", "rx: 0x11 0x13 0x10 0xC8 0x00, len 5"),
            (r#"write(3, "\x01\x03\x00\xc8\x00", 5) = 5"#, r#"write(3, "\x81\x03\x5f\x5C\x22", 5) = 5"#),
            (r"write b'\x01\x03\x00\xc8\x00'", r"write b'\x81\x03\x02\x5f\x27\x00\xc8'"),
            ("TX;01h 03h 00h C8h 00h;ok", "TX;81h 13h FFh 0ah f0h 1Fh;ok"),
            ("12345\tTX\t01 03 00 C8 00\tOK", "11011\tTX\t81 13 10 C8 10 12\tOK"),
        ] {
            assert!(is_like(first, second, Some(Numbers::Hex)), "{first}");
        }
        let marked = "rx 0x01 0x03 0x00 0xC8 0x00";
        assert!(is_like(marked, &marked.replace("C8", "1F"), None));
        for [first, second] in [
            ["TX: 01 03 00 C8 00 Modbus", "TX: 81 13 10 C8 10 12 Modbus"],
            ["TX: 01 03 00 C8 00 Modbus", "TX: 81 13 10 28 10 12 Modbus"],
            ["TX: 01 03 00 18 00 Modbus", "TX: 81 13 10 C8 10 12 Modbus"],
            ["[01][03][00][C8][00][03]", "[11][03][10][98][00][03][04]"],
            ["Tx=010300c800038435;", "Tx=110310281003;"],
        ] {
            assert!(is_like(first, second, None), "{first}");
        }
        // Milliseconds since 1970.
        assert!(is_like(
            "1775000000001 tx 01 03 00 C8 00",
            "1775999999999 tx 01 03 00 C8 00",
            Some(Numbers::Hex)
        ));
    }

    #[test]
    fn lines_whose_numbers_say_more() {
        for (first, second) in [
            // Other words, marks, and lengths.
            ("TX: 01 03 00 C8 00 03", "RX: 01 03 00 C8 00 03"),
            ("TX: 01 03 00 C8 00 03", "TX:  01 03 00 C8 00 03"),
            ("TX: 01 03 00 C8 00 03", "TX: 01 03 00-C8 00 03"),
            ("TX: 01 03 00 C8 00 03", "TX: 01 03 00 C8 00 03 (6)"),
            ("TX: 01 03 00 C8 00 03", "TX: 01 03 00 C8 00 3"),
            ("TX: 01 03 00 C8 00 03", "TX: 01 03 00 C8 00 G3"),
            ("TX: 01 03 00 C8 00 (5)", "TX: 01 03 00 C8 00 03 (5)"),
            ("01 03 00 C8 00 03 at 09:30:05", "11 03 10 C8 00 03 at 25:30:05"),
            ("TX: 30 30 31 32 33  00223", "TX: 30 30 32 32 33  00223"),
            ("TX: 01 03 00 C8 00 03", "TX: 01 03 00 C8"),
            ("TX 0x01 0x03 0x00 0xC8 0x00", "TX 0x01 0x03 0x00 0xC8 1x00"),
            ("TX 0x01 0x03 0x00 0xC8 0x00", "TX 0x01 0x03 0x00 0xC8,0x00"),
            // No time.
            ("09:30:05 TX 01 03 00 C8 00", "25:30:05 TX 01 03 00 C8 00"),
            ("2026-03-02 TX 01 03 00 C8 00", "2026-13-02 TX 01 03 00 C8 00"),
            // A word, and bits.
            ("Tx=010300c80003", "Tx=abcdefabcdef"),
            ("Tx=010300c800038435", "Tx=0101010101010101"),
            // A counter that could be bytes of the telegram, an address, an offset.
            ("5 01 03 00 C8 00", "6 11 03 00 C8 00"),
            ("COM 12: 01 03 00 C8 00", "COM 13: 01 03 00 C8 00"),
            ("0010: 01 03 00 C8 00", "0020: 01 03 00 C8 00"),
            ("x -01 03 00 C8 00", "x -16 03 00 C8 00"),
            ("x -12345 rx 01 03 00 C8 00", "x -67890 rx 01 03 00 C8 00"),
            (r"\x01 01 03 00 C8 00", r"\x02 01 03 00 C8 00"),
            ("2026-03-02 01:03:00:C8:00", "2026-03-02 11:04:05:10:20"),
            ("2026-03-02   01:03:00:C8:00", "2026-03-02   11:04:05:10:20"),
            ("TX 01 03 00 C8 00 RX 01 03 00 C8 00 05", "TX 01 03 00 C8 00 RX 11 13 10 C8 00 05"),
            ("x 1:12345 rx 01 03 00 C8 00", "x 1:99999 rx 01 03 00 C8 00"),
            ("192.168.1.2 rx 01 03 00 C8 00", "392.168.1.2 rx 01 03 00 C8 00"),
            ("TX 01, 03, 00, C8, 00", "TX 01,:03,:00,:C8,:00"),
            ("TX 01, 03, 00, C8, 00", "TX 01; 03; 00; C8; 00"),
            // Other marks between the bytes of the first.
            ("TX 01 03,00 C8 00 03", "TX 01 03 00 C8 00 03"),
            ("TX 01 03 00 C8,00", "TX 01 03 00 C8 00"),
            ("TX 08: 01 03 00 C8 00", "TX 08 01 03 00 C8 00"),
            ("TX 01   03   00   C8   00", "TX 01 , 03 , 00 , C8 , 00"),
            ("TX 0103 00C8 0003", "TX 010300C80003"),
            ("TX 0x01 , 0x03 , 0x00 , 0xC8 , 0x00", "TX 0x01 ; 0x03 ; 0x00 ; 0xC8 ; 0x00"),
            (r#"write(3, "\x01\x03\x00\xc8\x00", 5) = 5"#, r#"write(3, "\x81\x03\x5f\x5C\x22\x00", 6) = 6"#),
            (r"write b'\x01\x03\x00\xc8\x00'", r"write b'\x81\x03\x02A\x27\x00\xc8'"),
            (r"write b'\x01\x03\x00\xc8\x00'", r"write b'\x81\x03\x02\x41\x27\x00\xcg'"),
            ("TX;01h 03h 00h C8h 00h;ok", "TX;81h 13h ffh 0ah 10h 1Fh;ok"),
            ("TX;01h 03h 00h C8h 00h;ok", "TX;81h 13h 00h fFh 10h 1Fh;ok"),
            ("TX;01h 03h 00h C8h 00h;ok", "TX;81h 13h 00h 0aH 10h 1Fh;ok"),
            ("TX;01h 03h 00h C8h 00h;ok", "TX;81h 13h 00h 0ah 10h 1F;ok"),
            ("12345\tTX\t01 03 00 C8 00\tOK", "123456\tTX\t01 03 00 C8 00\tOK"),
            ("TX: 01 03 00 C8", "TX: 01 03 00 C8 00"),
            ("TX: 01 03 00 C8", "TX: 11 03 00 C8"),
        ] {
            assert!(!is_like(first, second, Some(Numbers::Hex)), "{first} {second}");
        }
        for [first, second] in [
            ["TX 01 03 00 C8 00 200", "TX 01 03 00 12 00 200"],
            ["TX 01 -03 -00 -C8 -00", "TX 01 -13 -10 -12 -10"],
            ["12345 TX 01 03 00 C8 00", "54321 TX 01 03 00 C8 00"],
            ["TX |01 03 00 C8 00", "TX |01 03 00 12 00"],
        ] {
            assert!(!is_like(first, second, None), "{first}: they could be decimal");
        }
        assert!(!is_like("TX 01 03 00 12 00", "TX 01 03 00 12 00", Some(Numbers::Decimal)));
    }

    #[test]
    fn lines_without_bytes() {
        let is_like = |first: &str, second: &str| is_like(first, second, Some(Numbers::Hex));
        for [first, second] in [
            ["Waiting for a confirmation...", "Waiting for a confirmation..."],
            ["Request at 09:30:05", "Request at 23:59:59"],
            ["[02/03/2026 09:30:05] Written data (COM8)", "[31/12/2026 23:59:59] Written data (COM8)"],
            ["09:30:05 TX 8 bytes", "09:30:06 TX 8 bytes"],
        ] {
            assert!(is_like(first, second), "{first}");
        }
        for [first, second] in [
            ["Request at 09:30:05", "Request at 25:30:05"],
            ["Request at 09:30:05", "Request at 09:30:05."],
            ["09:30:05 TX 8 bytes", "09:30:05 TX 9 bytes"],
            ["deadbeef", "deadbeef"],
            ["+0000cafe", "+0000cafe"],
            ["12345", "12345"],
            [r"\x01 is unit", r"\x01 is unit"],
        ] {
            assert!(!is_like(first, second), "{first} {second}");
        }
        let (mut alike, mut scan) = (Alike::default(), Scan::default());
        for (line, learned) in [("one more", 0), ("a wonder", 0), ("a wonder", 1)] {
            scan.read(line.as_bytes(), Start::default(), Some(Numbers::Hex));
            alike.learn(line.as_bytes(), &scan);
            assert_eq!(alike.patterns.len(), learned, "{line}");
        }
    }

    #[test]
    fn few_lines_are_kept_where_none_is_like_another() {
        let mut alike = Alike::default();
        let mut scan = Scan::default();
        for n in 0..400 {
            // A line of another kind than all before, first of 64 kinds.
            if n == 64 {
                assert_eq!(alike.patterns.len(), 64);
            }
            let line = format!("{} 01 03 00 C8 00", "x".repeat(n + 1));
            scan.read(line.as_bytes(), Start::default(), Some(Numbers::Hex));
            alike.learn(line.as_bytes(), &scan);
        }
        let heads: Vec<usize> = alike.patterns.iter().map(|pattern| pattern.head.text.len()).collect();
        assert_eq!(heads, [381], "of no use one in 64 is tried");
        let mut alike = Alike::default();
        for (before, learned) in [("txx", 1), ("txxx", 0)] {
            let line = format!("{before} {}", "01 ".repeat(1364));
            scan.read(line.as_bytes(), Start::default(), Some(Numbers::Hex));
            alike.patterns.clear();
            alike.learn(line.as_bytes(), &scan);
            assert_eq!(alike.patterns.len(), learned, "{before}");
        }
    }
}

//! Lines like one before: most lines of a log differ from another one only in their time, their counters, and their
//! bytes. They are read by comparing them, and what comes out is what [`Scan::read`] would make of them.
//!
//! A line is a pattern for others where nothing that it says can depend on the values of its numbers: its bytes are
//! hex, two digits each with the same between them, and end it; what stands before them are the same words and marks;
//! of the numbers there, the time is read again, and the others are so long that they are no bytes, or bytes whatever
//! their value.

use super::{Numbers, Scan, Style};
use crate::field::Span;
use crate::text::characters::{DIGITS, is_bits, is_digit, separator};
use crate::text::dump::has_offset;

/// The patterns of a text.
#[derive(Debug, Default)]
pub struct Alike {
    patterns: Vec<Pattern>,
    /// The one to be replaced next.
    oldest: usize,
    /// How many patterns were learned since one was of use.
    idle: usize,
}

#[derive(Debug)]
struct Pattern {
    /// What stands before the bytes, with a [`HOLE`] for each digit that may be another one.
    head: Vec<u8>,
    /// The time in it.
    time: Option<Span>,
    /// The bytes of numbers in it that may be others.
    numbers: Vec<usize>,
    /// What stands between two bytes: how much, and the first and the last of it.
    gap: usize,
    between: [u8; 2],
    /// What stands behind the last one.
    tail: Vec<u8>,
    scan: Scan,
}

/// Stands for any digit.
const HOLE: u8 = 0;

/// So many bytes are no time and no address.
const SHORTEST: usize = 5;

impl Alike {
    /// Reads a line, if it is like one before.
    pub fn read(&mut self, line: &[u8], scan: &mut Scan) -> bool {
        let read = self.patterns.iter().any(|pattern| pattern.read(line, scan));
        if read {
            self.idle = 0;
        }
        read
    }

    /// `line` was read into `scan`: others may be like it.
    pub fn learn(&mut self, line: &[u8], scan: &Scan) {
        /// Request and response, of a few units or ports.
        const MOST: usize = 8;
        /// Where so many were of no use, few more are tried.
        const USELESS: usize = 64;
        if self.idle > USELESS {
            self.idle = if self.idle > 2 * USELESS { USELESS - 1 } else { self.idle + 1 };
            return;
        }
        let Some(pattern) = Pattern::of(line, scan) else { return };
        self.idle += 1;
        if self.patterns.len() < MOST {
            return self.patterns.push(pattern);
        }
        self.patterns[self.oldest] = pattern;
        self.oldest = (self.oldest + 1) % MOST;
    }
}

impl Pattern {
    fn of(line: &[u8], scan: &Scan) -> Option<Self> {
        let run = scan.runs.last()?;
        let plain = run.hex && !run.marked && !run.single && run.style == Style::Separated;
        let even = run.len() >= SHORTEST
            && run.tokens == run.len()
            && run.breaks.is_empty()
            && (1..=2).contains(&run.gap)
            && run.span.len() == run.len() * (2 + run.gap) - run.gap;
        let known = scan.numbers == Some(Numbers::Hex) && scan.slips == 0 && !scan.column && !scan.in_row;
        if !(plain && even && known) {
            return None;
        }
        let (before, tail) = (&line[..run.span.from], &line[run.span.to..]);
        let (gap, between) = (run.gap, [line[run.second_at - run.gap], line[run.second_at - 1]]);
        let ends = tail.iter().all(|c| c.is_ascii_whitespace() || matches!(c, b']' | b')' | b'}' | b'>'));
        // What could be one number with the first byte.
        let apart = match before {
            [.., a, b':' | b'/'] => !is_digit(*a),
            [.., c] => !matches!(c, b'-' | b'.' | b'#' | b'"' | b'\'' | b':' | b'/'),
            [] => true,
        };
        // A date may go on as a time.
        let date = scan.time_place.is_some_and(|time| time.to + 4 > run.span.from) && between[0] != b' ';
        let other = scan.runs.iter().rev().nth(1).map(|other| &before[other.span.to..]);
        let joins = other.is_some_and(|between| separator(between).is_some());
        // Others with so many bytes may be shown as characters behind them, and a backslash makes bytes of characters.
        let others = scan.runs.iter().filter(|run| run.len() >= SHORTEST).count() > 1
            || before.iter().any(|c| matches!(*c, HOLE | b'\\'));
        if !(ends && apart) || date || joins || others || between[0] == b'#' || has_offset(line) {
            return None;
        }
        let mut head = before.to_vec();
        let time = scan.time_place;
        if let Some(time) = time {
            head[time.from..time.to].iter_mut().filter(|c| is_digit(**c)).for_each(|c| *c = HOLE);
        }
        let mut at = 0;
        while at < before.len() {
            let count = before[at..].iter().take_while(|c| is_digit(**c)).count();
            let number = Span::new(at, at + count);
            if time.is_none_or(|time| at < time.from || time.to < at) && is_free(before, number) {
                head[at..at + count].fill(HOLE);
            }
            at += count.max(1);
        }
        let numbers = (0..run.first).filter(|at| head[scan.places[*at].from] == HOLE).collect();
        Some(Self { head, time, numbers, gap, between, tail: tail.to_vec(), scan: scan.clone() })
    }

    fn read(&self, line: &[u8], scan: &mut Scan) -> bool {
        let Self { head, gap, between, tail, .. } = self;
        let Some((before, bytes)) = line.split_at_checked(head.len()) else { return false };
        let other = |(a, b): (&u8, &u8)| if *a == HOLE { !is_digit(*b) } else { a != b };
        if head.iter().zip(before).any(other) || !(tail.is_empty() || bytes.ends_with(tail)) {
            return false;
        }
        let length = bytes.len() - tail.len();
        let (step, whole) = (2 + gap, length + gap);
        if whole % step != 0 || whole / step < SHORTEST {
            return false;
        }
        let time = match self.time {
            Some(time) => match scan.time_at(line, time.from).filter(|found| found.to == time.to) {
                Some(found) => Some(found.micros),
                None => return false,
            },
            None => None,
        };
        scan.like(&self.scan);
        let Scan { hex, places, runs, .. } = scan;
        let Some(run) = runs.last_mut() else { return false };
        hex.truncate(run.first);
        places.truncate(run.first);
        let digits = |byte: &[u8]| [DIGITS[usize::from(byte[0])], DIGITS[usize::from(byte[1])]];
        let (count, from, first) = (whole / step, head.len(), run.first);
        let (mut good, mut padded) = (true, false);
        let (last, others) = (&bytes[length - 2..], bytes[..length].chunks_exact(step));
        hex.extend(others.map(|byte| {
            let [high, low] = digits(byte);
            good &= ((high | low) < 16) & (byte[2] == between[0]) & (byte[step - 1] == between[1]);
            padded |= high == 0;
            high << 4 | low
        }));
        let [high, low] = digits(last);
        if !good || (high | low) > 15 {
            return false;
        }
        hex.push(high << 4 | low);
        places.extend((0..count).map(|nth| Span::new(from + nth * step, from + nth * step + 2)));
        (run.end, run.last, run.span.to) = (first + count, first + count - 1, from + length);
        (run.tokens, run.since, run.padded) = (count, count, padded | (high == 0));
        for at in &self.numbers {
            let [high, low] = digits(places[*at].of(line));
            hex[*at] = high << 4 | low;
        }
        scan.time = time;
        true
    }
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

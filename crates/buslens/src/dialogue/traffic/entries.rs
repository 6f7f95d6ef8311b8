//! The telegrams that nothing changes any more, in as little room as possible: a log can have many millions.
//!
//! Of each, that are a few bytes. Its own bytes are read again from the file where they stand there as they are,
//! or as pairs of hex digits at equal distances; others are kept.

use super::entry::{Entry, Hint, NO_TIME, NOBODY, Role, Written};
use super::packed::{Packed, Rows, Words, take_bytes, take_number, write_bytes};
use super::statistics::Counts;
use crate::field::Direction;
use crate::frame::Verdict;

/// The telegrams of a log.
#[derive(Debug)]
pub struct Entries {
    /// One, and one for each reader whose telegrams were [joined](Self::join).
    parts: Vec<Part>,
    /// The last time that was told.
    time: i64,
    counts: Counts,
}

/// Telegrams as one reader packed them.
#[derive(Debug, Default)]
struct Part {
    rows: Packed<COLUMNS>,
    kept: Kept,
    /// So many of its first ones do not count.
    left_out: usize,
    /// The index of the next one among all.
    first: usize,
    shift: Shift,
}

/// How the lines and the days of one reader differ from those of all.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Shift {
    pub lines: u32,
    /// Microseconds.
    pub days: i64,
}

impl Part {
    fn len(&self) -> usize {
        self.rows.len() - self.left_out
    }

    fn row(&self, index: usize) -> Option<[u64; COLUMNS]> {
        self.rows.get(index - self.first + self.left_out)
    }
}

impl Default for Entries {
    fn default() -> Self {
        Self { parts: vec![Part::default()], time: 0, counts: Counts::default() }
    }
}

/// Time, offset, line, bytes of others before it in that, distance to its partner, port, kind, place among the
/// bytes that are kept, and how its bytes are written.
const COLUMNS: usize = 9;
const TIME: usize = 0;
const KIND: usize = 6;
const AT: usize = 7;

impl Entries {
    pub fn len(&self) -> usize {
        self.parts.last().map_or(0, |last| last.first + last.len())
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn get(&self, index: usize) -> Option<Entry> {
        let number = self.part_of(index);
        let part = &self.parts[number];
        Some(part.entry(number, index, part.row(index)?))
    }

    /// The time of an entry, if it has one.
    pub fn time(&self, index: usize) -> Option<i64> {
        let part = &self.parts[self.part_of(index)];
        let [time, kind] = part.rows.numbers(index - part.first + part.left_out, [TIME, KIND])?;
        (kind >> TIMED & 1 == 1).then_some(time as i64 + part.shift.days)
    }

    /// The number of the part that an entry is in.
    #[inline]
    fn part_of(&self, index: usize) -> usize {
        match self.parts.len() {
            1 => 0,
            _ => self.parts.partition_point(|part| part.first <= index) - 1,
        }
    }

    /// All of them in their order. That is quicker than one by one.
    pub fn iter(&self) -> Iter<'_> {
        Iter { entries: self, part: 0, rows: self.parts[0].rows.from(self.parts[0].left_out), index: 0 }
    }

    /// The bytes of an entry, if they are kept.
    pub fn kept(&self, entry: &Entry) -> Option<&[u8]> {
        let part = self.parts.get((entry.at >> PART) as usize)?;
        let at = entry.at & ((1 << PART) - 1);
        entry.written.is_none().then(|| part.kept.get(at, usize::from(entry.length)))
    }

    /// How many bytes of memory they take.
    pub fn memory(&self) -> usize {
        let kept = |part: &Part| part.kept.blocks.iter().map(Vec::capacity).sum::<usize>();
        self.parts.iter().map(|part| part.rows.memory() + kept(part)).sum()
    }

    /// Writes the telegrams before `end`, which stay as they are; that is all of what is left if nothing comes any more.
    pub(super) fn hand_over(&mut self, end: usize, words: &mut Words) {
        let ends = end >= self.len();
        for part in &mut self.parts {
            part.rows.hand_over(end, words);
            part.kept.hand_over(ends, words);
        }
    }

    /// Takes what another reader [handed over](Self::hand_over); `None` if that is cut.
    pub(super) fn take(&mut self, words: &mut &[u64]) -> Option<()> {
        let part = self.parts.last_mut()?;
        part.rows.take(words)?;
        part.kept.take(words)
    }

    /// Adds what another reader found behind its first `left_out` ones, whose lines and days differ from those here, and
    /// what it counted of all of them; what it has was taken.
    pub(super) fn join(&mut self, other: Self, counts: &Counts, left_out: usize, shift: Shift) {
        self.counts.join(counts);
        other.iter().take(left_out).for_each(|entry| self.counts.remove(&entry));
        let joined = other.parts.into_iter().next().unwrap_or_default();
        let joined = Part { left_out, first: self.len(), shift, ..joined };
        if joined.len() > 0 {
            self.parts.push(joined);
        }
    }

    pub(super) fn counts(&self) -> &Counts {
        &self.counts
    }

    pub(super) fn counts_mut(&mut self) -> &mut Counts {
        &mut self.counts
    }

    /// Adds telegrams, whose bytes lie in `data`.
    pub(super) fn extend(&mut self, mut block: &[Entry], data: &[u8]) {
        if block.is_empty() {
            return;
        }
        if self.parts.len() > 1 {
            // Those that were joined are as they are.
            self.parts.push(Part { first: self.len(), ..Part::default() });
        }
        let Self { parts, time, counts } = self;
        let Some(part) = parts.last_mut() else { return };
        while let Some(first) = block.first() {
            let (run, rest) = block.split_at(run(block));
            let at = match first.written {
                Some(_) => part.kept.end(),
                None => part.kept.push(all_bytes(run, data)),
            };
            for entry in run {
                counts.add(entry);
                // Where no time is told, the one before needs no room.
                if entry.time != NO_TIME {
                    *time = entry.time;
                }
                let behind = if first.written.is_some() { 0 } else { entry.at - first.at };
                let index = part.first + part.rows.len();
                pack(part.rows.next(), index, entry, at + behind, *time);
            }
            block = rest;
        }
    }

    /// Another partner, or who speaks, turned out to be another. Its bytes stay where they are.
    pub(super) fn set(&mut self, index: usize, entry: &Entry) {
        let number = self.part_of(index);
        let part = &mut self.parts[number];
        if let Some(row) = part.row(index) {
            let before = part.entry(number, index, row);
            let line = entry.line.wrapping_sub(part.shift.lines);
            let own = Entry { line: if entry.line == 0 { 0 } else { line }, ..*entry };
            let mut packed = row;
            pack(&mut packed, index, &own, row[AT], row[TIME] as i64);
            part.rows.set(index - part.first + part.left_out, packed);
            self.counts.replace(&before, entry);
        }
    }
}

/// An entry's place among the bytes that are kept has so many bits below the number of its part.
const PART: u32 = 48;

impl Part {
    /// The entry in a row; this is part `number`.
    #[inline]
    fn entry(&self, number: usize, index: usize, row: [u64; COLUMNS]) -> Entry {
        let entry = unpack(index, row);
        if number == 0 {
            return entry;
        }
        Entry {
            time: if entry.time == NO_TIME { NO_TIME } else { entry.time + self.shift.days },
            line: if entry.line == 0 { 0 } else { entry.line.wrapping_add(self.shift.lines) },
            at: entry.at | (number as u64) << PART,
            ..entry
        }
    }
}

impl PartialEq for Entries {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl<'a> IntoIterator for &'a Entries {
    type Item = Entry;
    type IntoIter = Iter<'a>;

    fn into_iter(self) -> Iter<'a> {
        self.iter()
    }
}

/// The telegrams of [`Entries`].
#[derive(Clone)]
pub struct Iter<'a> {
    entries: &'a Entries,
    /// The number of the part at hand, and what comes of it.
    part: usize,
    rows: Rows<'a, COLUMNS>,
    index: usize,
}

impl Iterator for Iter<'_> {
    type Item = Entry;

    #[inline]
    fn next(&mut self) -> Option<Entry> {
        let row = match self.rows.next() {
            Some(row) => row,
            None => self.next_part()?,
        };
        let entry = self.entries.parts[self.part].entry(self.part, self.index, row);
        self.index += 1;
        Some(entry)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.entries.len() - self.index;
        (left, Some(left))
    }
}

impl Iter<'_> {
    /// The first row of the next part, of which each has some but the first.
    #[cold]
    fn next_part(&mut self) -> Option<[u64; COLUMNS]> {
        let part = self.entries.parts.get(self.part + 1)?;
        self.part += 1;
        self.rows = part.rows.from(part.left_out);
        self.rows.next()
    }
}

impl ExactSizeIterator for Iter<'_> {}

/// How many entries at the beginning of a block, of which there is one, are not kept, or are kept and lie one behind the
/// other.
fn run(block: &[Entry]) -> usize {
    let first = &block[0];
    let end = first.at + Kept::MOST;
    let goes_on = |pair: &[Entry]| match (pair[0].written, pair[1].written) {
        (Some(_), Some(_)) => true,
        (None, None) => pair[0].end() == pair[1].at && pair[1].end() <= end,
        _ => false,
    };
    1 + block.windows(2).take_while(|pair| goes_on(pair)).count()
}

/// The bytes of entries that lie one behind the other.
fn all_bytes<'a>(run: &[Entry], data: &'a [u8]) -> &'a [u8] {
    let end = run.last().map_or(0, Entry::end);
    data.get(run[0].at as usize..end as usize).unwrap_or_default()
}

/// Bytes in blocks of which each is allocated once.
#[derive(Debug, Default)]
struct Kept {
    blocks: Vec<Vec<u8>>,
    /// So many blocks before them were handed over.
    gone: usize,
}

impl Kept {
    const BLOCK: usize = 1 << 17;

    /// So many are kept at a time: no entry has more.
    const MOST: u64 = u16::MAX as u64;

    /// Where the next bytes would be.
    fn end(&self) -> u64 {
        let before = (self.gone + self.blocks.len()).saturating_sub(1) * Self::BLOCK;
        (before + self.blocks.last().map_or(0, Vec::len)) as u64
    }

    /// Keeps bytes; returns where.
    fn push(&mut self, bytes: &[u8]) -> u64 {
        if self.blocks.last().is_none_or(|last| last.len() + bytes.len() > Self::BLOCK) {
            // Few logs have more than one.
            self.blocks.push(if self.blocks.is_empty() {
                Vec::new()
            } else {
                Vec::with_capacity(Self::BLOCK)
            });
        }
        let at = self.end();
        if let Some(last) = self.blocks.last_mut() {
            last.extend_from_slice(bytes);
        }
        at
    }

    fn get(&self, at: u64, length: usize) -> &[u8] {
        let (block, at) = (at as usize / Self::BLOCK, at as usize % Self::BLOCK);
        let block = self.blocks.get(block.wrapping_sub(self.gone));
        block.and_then(|block| block.get(at..at + length)).unwrap_or_default()
    }

    /// Writes the blocks that are full, which are gone then, or all of them.
    fn hand_over(&mut self, all: bool, words: &mut Words) {
        let blocks = if all { self.blocks.len() } else { self.blocks.len().saturating_sub(1) };
        words.push(blocks as u64);
        for block in self.blocks.drain(..blocks) {
            write_bytes(words, &block);
        }
        self.gone += blocks;
    }

    /// Takes what another one [handed over](Self::hand_over), behind what came before it.
    fn take(&mut self, words: &mut &[u64]) -> Option<()> {
        for _ in 0..take_number(words)? {
            self.blocks.push(take_bytes(words)?);
        }
        Some(())
    }
}

/// Writes an entry as numbers that are small, or much like those of its neighbours.
#[inline]
fn pack(row: &mut [u64; COLUMNS], index: usize, entry: &Entry, at: u64, time: i64) {
    let partner = match entry.partner {
        NOBODY => 0,
        // Those behind it are even.
        partner => match i64::from(partner) - index as i64 {
            behind @ 1.. => 2 * behind as u64,
            before => 2 * before.unsigned_abs() + 1,
        },
    };
    let written = entry.written.map_or(0, |written| (u64::from(written.from) << 8) + u64::from(written.step));
    // One by one: what is put together elsewhere is waited for when it is copied.
    row[TIME] = time as u64;
    row[1] = entry.offset;
    row[2] = entry.line.into();
    row[3] = entry.skip.into();
    row[4] = partner;
    row[5] = entry.port.into();
    row[KIND] = kind(entry);
    row[AT] = at;
    row[8] = written;
}

fn unpack(index: usize, row: [u64; COLUMNS]) -> Entry {
    let [time, offset, line, skip, partner, port, kind, at, written] = row;
    let bit = |at: u32| kind >> at & 1 == 1;
    let number = |at: u32, bits: u32| (kind >> at) as usize & ((1 << bits) - 1);
    Entry {
        time: if bit(TIMED) { time as i64 } else { NO_TIME },
        at,
        offset,
        written: (written != 0).then_some(Written { from: (written >> 8) as u32, step: written as u8 }),
        line: line as u32,
        skip: skip as u16,
        length: (kind >> 25) as u16,
        partner: match partner {
            0 => NOBODY,
            odd if odd % 2 == 1 => (index as u64 - odd / 2) as u32,
            even => (index as u64 + even / 2) as u32,
        },
        port: port as u16,
        protocol: number(45, 4) as u8,
        unit: bit(44).then_some((kind >> 9) as u8),
        function: (kind >> 17) as u8,
        verdict: VERDICTS[number(41, 2)],
        direction: if bit(0) { Direction::Response } else { Direction::Request },
        role: ROLES[number(3, 3)],
        sides: [bit(1), bit(2)],
        hint: HINTS[number(6, 3)],
    }
}

/// All that many entries have in common; what differs more often has the lower bits.
fn kind(entry: &Entry) -> u64 {
    let hint = match entry.hint {
        Hint::None => 0,
        Hint::Says(Direction::Request) => 1,
        Hint::Says(Direction::Response) => 2,
        Hint::Logger => 3,
        Hint::Other => 4,
    };
    u64::from(entry.direction == Direction::Response)
        + (u64::from(entry.sides[0]) << 1)
        + (u64::from(entry.sides[1]) << 2)
        + ((entry.role as u64) << 3)
        + (hint << 6)
        + (u64::from(entry.unit.unwrap_or_default()) << 9)
        + (u64::from(entry.function) << 17)
        + (u64::from(entry.length) << 25)
        + ((entry.verdict as u64) << 41)
        + (u64::from(entry.time != NO_TIME) << TIMED)
        + (u64::from(entry.unit.is_some()) << 44)
        + (u64::from(entry.protocol) << 45)
}

/// The bit of what has a time.
const TIMED: u32 = 43;

/// By their numbers.
const VERDICTS: [Verdict; 4] = [Verdict::Right, Verdict::Wrong, Verdict::Unchecked, Verdict::NoCheck];

/// By their numbers.
const ROLES: [Role; 8] = [
    Role::Plain,
    Role::Echo,
    Role::Retry,
    Role::Copy,
    Role::Broadcast,
    Role::Late,
    Role::Unasked,
    Role::Discarded,
];

/// By the numbers that [`kind`] gives them; the last three have none.
const HINTS: [Hint; 8] = [
    Hint::None,
    Hint::Says(Direction::Request),
    Hint::Says(Direction::Response),
    Hint::Logger,
    Hint::Other,
    Hint::None,
    Hint::None,
    Hint::None,
];

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(n: u32) -> Entry {
        let pick = |of: u32| n.wrapping_mul(2_654_435_761) >> 16 & (of - 1);
        Entry {
            time: if n.is_multiple_of(7) { NO_TIME } else { i64::from(n) * 1000 - 5_000_000 },
            at: 0,
            offset: (1 << 33) + u64::from(n) * 70,
            written: n.is_multiple_of(3).then_some(Written { from: n, step: 3 }),
            line: n + 1,
            skip: pick(4) as u16,
            length: 3 + pick(64) as u16,
            partner: [NOBODY, n + 1 + pick(8), n.saturating_sub(1)][n as usize % 3],
            port: pick(2) as u16,
            protocol: pick(8) as u8,
            unit: (pick(16) > 2).then_some(n as u8),
            function: pick(128) as u8,
            verdict: VERDICTS[pick(4) as usize],
            direction: [Direction::Request, Direction::Response][pick(2) as usize],
            role: ROLES[pick(8) as usize],
            sides: [pick(2) == 0, pick(4) == 0],
            hint: HINTS[n as usize % 5],
        }
    }

    #[test]
    fn entries_come_back_with_their_bytes() {
        let mut entries = Entries::default();
        let bytes = |n: u32| vec![n as u8; usize::from(entry(n).length)];
        (1..30_000).for_each(|n| entries.extend(&[entry(n)], &bytes(n)));
        assert_eq!(entries.len(), 29_999);
        for (n, found) in (1..).zip(&entries) {
            // Whoever is first has nobody before.
            let partner = if entry(n).partner == n - 1 { NOBODY } else { entry(n).partner };
            let same = if found.partner == n - 1 { NOBODY } else { found.partner };
            assert_eq!(Entry { at: 0, partner: same, ..found }, Entry { partner, ..entry(n) });
            assert_eq!(entries.kept(&found), (n % 3 > 0).then_some(&bytes(n)[..]));
            assert_eq!(entries.get(n as usize - 1), Some(found));
        }
        assert_eq!(entries.iter().len(), 29_999);
        let of_bytes: usize = (1..30_000).filter(|n| n % 3 > 0).map(|n| bytes(n).len()).sum();
        assert!((of_bytes..of_bytes * 5 / 2).contains(&entries.memory()), "{of_bytes} {}", entries.memory());
    }

    #[test]
    fn an_entry_finds_its_partner_later() {
        let mut entries = Entries::default();
        (1..3000).for_each(|n| entries.extend(&[entry(n)], &[]));
        let before = entries.get(20).unwrap();
        // Among the bytes in hand it was elsewhere.
        entries.set(20, &Entry { partner: 2900, sides: [true, false], at: before.at + 7, ..before });
        let after = entries.get(20).unwrap();
        assert_eq!((after.partner(), after.sides), (Some(2900), [true, false]));
        assert_eq!(Entry { partner: before.partner, sides: before.sides, ..after }, before);
    }
}

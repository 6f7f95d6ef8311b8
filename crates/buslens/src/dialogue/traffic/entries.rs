//! The telegrams that nothing changes any more, in as little room as possible: a log can have many millions.
//!
//! Of each, that are a few bytes. Its own bytes are read again from the file where they stand there as they are,
//! or as pairs of hex digits at equal distances; others are kept.

use super::entry::{Entry, Hint, NO_TIME, NOBODY, Role, Written};
use super::packed::{Packed, Rows};
use super::statistics::Counts;
use crate::field::Direction;
use crate::frame::Verdict;

/// The telegrams of a log.
#[derive(Debug, Default)]
pub struct Entries {
    rows: Packed<COLUMNS>,
    kept: Kept,
    /// The last time that was told.
    time: i64,
    counts: Counts,
}

/// Time, offset, line, bytes of others before it in that, distance to its partner, port, kind, place among the
/// bytes that are kept, and how its bytes are written.
const COLUMNS: usize = 9;
const TIME: usize = 0;
const KIND: usize = 6;
const AT: usize = 7;

impl Entries {
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn get(&self, index: usize) -> Option<Entry> {
        Some(unpack(index, self.rows.get(index)?))
    }

    /// The time of an entry, if it has one.
    pub fn time(&self, index: usize) -> Option<i64> {
        let [time, kind] = self.rows.numbers(index, [TIME, KIND])?;
        (kind >> TIMED & 1 == 1).then_some(time as i64)
    }

    /// All of them in their order. That is quicker than one by one.
    pub fn iter(&self) -> Iter<'_> {
        Iter { rows: self.rows.iter(), index: 0 }
    }

    /// Those from `index` on, of which there is at least that.
    pub(super) fn from(&self, index: usize) -> Iter<'_> {
        Iter { rows: self.rows.from(index), index }
    }

    /// The bytes of an entry, if they are kept.
    pub fn kept(&self, entry: &Entry) -> Option<&[u8]> {
        entry.written.is_none().then(|| self.kept.get(entry.at, usize::from(entry.length)))
    }

    /// How many bytes of memory they take.
    pub fn memory(&self) -> usize {
        self.rows.memory() + self.kept.blocks.iter().map(Vec::capacity).sum::<usize>()
    }

    pub(super) fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Adds telegrams, whose bytes lie in `data`.
    pub(super) fn extend(&mut self, mut block: &[Entry], data: &[u8]) {
        while let Some(first) = block.first() {
            let (run, rest) = block.split_at(run(block));
            let at = match first.written {
                Some(_) => self.kept.end(),
                None => self.kept.push(all_bytes(run, data)),
            };
            for entry in run {
                self.counts.add(entry);
                // Where no time is told, the one before needs no room.
                if entry.time != NO_TIME {
                    self.time = entry.time;
                }
                let behind = if first.written.is_some() { 0 } else { entry.at - first.at };
                let index = self.rows.len();
                pack(self.rows.next(), index, entry, at + behind, self.time);
            }
            block = rest;
        }
    }

    /// Another partner, or who speaks, turned out to be another. Its bytes stay where they are.
    pub(super) fn set(&mut self, index: usize, entry: &Entry) {
        if let Some(before) = self.rows.get(index) {
            let mut row = before;
            pack(&mut row, index, entry, before[AT], before[TIME] as i64);
            self.rows.set(index, row);
            self.counts.replace(&unpack(index, before), entry);
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
    rows: Rows<'a, COLUMNS>,
    index: usize,
}

impl Iterator for Iter<'_> {
    type Item = Entry;

    #[inline]
    fn next(&mut self) -> Option<Entry> {
        let entry = unpack(self.index, self.rows.next()?);
        self.index += 1;
        Some(entry)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.rows.size_hint()
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
}

impl Kept {
    const BLOCK: usize = 1 << 17;

    /// So many are kept at a time: no entry has more.
    const MOST: u64 = u16::MAX as u64;

    /// Where the next bytes would be.
    fn end(&self) -> u64 {
        self.blocks.last().map_or(0, |last| ((self.blocks.len() - 1) * Self::BLOCK + last.len()) as u64)
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
        self.blocks.get(block).and_then(|block| block.get(at..at + length)).unwrap_or_default()
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

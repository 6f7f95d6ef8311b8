//! Large logs in slices: several readers, each of a part of the file, and the same log as one reader makes of it.
//!
//! The beginning is read by each of them, since it tells what is true for the whole log. From there on the file has
//! marks, and a reader begins one mark before its slice. Where it is alike with the reader of the slice before, all
//! that it found from there on is taken over. Else the reader before reads on until they are, in the end up to the
//! end of the file: that is quick for most logs, and right for all.
//!
//! Nothing here reads a file or starts a thread: whoever can reads each slice wherever it likes.

use std::hash::{DefaultHasher, Hash};
use std::ops::Range;

use super::{Log, SMALL, Source, Way};
use crate::dialogue::traffic::Place;

/// Where a log has its marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Division {
    /// So many bytes at least are the beginning of a log.
    pub beginning: u64,
    /// The distance from one mark to the next, at least 1.
    pub step: u64,
}

impl Division {
    /// Of a file of so many bytes: small ones have none.
    pub fn of(size: u64) -> Option<Self> {
        (size > SMALL).then_some(Self { beginning: 8 << 20, step: 1 << 20 })
    }
}

/// The marks that a log passed.
#[derive(Debug)]
pub(super) struct Passed {
    division: Division,
    /// Where the beginning ended.
    settled: Option<u64>,
    /// Each with its place in the file.
    places: Vec<(u64, Place)>,
}

impl Passed {
    pub fn new(division: Division) -> Self {
        Self { division, settled: None, places: Vec::new() }
    }

    /// The next mark behind so many bytes.
    fn next(&self, taken: u64) -> u64 {
        let Division { beginning, step } = self.division;
        (taken / step + 1).max(beginning.div_ceil(step)) * step
    }

    fn at(&self, at: u64) -> Option<&Place> {
        let place = self.places.binary_search_by_key(&at, |(at, _)| *at).ok()?;
        Some(&self.places[place].1)
    }
}

impl Log {
    /// The same with marks elsewhere, or none. Two logs with the same marks are the same, in however many slices
    /// they are read; nothing may be pushed before.
    pub fn divided(mut self, division: Option<Division>) -> Self {
        let divisible = matches!(self.input, Way::Text(_) | Way::Stream);
        self.passed = division.filter(|_| divisible).map(Passed::new);
        self
    }

    /// How many bytes of what is to be pushed come before the next mark, or end there.
    pub(super) fn before_mark(&self) -> usize {
        let next = self.passed.as_ref().map(|passed| passed.next(self.taken) - self.taken);
        next.and_then(|bytes| usize::try_from(bytes).ok()).unwrap_or(usize::MAX)
    }

    /// The file passes a mark.
    pub(super) fn pass_mark(&mut self) {
        let Self { passed: Some(passed), traffic, input, ports, .. } = self else { return };
        let line = if let Way::Text(reader) = input { reader.lines() } else { 0 };
        if passed.settled.is_none() {
            passed.settled = traffic.settle_context(line).then_some(self.taken);
        }
        if passed.settled.is_none() {
            return;
        }
        let mut hasher = DefaultHasher::new();
        if let Way::Text(reader) = input {
            reader.pass_mark();
            reader.hash_state(&mut hasher);
        }
        (&ports.names, ports.latest).hash(&mut hasher);
        traffic.pass_mark(line);
        passed.places.push((self.taken, traffic.place(line, hasher)));
    }

    /// Where its beginning ended, if it did and what comes behind that can be read in slices.
    pub fn divisible_from(&self) -> Option<u64> {
        self.passed.as_ref()?.settled
    }

    /// The slices of a file of so many bytes, at most `most`, each of at least `least` bytes. The first one begins
    /// where the log is now. There is only one before [`divisible_from`](Self::divisible_from) is known.
    pub fn slices(&self, size: u64, most: usize, least: u64) -> Vec<Range<u64>> {
        let left = size.saturating_sub(self.taken);
        let most = if self.divisible_from().is_some() { most as u64 } else { 1 };
        let count = most.min(left / least.max(1)).max(1);
        let step = self.passed.as_ref().map_or(1, |passed| passed.division.step);
        let cut = |n: u64| match n {
            0 => self.taken,
            n if n == count => size,
            n => ((u128::from(left) * u128::from(n) / u128::from(count)) as u64 + self.taken)
                .next_multiple_of(step)
                .min(size),
        };
        (0..count).map(|n| cut(n)..cut(n + 1)).filter(|slice| !slice.is_empty()).collect()
    }

    /// A log of which the beginning was read, and no more, goes on with a slice that begins at a mark; returns the
    /// place from which on it is to be pushed.
    pub fn jump(&mut self, slice: u64) -> u64 {
        let Some(passed) = &self.passed else { return self.taken };
        let from = slice.saturating_sub(passed.division.step).max(self.taken);
        self.go_on_at(from, self.lines);
        from
    }

    fn go_on_at(&mut self, at: u64, line: u32) {
        self.traffic.jump();
        if let Way::Text(reader) = &mut self.input {
            reader.jump(at, line);
        }
        self.taken = at;
    }

    /// How many bytes of the file are read.
    pub fn taken(&self) -> u64 {
        self.taken
    }
}

/// Joins what the readers of a file's slices found, in their order: `whole` has read the first one, and the last one
/// of all is [finished](Log::finish). What has to be read once more comes from `source` of `size` bytes.
pub fn join(mut whole: Log, slices: Vec<Log>, source: &dyn Source, size: u64) -> Log {
    let mut latest: Option<Joined> = None;
    for next in slices {
        loop {
            let last = latest.as_mut().map_or(&mut whole, |latest| &mut latest.log);
            if let Some(from) = last.meets(&next) {
                let from = from.clone();
                let here = match latest.take() {
                    Some(latest) => latest.hand_over(&mut whole),
                    None => whole.latest_place(),
                };
                latest = Some(Joined { log: next, from, here });
                break;
            }
            // It has read all of the next one by itself.
            if last.taken >= next.taken || !last.read_on(source, size) {
                break;
            }
        }
    }
    let last = latest.as_mut().map_or(&mut whole, |latest| &mut latest.log);
    if !last.finished {
        while last.taken < size && last.read_on(source, size) {}
        last.finish();
    }
    if let Some(latest) = latest {
        latest.finish(&mut whole);
    }
    whole
}

/// A reader whose slice goes on with what is joined already.
struct Joined {
    log: Log,
    /// The mark from which on its telegrams count.
    from: Place,
    /// The same one in the numbers of the whole.
    here: Place,
}

impl Joined {
    /// Gives what it has to the whole; returns where that ends.
    fn hand_over(self, whole: &mut Log) -> Place {
        let to = self.log.latest_place();
        whole.traffic.adopt(&self.here, &self.log.traffic, &self.from, Some(&to));
        whole.take_over(&self.log);
        self.here.moved(&self.from, &to)
    }

    /// The same at the end of the file.
    fn finish(self, whole: &mut Log) {
        let lines = match &self.log.input {
            Way::Text(reader) => self.here.lines_behind(&self.from, reader.lines()),
            _ => 0,
        };
        whole.traffic.adopt(&self.here, &self.log.traffic, &self.from, None);
        whole.take_over(&self.log);
        whole.go_on_at(self.log.taken, lines);
        whole.finish();
    }
}

impl Log {
    /// Where `next` was alike with this one at the mark where this one is now.
    fn meets<'a>(&self, next: &'a Self) -> Option<&'a Place> {
        let own = self.passed.as_ref()?.at(self.taken)?;
        let other = next.passed.as_ref()?.at(self.taken)?;
        self.traffic.is_alike(own, &next.traffic, other).then_some(other)
    }

    fn latest_place(&self) -> Place {
        let place = self.passed.as_ref().and_then(|passed| passed.places.last());
        place.map(|(_, place)| place.clone()).unwrap_or_default()
    }

    /// Reads up to the next mark; `false` if no more can be kept.
    fn read_on(&mut self, source: &dyn Source, size: u64) -> bool {
        let left = usize::try_from(size.saturating_sub(self.taken)).unwrap_or(usize::MAX);
        let part = source.read(self.taken, self.before_mark().min(left));
        !part.is_empty() && self.push(&part)
    }

    /// What is not of the traffic, of a log whose telegrams were taken over.
    fn take_over(&mut self, other: &Self) {
        self.full |= other.full;
        self.taken = other.taken;
        self.ports.clone_from(&other.ports);
    }
}

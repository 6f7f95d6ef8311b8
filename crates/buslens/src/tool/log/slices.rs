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

use super::{Log, Way, has_room};
use crate::dialogue::traffic::{Found, Place, Sums, take_bytes, write_bytes};

/// Where a log has its marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Division {
    /// So many bytes at least are the beginning of a log.
    pub beginning: u64,
    /// The distance from one mark to the next, at least 1.
    pub step: u64,
}

impl Default for Division {
    /// As large files need it.
    fn default() -> Self {
        Self { beginning: 8 << 20, step: 1 << 20 }
    }
}

/// The marks that a log passed.
#[derive(Debug)]
pub(super) struct Passed {
    division: Division,
    /// What is done at each. It stands behind a pointer so that a program that reads no slices does without it.
    mark: fn(&mut Log),
    /// Where the beginning ended.
    settled: Option<u64>,
    /// Each with its place in the file.
    places: Vec<(u64, Place)>,
}

impl Passed {
    pub fn new(division: Division) -> Self {
        Self { division, mark: Log::pass_mark, settled: None, places: Vec::new() }
    }

    pub fn mark(&self) -> fn(&mut Log) {
        self.mark
    }

    /// The next mark behind so many bytes.
    fn next(&self, taken: u64) -> u64 {
        let Division { beginning, step } = self.division;
        (taken / step + 1).max(beginning.div_ceil(step)) * step
    }
}

impl Log {
    /// The same with marks, if what it reads can have some: texts in UTF-16 and captures have none. Logs with the same
    /// marks are the same, in however many slices they are read; nothing may be pushed before.
    pub fn divided(mut self, division: Division) -> Self {
        let divisible = matches!(self.input, Way::Text(_) | Way::Stream);
        self.passed = divisible.then(|| Passed::new(division));
        self
    }

    /// How many bytes of what is to be pushed come before the next mark, or end there.
    pub(super) fn before_mark(&self) -> usize {
        usize::try_from(self.next_mark() - self.taken).unwrap_or(usize::MAX)
    }

    /// The file passes a mark.
    fn pass_mark(&mut self) {
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

    /// The slices of a file of so many bytes, at most `most`, each of about `least` bytes at least. The first one begins
    /// where the log is now, and is longer: whoever reads another one reads the beginning, too. There is only one before
    /// [`divisible_from`](Self::divisible_from) is known.
    pub fn slices(&self, size: u64, most: usize, least: u64) -> Vec<Range<u64>> {
        let left = size.saturating_sub(self.taken);
        let most = if self.divisible_from().is_some() { most as u64 } else { 1 };
        let count = most.min(left / least.max(1)).max(1);
        let step = self.passed.as_ref().map_or(1, |passed| passed.division.step);
        let again = self.taken + step;
        let share = (left + (count - 1) * again) / count;
        let cut = |n: u64| match n {
            0 => self.taken,
            n if n == count => size,
            n => {
                (self.taken + share + (n - 1) * share.saturating_sub(again)).next_multiple_of(step).min(size)
            }
        };
        (0..count).map(|n| cut(n)..cut(n + 1)).filter(|slice| !slice.is_empty()).collect()
    }

    /// A log of which the beginning was read, and no more, goes on with a slice that begins at a mark; returns the
    /// place from which on it is to be pushed.
    pub fn jump(&mut self, slice: u64) -> u64 {
        let Some(passed) = &self.passed else { return self.taken };
        let from = slice.saturating_sub(passed.division.step).max(self.taken);
        self.traffic.leave_beginning();
        self.passed.iter_mut().for_each(|passed| passed.places.clear());
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

/// A slice as its reader handed it over, piece by piece.
#[derive(Debug, Default)]
pub struct Slice {
    found: Found,
    marks: Vec<(u64, Place)>,
    /// How many bytes of the file, telegrams and lines are read.
    taken: u64,
    telegrams: u64,
    lines: u32,
    /// Once it is read to its end; with the names of ports.
    end: Option<(Sums, Vec<String>)>,
}

impl Slice {
    /// Takes the next piece that a reader [handed over](Log::hand_over); `false` if there is no memory for it, or if it
    /// is cut.
    pub fn take(&mut self, piece: &[u64]) -> bool {
        has_room() && self.take_words(piece).is_some()
    }

    fn take_words(&mut self, mut words: &[u64]) -> Option<()> {
        let [taken, telegrams, lines, marks, ends] = *words.split_off(..5)? else { return None };
        (self.taken, self.telegrams, self.lines) = (taken, telegrams, lines as u32);
        for _ in 0..marks {
            let at = *words.split_off_first()?;
            self.marks.push((at, Place::take(&mut words)?));
        }
        self.found.take(&mut words)?;
        if ends > 0 {
            let sums = Sums::take(&mut words)?;
            let mut ports = Vec::new();
            while !words.is_empty() {
                ports.push(String::from_utf8(take_bytes(&mut words)?).ok()?);
            }
            self.end = Some((sums, ports));
        }
        Some(())
    }

    /// Whether it is read to its end.
    pub fn is_whole(&self) -> bool {
        self.end.is_some()
    }

    /// Up to where in the file it is read.
    pub fn taken(&self) -> u64 {
        self.taken
    }

    /// How many telegrams are read.
    pub fn telegrams(&self) -> u64 {
        self.telegrams
    }
}

impl Log {
    /// Hands over what was found since the last time, which is not in this log any more then, as words that can go to
    /// another thread, or to another worker.
    pub fn hand_over(&mut self) -> Vec<u64> {
        self.piece(false)
    }

    /// The slice ends here, of a file of so many bytes: hands over all that is left.
    pub fn hand_over_rest(mut self, size: u64) -> Vec<u64> {
        if self.taken == size {
            self.end();
        }
        let mut words = self.piece(true);
        self.traffic.write_sums(&mut words);
        self.ports.names.iter().for_each(|name| write_bytes(&mut words, name.as_bytes()));
        words
    }

    fn piece(&mut self, ends: bool) -> Vec<u64> {
        let Self { passed, input, traffic, taken, .. } = self;
        let lines = if let Way::Text(reader) = input { reader.lines() } else { 0 };
        let marks = passed.as_mut().map(|passed| std::mem::take(&mut passed.places)).unwrap_or_default();
        let telegrams = traffic.entries().len() as u64;
        let mut words = vec![*taken, telegrams, lines.into(), marks.len() as u64, ends.into()];
        for (at, place) in &marks {
            words.push(*at);
            place.write(&mut words);
        }
        // Before the first mark nothing is settled for good.
        let first = Place::default();
        let latest = marks.last().map_or(&first, |(_, place)| place);
        traffic.hand_over(if ends { None } else { Some(latest) }, &mut words);
        words
    }

    /// Takes over what other readers found of a file of so many bytes, in the order of their slices, if that goes on at the
    /// mark where this log is now, and all of it up to the end of the file: there is nothing more to read then. Else this
    /// log is to read on up to the [next mark](Self::next_mark), where the slices may be alike with it.
    pub fn join(&mut self, slices: &mut Vec<Slice>, size: u64) -> bool {
        let Some((mut here, marks)) = self.follow(slices, size) else { return false };
        for (slice, mark) in slices.drain(..).zip(marks) {
            let Slice { found, marks, taken, lines, end: Some((sums, ports)), .. } = slice else {
                continue;
            };
            let marks = &marks[mark..];
            let ([(_, from), ..], [.., (_, to)]) = (marks, marks) else { continue };
            let lines = here.lines_behind(from, lines);
            self.traffic.adopt(&here, found, sums, marks);
            self.ports.names = ports;
            self.go_on_at(taken, lines);
            here = here.moved(from, to);
        }
        true
    }

    /// Leaves out the slices that this log has read itself, or that are not whole; tells where this log is, and at which of
    /// its marks each of the others goes on with what is before it, if all of them do.
    fn follow(&self, slices: &mut Vec<Slice>, size: u64) -> Option<(Place, Vec<usize>)> {
        slices.retain(|slice| slice.is_whole() && slice.taken > self.taken);
        let dated = |slice: &Slice| slice.end.as_ref().is_some_and(|(sums, _)| sums.is_dated());
        let dated = self.traffic.is_dated() || slices.iter().any(dated);
        let first = self.passed.as_ref()?.places.last().filter(|(at, _)| *at == self.taken)?;
        let mut last = first;
        let mut marks = Vec::new();
        for slice in &*slices {
            let mark = slice.marks.binary_search_by_key(&last.0, |(at, _)| *at).ok()?;
            if !last.1.is_alike(&slice.marks[mark].1, dated) {
                return None;
            }
            marks.push(mark);
            last = slice.marks.last()?;
        }
        (slices.last()?.taken == size).then(|| (first.1.clone(), marks))
    }

    /// How many bytes of the file come before the next mark.
    pub fn next_mark(&self) -> u64 {
        self.passed.as_ref().map_or(u64::MAX, |passed| passed.next(self.taken))
    }
}

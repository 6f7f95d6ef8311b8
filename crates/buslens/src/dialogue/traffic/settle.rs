//! Settling: a block of telegrams at a time is judged, met with those before, and packed. What is settled can be
//! shown while the rest of the log is read.

use std::fmt;

use super::collect::Traffic;
use super::entry::Entry;
use super::packed::{Packed, Words};

/// So many telegrams are settled at a time: what is true for a log shows in as many.
const BLOCK: usize = 1 << 14;

/// The same where nothing is left to judge: the nearest caches of a processor hold as many.
const CLEAR_BLOCK: usize = 1 << 10;

/// So many stay behind them, since what follows a telegram tells more of it.
const BEHIND: usize = 64;

/// A piece of a text has no more lines; it is known by its first one when its last one was read.
const PIECE: u32 = 1 << 13;

impl Traffic {
    /// Settles what is complete, up to a line that is read.
    #[inline]
    pub(super) fn settle_blocks(&mut self, line: u32) {
        while let Some(block) = self.block() {
            self.settle(self.end_of_block(block));
        }
        if self.passed.len() + self.unread.len() >= 2 * BLOCK {
            match line {
                // What has no lines has none to list: so many show that something else is there.
                0 => self.passed.truncate(BLOCK),
                _ => {
                    let line = line.saturating_sub(PIECE);
                    self.settle(self.entries.partition_point(|entry| entry.line < line));
                    self.close_lines(line);
                }
            }
        }
    }

    /// A line of a text tells nothing by bytes.
    pub fn pass(&mut self, line: u32, offset: u64) {
        self.unread.push((line, offset));
        self.settle_blocks(line);
    }

    /// Settles all that there is.
    pub(super) fn settle_all(&mut self) {
        self.settle_blocks(u32::MAX);
        self.settle(self.entries.len());
        self.close_lines(u32::MAX);
        // Nothing comes any more.
        (self.entries, self.data) = (Vec::new(), Vec::new());
    }

    /// About how many telegrams the next block has, if there are enough.
    #[inline]
    fn block(&self) -> Option<usize> {
        let ready = self.entries.len().checked_sub(BEHIND).filter(|ready| *ready >= CLEAR_BLOCK)?;
        let clear = self.weak.is_empty() && self.gone.is_empty() && !self.turns && !self.settled.is_empty();
        (clear || ready >= BLOCK).then(|| ready.min(BLOCK))
    }

    /// Settles all but the last ones, and the lines before them; so many were read.
    pub(super) fn settle_ready(&mut self, line: u32) {
        self.settle_blocks(line);
        self.settle(self.end_of_block(self.entries.len().saturating_sub(BEHIND)));
    }

    /// Where the next block of so many telegrams ends: behind an answer and a line, if there is such a place nearby.
    fn end_of_block(&self, block: usize) -> usize {
        let of_line = |end: &usize| match &self.entries[end - 1..=*end] {
            [last, next] => last.line != next.line || next.line == 0,
            _ => false,
        };
        let ends = || (block.saturating_sub(BEHIND).max(1)..=block).rev().filter(of_line);
        ends().find(|end| self.entries[end - 1].sides[1]).or_else(|| ends().next()).unwrap_or(block)
    }

    /// Settles the first `count` entries.
    fn settle(&mut self, count: usize) {
        let mut block = self.judge(count);
        if !block.is_empty() {
            // What a capture says of a connection needs no guess.
            self.meeting.meet(&mut self.settled, &mut block, &self.data, !self.both_ways);
        }
        self.settled.extend(&block, &self.data);
        let kept = self.entries.first().map_or(self.data.len(), |entry| entry.at as usize);
        self.data.drain(..kept);
        self.entries.iter_mut().for_each(|entry| entry.at -= kept as u64);
        self.leave_lines_of(&block);
        // Others can be of what waits for its end.
        let in_hand = self.lanes.iter().filter_map(|lane| lane.rows.first()).map(|row| row.line);
        let next = self.entries.first().map(|entry| entry.line).into_iter().chain(in_hand).min();
        self.close_lines(next.unwrap_or(0));
        // The next block takes the same room.
        block.clear();
        block.append(&mut self.entries);
        self.entries = block;
    }

    /// Lines that have a telegram were not passed.
    fn leave_lines_of(&mut self, block: &[Entry]) {
        if self.passed.is_empty() {
            return;
        }
        // Nearly sorted as they are.
        let mut lines: Vec<u32> = block.iter().map(|entry| entry.line).collect();
        lines.sort();
        self.passed.retain(|(line, _)| lines.binary_search(line).is_err());
    }

    /// No telegram will be found in lines before this one.
    fn close_lines(&mut self, line: u32) {
        let is_before = |(passed, _): &mut (u32, u64)| *passed < line;
        let mut closed: Vec<_> = self.unread.extract_if(.., is_before).collect();
        closed.extend(self.passed.extract_if(.., is_before));
        closed.sort_unstable();
        closed.dedup();
        closed.into_iter().for_each(|passed| self.lines.push(passed));
    }

    /// Lines of a text that hold no telegram, as far as all is settled.
    pub fn lines(&self) -> &Lines {
        &self.lines
    }
}

/// Lines of a text: their numbers, and where they begin in the file.
#[derive(Default)]
pub struct Lines(Packed<2>);

impl Lines {
    pub fn len(&self) -> usize {
        self.0.len()
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u32, u64)> + Clone {
        self.0.iter().map(|[line, offset]| (line as u32, offset))
    }

    /// How many bytes of memory they take.
    pub fn memory(&self) -> usize {
        self.0.memory()
    }

    pub(super) fn hand_over(&mut self, end: usize, words: &mut Words) {
        self.0.hand_over(end, words);
    }

    pub(super) fn take(&mut self, words: &mut &[u64]) -> Option<()> {
        self.0.take(words)
    }

    pub(super) fn push(&mut self, (line, offset): (u32, u64)) {
        self.0.push([line.into(), offset]);
    }
}

impl PartialEq for Lines {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl fmt::Debug for Lines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

//! Large logs can be read in slices, each by a reader of its own, and joined: the same comes out as when one reads
//! all of it.
//!
//! For that, what is true for a whole log is told by its beginning, see [`Traffic::settle_context`]. From there on
//! the file has marks at equal distances, and what is behind a mark hangs on little before it: on what waits there
//! for its rest, and on the last telegrams. Where two readers are alike at a mark, all that they find behind it is
//! the same.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use super::collect::{Latest, Seen, Traffic};
use super::entries::{Entries, Shift};
use super::entry::{Entry, NO_TIME, NOBODY, Written};
use super::judge::{Known, Shapes};
use super::lane::{Carries, Lane, Row};
use super::packed::{Words, take_number, take_words};
use super::settle::Lines;
use super::statistics::{Counts, Span, spanned, take_times, write_times};
use crate::dialogue::foreign::{FOREIGN, FT12};

/// What the beginning of a log tells of all of it.
#[derive(Clone, Debug)]
pub(super) struct Context {
    pub known: Arc<Known>,
    shapes: Shapes,
    in_columns: usize,
    seen: Seen,
    typed: bool,
    turns: bool,
    foreign_protocols: [u32; FOREIGN.len()],
    /// How many were seen up to the last mark.
    foreign_before: [u32; FOREIGN.len()],
}

/// A place between two telegrams, in the numbers of one reader.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// How many telegrams, lines without one, and pauses are settled before it.
    telegrams: usize,
    lines: usize,
    pauses: usize,
    /// How many lines are read before it, and how often midnight passed.
    line: u32,
    days: i64,
    foreign_protocols: [u32; FOREIGN.len()],
    /// The telegrams before it that those behind it may have to do with: how far before it they are.
    open: Vec<usize>,
    /// The first and the last time since the mark before.
    times: Option<Span>,
    /// Two readers are alike where this is the same.
    state: u64,
}

/// What a reader found in its slice, as it handed it over.
#[derive(Debug, Default)]
pub struct Found {
    settled: Entries,
    lines: Lines,
}

/// What a reader hands over at the end of its slice, beside telegrams and lines.
#[derive(Debug, Default)]
pub struct Sums {
    counts: Counts,
    pauses: Vec<(u32, u32)>,
    foreign_protocols: [u32; FOREIGN.len()],
    dated: bool,
}

impl Found {
    /// Takes what a reader [handed over](Traffic::hand_over); `None` if that is cut.
    pub fn take(&mut self, words: &mut &[u64]) -> Option<()> {
        self.settled.take(words)?;
        self.lines.take(words)
    }
}

impl Sums {
    /// Takes what a reader [wrote](Traffic::write_sums); `None` if that is cut.
    pub fn take(words: &mut &[u64]) -> Option<Self> {
        let counts = Counts::take(words)?;
        let pause = |word: &u64| ((word >> 32) as u32, *word as u32);
        let pauses = take_number(words)?;
        let pauses = words.split_off(..pauses)?.iter().map(pause).collect();
        let foreign_protocols = take_words(words)?.map(|count| count as u32);
        Some(Self { counts, pauses, foreign_protocols, dated: take_number(words)? > 0 })
    }

    /// Whether some time has a date.
    pub fn is_dated(&self) -> bool {
        self.dated
    }
}

impl Traffic {
    /// What was read so far, so many lines, is the beginning of the log, and tells what is true for the rest; `false` if
    /// that tells too little.
    pub fn settle_context(&mut self, line: u32) -> bool {
        /// So many telegrams tell it.
        const ENOUGH: usize = 400;
        if !self.meeting.is_settled() && self.entries.len() >= ENOUGH {
            self.settle_ready(line);
        }
        if !self.meeting.is_settled() {
            return false;
        }
        self.context = Some(Context {
            known: Arc::new(std::mem::take(&mut self.known)),
            shapes: self.shapes.clone(),
            in_columns: self.in_columns,
            seen: self.seen.clone(),
            typed: self.typed,
            turns: self.turns,
            foreign_protocols: self.foreign_protocols,
            foreign_before: self.foreign_protocols,
        });
        true
    }

    /// The file passes a mark, behind so many lines: what is far before it does not count any more.
    pub fn pass_mark(&mut self, line: u32) {
        if self.context.is_none() {
            return;
        }
        for port in 0..self.waiting.len() {
            if !std::mem::take(&mut self.heard[port]) {
                self.fall_silent(port as u16);
            }
        }
        self.settle_ready(line);
        self.meeting.forget(self.settled.len());
        if let Some(context) = &mut self.context {
            self.shapes.clone_from(&context.shapes);
            self.seen.clone_from(&context.seen);
            (self.in_columns, self.typed, self.turns) = (context.in_columns, context.typed, context.turns);
            context.foreign_before = self.foreign_protocols;
        }
    }

    /// Nothing was heard of a port since the last mark.
    fn fall_silent(&mut self, port: u16) {
        for way in [0, 1] {
            if let Some(lane) = self.lane_of.get(&(port, way)).copied() {
                self.close(lane);
                self.lanes[lane].empty();
            }
        }
        self.waiting[usize::from(port)] = None;
        self.meeting.fall_silent(port);
    }

    /// Leaves what the beginning has: another reader has it.
    pub fn leave_beginning(&mut self) {
        (self.settled, self.lines, self.pauses) = Default::default();
    }

    /// Goes on elsewhere in the file, of which nothing is known but what the beginning told.
    pub fn jump(&mut self) {
        (self.entries, self.data) = (Vec::new(), Vec::new());
        self.lanes.iter_mut().for_each(Lane::empty);
        self.waiting.iter_mut().for_each(|waiting| *waiting = None);
        self.heard.iter_mut().for_each(|heard| *heard = false);
        self.meeting.jump();
        (self.clock, self.days) = (NO_TIME, 0);
        self.latest_piece = Latest::default();
        (self.weak, self.gone, self.fresh_pauses) = (Vec::new(), Vec::new(), Vec::new());
        (self.passed, self.unread) = (Vec::new(), Vec::new());
    }

    /// How many short frames of M-Bus and IEC 60870-5 tell of the telegrams at hand.
    pub(super) fn short_frames(&self) -> u32 {
        let all = self.foreign_protocols[FT12];
        match &self.context {
            Some(context) => context.foreign_protocols[FT12] + all - context.foreign_before[FT12],
            None => all,
        }
    }

    /// Where the reader is, at a mark behind so many lines; `text` is the state of what reads the text.
    pub fn place(&mut self, line: u32, mut text: impl Hasher) -> Place {
        self.hash_state(line, &mut text);
        let times = self.settled.counts_mut().pass_mark();
        Place {
            telegrams: self.settled.len(),
            lines: self.lines.len(),
            pauses: self.pauses.len(),
            line,
            days: self.days,
            foreign_protocols: self.foreign_protocols,
            open: self.meeting.open(self.settled.len()),
            times,
            state: text.finish(),
        }
    }

    /// Hands over what is settled for good, as the latest mark is this one; all of it without one.
    pub fn hand_over(&mut self, mark: Option<&Place>, words: &mut Words) {
        let (telegrams, lines) = mark.map_or((usize::MAX, usize::MAX), |mark| {
            let open = mark.open.iter().max().unwrap_or(&0);
            (mark.telegrams - open, mark.lines)
        });
        self.settled.hand_over(telegrams, words);
        self.lines.hand_over(lines, words);
    }

    /// Writes what there is beside that at the end of the slice.
    pub fn write_sums(&self, words: &mut Words) {
        self.settled.counts().write(words);
        words.push(self.pauses.len() as u64);
        words.extend(self.pauses.iter().map(|(index, pause)| u64::from(*index) << 32 | u64::from(*pause)));
        words.extend(self.foreign_protocols.map(u64::from));
        words.push(self.dated.into());
    }

    /// Whether some time has a date.
    pub fn is_dated(&self) -> bool {
        self.dated
    }

    /// All that what comes next hangs on, apart from the beginning of the log; lines, times of day and telegrams are
    /// counted from here.
    fn hash_state(&self, line: u32, hasher: &mut impl Hasher) {
        let first = self.entries.first().map_or(self.data.len() as u64, |entry| entry.at);
        self.entries.len().hash(hasher);
        for entry in &self.entries {
            let entry = Entry { at: entry.at - first, ..*entry };
            hash_entry(&entry, line, self.days, hasher);
        }
        self.data.get(first as usize..).hash(hasher);
        self.lanes.len().hash(hasher);
        for lane in &self.lanes {
            lane.hash_state(line, self.days, hasher);
        }
        self.latest_way.hash(hasher);
        self.waiting.hash(hasher);
        shifted(self.clock, self.days).hash(hasher);
        self.both_ways.hash(hasher);
        (self.typed, self.turns, self.in_columns).hash(hasher);
        (&self.gone, &self.fresh_pauses).hash(hasher);
        for weak in &self.weak {
            (weak.entry, weak.bits, weak.read, weak.cut, weak.awaited, weak.facts).hash(hasher);
        }
        for (passed, offset) in self.passed.iter().chain(&[(line, u64::MAX)]).chain(&self.unread) {
            (line - passed, offset).hash(hasher);
        }
        let Latest { line: latest, bytes, hint } = &self.latest_piece;
        (behind(line, *latest), bytes, hint).hash(hasher);
        self.meeting.hash_state(self.settled.len(), line, self.days, hasher);
    }

    /// Takes over what another reader found from the first of these marks on, where it was as this one is at `here`,
    /// which is the end of what this one has: what it still had in hand, the other one has.
    pub fn adopt(&mut self, here: &Place, found: Found, sums: Sums, marks: &[(u64, Place)]) {
        let [(_, from), behind @ ..] = marks else { return };
        let Found { settled, lines } = found;
        let Sums { counts, pauses, foreign_protocols, dated } = sums;
        let base = here.telegrams;
        debug_assert_eq!(base, self.settled.len(), "it has more than it had at the mark");
        let moved = |index: u32| index.wrapping_sub(from.telegrams as u32).wrapping_add(base as u32);
        let shift = Shift { lines: here.line.wrapping_sub(from.line), days: here.days - from.days };
        // What those behind the place told of those before it.
        for distance in &from.open {
            let (own, others) = (base - distance, from.telegrams - distance);
            if let (Some(own_entry), Some(entry)) = (self.settled.get(own), settled.get(others)) {
                let Entry { partner, direction, role, sides, .. } = entry;
                let partner = if partner == NOBODY { NOBODY } else { moved(partner) };
                self.settled.set(own, &Entry { partner, direction, role, sides, ..own_entry });
            }
        }
        let times = behind.iter().map(|(_, place)| place.times).fold(counts.latest_times(), spanned);
        self.settled.join(settled, &counts, from.telegrams, shift);
        let times = times.map(|(first, last)| (first + shift.days, last + shift.days));
        self.settled.counts_mut().add_times(times);
        for (line, offset) in lines.iter().skip(from.lines) {
            self.lines.push((line.wrapping_add(shift.lines), offset));
        }
        let pauses = pauses.iter().skip(from.pauses);
        self.pauses.extend(pauses.map(|(index, pause)| (moved(*index), *pause)));
        for (place, count) in self.foreign_protocols.iter_mut().enumerate() {
            *count = here.foreign_protocols[place] + foreign_protocols[place] - from.foreign_protocols[place];
        }
        self.room = (NOBODY as usize).saturating_sub(self.settled.len());
        self.dated |= dated;
        self.jump();
    }
}

impl Place {
    /// Writes it as words.
    pub fn write(&self, words: &mut Words) {
        let Self { telegrams, lines, pauses, line, days, foreign_protocols, open, times, state } = self;
        words.extend([telegrams, lines, pauses, &open.len()].map(|count| *count as u64));
        words.extend([u64::from(*line), *days as u64, *state]);
        write_times(words, *times);
        words.extend(foreign_protocols.map(u64::from));
        words.extend(open.iter().map(|distance| *distance as u64));
    }

    /// Takes what [`write`](Self::write) wrote; `None` if that is cut.
    pub fn take(words: &mut &[u64]) -> Option<Self> {
        let [telegrams, lines, pauses, open] = take_words(words)?.map(|count| count as usize);
        let [line, days, state] = take_words(words)?;
        let (line, days, times) = (line as u32, days as i64, take_times(words)?);
        let foreign_protocols = take_words(words)?.map(|count| count as u32);
        let open = words.split_off(..open)?.iter().map(|distance| *distance as usize).collect();
        Some(Self { telegrams, lines, pauses, line, days, foreign_protocols, open, times, state })
    }

    /// Whether all that another reader finds behind `there` is found by this one behind this place, too; `dated` says
    /// whether some time has a date.
    pub fn is_alike(&self, there: &Self, dated: bool) -> bool {
        // Days are counted for times of day only.
        self.state == there.state && (self.days == there.days || !dated)
    }

    /// How many lines there are behind this place, which is `from` of a reader that has so many.
    pub fn lines_behind(&self, from: &Self, lines: u32) -> u32 {
        self.line + lines - from.line
    }

    /// The same place, which `to` of another reader is, in the numbers of the one that takes over what that has from
    /// `from` on, where itself is `self`.
    pub fn moved(&self, from: &Self, to: &Self) -> Self {
        Self {
            telegrams: self.telegrams + to.telegrams - from.telegrams,
            lines: self.lines + to.lines - from.lines,
            pauses: self.pauses + to.pauses - from.pauses,
            line: self.line + to.line - from.line,
            days: self.days + to.days - from.days,
            foreign_protocols: std::array::from_fn(|place| {
                self.foreign_protocols[place] + to.foreign_protocols[place] - from.foreign_protocols[place]
            }),
            open: to.open.clone(),
            times: to.times,
            state: to.state,
        }
    }
}

impl Lane {
    /// Nothing of it is in hand any more.
    fn empty(&mut self) {
        *self = Self {
            streaming: self.stream,
            stream: self.stream,
            in_step: !self.stream,
            carries: self.carries,
            ..Self::default()
        };
    }

    fn hash_state(&self, line: u32, days: i64, hasher: &mut impl Hasher) {
        (&self.buffer, &self.decimal, &self.breaks).hash(hasher);
        (self.streaming, self.in_step, self.barren).hash(hasher);
        match self.carries {
            Carries::Unknown => 0.hash(hasher),
            Carries::Foreign => 1.hash(hasher),
            Carries::Protocol(protocol) => protocol.key.hash(hasher),
        }
        // How the bytes of a stream came in parts says nothing.
        let row = |row: &Row| match row.line {
            0 if row.written.is_some() => {
                Row { offset: row.offset.wrapping_add_signed(-row.from as i64), from: 0, ..*row }
            }
            _ => *row,
        };
        if !self.buffer.is_empty() {
            let mut rows: Vec<Row> = self.rows.iter().map(row).collect();
            rows.dedup_by_key(|row| (row.from, row.offset));
            rows.iter().for_each(|row| row.hash_state(line, days, hasher));
        }
        if let Some(held) = &self.held {
            held.hash_state(line, days, hasher);
        }
    }
}

impl Row {
    pub(super) fn hash_state(&self, line: u32, days: i64, hasher: &mut impl Hasher) {
        (self.from, shifted(self.time, days), self.hint, self.port, behind(line, self.line)).hash(hasher);
        (self.offset, self.written, self.facts).hash(hasher);
    }
}

/// How far a line is before the one at hand; what has no lines stays so.
fn behind(line: u32, other: u32) -> u32 {
    if other == 0 { u32::MAX } else { line.wrapping_sub(other) }
}

/// A time without the days that were counted.
fn shifted(time: i64, days: i64) -> i64 {
    if time == NO_TIME { NO_TIME } else { time.wrapping_sub(days) }
}

/// `entry.partner` is to be counted from the place at hand.
pub(super) fn hash_entry(entry: &Entry, line: u32, days: i64, hasher: &mut impl Hasher) {
    let Entry { time, at, offset, written, line: own, skip, length, partner, port, protocol, unit, .. } =
        *entry;
    (shifted(time, days), at, offset, written.map(|Written { from, step }| (from, step))).hash(hasher);
    (behind(line, own), skip, length, partner, port, protocol, unit).hash(hasher);
    (entry.function, entry.verdict as u8, entry.direction, entry.role, entry.sides, entry.hint).hash(hasher);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A place whose numbers lie `by` further on than others.
    fn place(by: usize) -> Place {
        Place {
            telegrams: 100 + by,
            lines: 200 + 2 * by,
            pauses: 300 + 3 * by,
            line: 400 + 4 * by as u32,
            days: 500 + 5 * by as i64,
            foreign_protocols: [600 + 6 * by as u32; FOREIGN.len()],
            open: vec![by],
            times: Some((-700 - by as i64, 800 + by as i64)),
            state: by as u64,
        }
    }

    #[test]
    fn a_place_in_the_numbers_of_another_reader() {
        // From 10 to 30 of the other one it is as far as from 50 to 70 of the own.
        let Place { open, times, state, .. } = place(30);
        assert_eq!(place(50).moved(&place(10), &place(30)), Place { open, times, state, ..place(70) });
        assert_eq!(place(50).lines_behind(&place(10), 1000), 1160);
    }

    #[test]
    fn places_and_sums_come_back_from_words() {
        let counts = |words: &Words| Sums::take(&mut &words[..]).map(|sums| format!("{sums:?}"));
        for times in [None, Some((-5, -5)), Some((-9, 1 << 60))] {
            let place = Place { times, open: vec![3, 70_000, 0], ..place(40) };
            let mut words = Words::new();
            place.write(&mut words);
            assert_eq!(Place::take(&mut &words[..]), Some(place));
            for cut in 0..words.len() {
                assert_eq!(Place::take(&mut &words[..cut]), None);
            }
        }
        let mut traffic = Traffic::new(&crate::frame::modbus_rtu::PROTOCOL, &Default::default());
        (traffic.pauses, traffic.dated) = (vec![(7, u32::MAX), (u32::MAX - 1, 0)], true);
        traffic.foreign_protocols = [9; FOREIGN.len()];
        let mut words = Words::new();
        traffic.write_sums(&mut words);
        let sums = Sums {
            counts: Counts::default(),
            pauses: traffic.pauses,
            foreign_protocols: [9; FOREIGN.len()],
            dated: true,
        };
        assert_eq!(counts(&words), Some(format!("{sums:?}")));
        assert_eq!(counts(&words[..words.len() - 1].to_vec()), None);
    }
}

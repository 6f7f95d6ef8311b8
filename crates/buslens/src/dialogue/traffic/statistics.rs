//! A log in numbers.

use std::collections::HashMap;

use super::collect::Traffic;
use super::entry::{Entry, Role};
use super::packed::{Words, take_number, take_words};
use crate::field::Direction;
use crate::frame::Verdict;
use crate::modbus::EXCEPTION;

/// What happened in a log.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    pub telegrams: usize,
    pub pairs: usize,
    pub unanswered: usize,
    pub retries: usize,
    pub unasked: usize,
    pub late: usize,
    pub echoes: usize,
    pub copies: usize,
    pub broadcasts: usize,
    pub exceptions: usize,
    pub check_failed: usize,
    /// Too short to have a check.
    pub unchecked: usize,
    pub bytes_discarded: usize,
    /// The first and the last time.
    pub times: Option<(i64, i64)>,
    /// By port, unit and function, in that order.
    pub dialogs: Vec<Dialog>,
}

/// What a unit was asked with one function, and what came of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dialog {
    pub port: u16,
    pub unit: Option<u8>,
    /// 0 where the protocol has none.
    pub function: u8,
    pub telegrams: usize,
    pub requests: usize,
    pub answered: usize,
    pub unanswered: usize,
    pub retries: usize,
    pub exceptions: usize,
    pub check_failed: usize,
    /// Microseconds from request to response.
    pub median: Option<u32>,
    pub worst: Option<u32>,
    /// When most requests were unanswered, if they come together.
    pub silent: Option<Minutes>,
}

/// A stretch of time in which something happened, so many times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Minutes {
    pub from: i64,
    pub to: i64,
    pub count: usize,
}

/// What is counted of telegrams while they are settled: of each by itself, in no order.
#[derive(Debug, Default)]
pub(super) struct Counts {
    /// Of each role, and of each verdict, by their numbers.
    roles: [usize; 8],
    verdicts: [usize; 4],
    bytes_discarded: usize,
    /// The first and the last time before the last mark of a log that has some, and behind it.
    before: Option<Span>,
    times: Option<Span>,
    tallies: Vec<Tally>,
    places: Places,
}

/// The first and the last one of some times.
pub(super) type Span = (i64, i64);

/// Writes it; what is none ends before it begins.
pub(super) fn write_times(words: &mut Words, times: Option<Span>) {
    let (first, last) = times.unwrap_or((0, -1));
    words.extend([first as u64, last as u64]);
}

pub(super) fn take_times(words: &mut &[u64]) -> Option<Option<Span>> {
    let [first, last] = take_words(words)?.map(|time| time as i64);
    Some((first <= last).then_some((first, last)))
}

/// All of both.
pub(super) fn spanned(one: Option<Span>, other: Option<Span>) -> Option<Span> {
    let both = one.zip(other).map(|(one, other)| (one.0.min(other.0), one.1.max(other.1)));
    both.or(one).or(other)
}

/// The telegrams of a port, a unit and a function code as it is on the wire.
#[derive(Clone, Debug)]
struct Tally {
    port: u16,
    unit: Option<u8>,
    function: u8,
    /// How many there are of each [`class`].
    counts: [u32; CLASSES],
}

const CLASSES: usize = 32;

const RESPONSE: usize = 1;
const PARTNER: usize = 2;
const WRONG: usize = 4;
const PLAIN: usize = 8;
const RETRY: usize = 16;

/// What matters of a telegram for its dialog, in one number, so that there is only one to count up.
#[inline]
fn class(entry: &Entry) -> usize {
    let bit = |bit: usize, is: bool| bit * usize::from(is);
    bit(RESPONSE, entry.direction == Direction::Response)
        + bit(PARTNER, entry.partner().is_some())
        + bit(WRONG, entry.verdict == Verdict::Wrong)
        + bit(PLAIN, entry.role == Role::Plain)
        + bit(RETRY, entry.role == Role::Retry)
}

impl Counts {
    #[inline]
    pub fn add(&mut self, entry: &Entry) {
        self.count::<1>(entry);
        if let Some(time) = entry.time().filter(|_| entry.role != Role::Discarded) {
            let (first, last) = self.times.unwrap_or((time, time));
            self.times = Some((first.min(time), last.max(time)));
        }
    }

    /// What was added is not counted, but for its time.
    pub fn remove(&mut self, entry: &Entry) {
        self.count::<-1>(entry);
    }

    /// The first and the last time of all.
    pub fn times(&self) -> Option<Span> {
        spanned(self.before, self.times)
    }

    /// The file passes a mark; returns the first and the last time since the last one.
    pub fn pass_mark(&mut self) -> Option<Span> {
        let times = self.times.take();
        self.before = spanned(self.before, times);
        times
    }

    /// The first and the last time since the last mark.
    pub fn latest_times(&self) -> Option<Span> {
        self.times
    }

    /// There are these times, too.
    pub fn add_times(&mut self, times: Option<Span>) {
        self.before = spanned(self.before, times);
    }

    /// Takes what was counted beside it, but for the times.
    pub fn join(&mut self, other: &Self) {
        for (own, other) in self.roles.iter_mut().zip(other.roles) {
            *own += other;
        }
        for (own, other) in self.verdicts.iter_mut().zip(other.verdicts) {
            *own += other;
        }
        self.bytes_discarded += other.bytes_discarded;
        for Tally { port, unit, function, counts } in &other.tallies {
            let place = self.places.all.len();
            let place = *self.places.all.entry(key(*port, *unit, *function)).or_insert(place);
            if place == self.tallies.len() {
                self.tallies.push(Tally {
                    port: *port,
                    unit: *unit,
                    function: *function,
                    counts: [0; CLASSES],
                });
            }
            for (own, other) in self.tallies[place].counts.iter_mut().zip(counts) {
                *own += other;
            }
        }
    }

    /// Writes what was counted, and of the times those since the last mark.
    pub fn write(&self, words: &mut Words) {
        let Self { roles, verdicts, bytes_discarded, times, tallies, .. } = self;
        words.extend(roles.iter().chain(verdicts).chain([bytes_discarded]).map(|count| *count as u64));
        write_times(words, *times);
        words.push(tallies.len() as u64);
        for Tally { port, unit, function, counts } in tallies {
            words.push(key(*port, *unit, *function));
            words.extend(counts.map(u64::from));
        }
    }

    /// Takes what another one [wrote](Self::write); `None` if that is cut.
    pub fn take(words: &mut &[u64]) -> Option<Self> {
        let roles = take_words(words)?.map(|count| count as usize);
        let verdicts = take_words(words)?.map(|count| count as usize);
        let (bytes_discarded, times) = (take_number(words)?, take_times(words)?);
        let tally = |words: &mut &[u64]| {
            let [_, _, _, high, low, has_unit, unit, function] = take_words::<1>(words)?[0].to_be_bytes();
            let (port, unit) = (u16::from_be_bytes([high, low]), (has_unit != 0).then_some(unit));
            Some(Tally { port, unit, function, counts: take_words(words)?.map(|count| count as u32) })
        };
        let tallies = (0..take_number(words)?).map(|_| tally(words)).collect::<Option<_>>()?;
        Some(Self { roles, verdicts, bytes_discarded, times, tallies, ..Self::default() })
    }

    /// What was added as `before` is `entry` now.
    pub fn replace(&mut self, before: &Entry, entry: &Entry) {
        self.count::<-1>(before);
        self.count::<1>(entry);
    }

    #[inline]
    fn count<const BY: isize>(&mut self, entry: &Entry) {
        let role = &mut self.roles[entry.role as usize];
        *role = role.wrapping_add_signed(BY);
        if entry.role == Role::Discarded {
            let bytes = BY * entry.length as isize;
            self.bytes_discarded = self.bytes_discarded.wrapping_add_signed(bytes);
            return;
        }
        if entry.role == Role::Copy {
            return;
        }
        let verdict = &mut self.verdicts[entry.verdict as usize];
        *verdict = verdict.wrapping_add_signed(BY);
        if entry.role == Role::Echo {
            return;
        }
        let place = self.places.of(entry);
        if place == self.tallies.len() {
            let Entry { port, unit, function, .. } = *entry;
            self.tallies.push(Tally { port, unit, function, counts: [0; CLASSES] });
        }
        let count = &mut self.tallies[place].counts[class(entry)];
        *count = count.wrapping_add_signed(BY as i32);
    }
}

impl Tally {
    fn dialog(&self) -> Dialog {
        let sum = |bits: usize, of: usize| {
            let chosen = self.counts.iter().enumerate().filter(|(class, _)| class & bits == of);
            chosen.map(|(_, count)| *count as usize).sum::<usize>()
        };
        let asks = |bits: usize| sum(RESPONSE + PLAIN + bits, PLAIN) + sum(RESPONSE + RETRY + bits, RETRY);
        Dialog {
            port: self.port,
            unit: self.unit,
            function: self.function & !EXCEPTION,
            telegrams: sum(0, 0),
            requests: asks(0),
            answered: sum(RESPONSE + PARTNER, RESPONSE + PARTNER),
            unanswered: asks(PARTNER),
            retries: sum(RETRY, RETRY),
            exceptions: if self.function & EXCEPTION == 0 { 0 } else { sum(RESPONSE, RESPONSE) },
            check_failed: sum(WRONG, WRONG),
            ..Dialog::default()
        }
    }
}

impl Dialog {
    fn key(&self) -> (u16, Option<u8>, u8) {
        (self.port, self.unit, self.function)
    }

    /// Takes what was counted of the same dialog beside it.
    fn join(&mut self, other: &Self) {
        self.telegrams += other.telegrams;
        self.requests += other.requests;
        self.answered += other.answered;
        self.unanswered += other.unanswered;
        self.retries += other.retries;
        self.exceptions += other.exceptions;
        self.check_failed += other.check_failed;
    }
}

/// Port, unit and function in one number.
fn key(port: u16, unit: Option<u8>, function: u8) -> u64 {
    let [high, low] = port.to_be_bytes();
    let unit = [unit.is_some().into(), unit.unwrap_or_default()];
    u64::from_be_bytes([0, 0, 0, high, low, unit[0], unit[1], function])
}

/// The places of tallies, in the order in which they are met.
#[derive(Clone, Debug, Default)]
struct Places {
    all: HashMap<u64, usize>,
    /// The last one for each shelf of keys, so that hardly any is looked up.
    recent: Vec<(u64, usize)>,
}

impl Places {
    const SHELVES: usize = 256;

    #[inline]
    fn of(&mut self, entry: &Entry) -> usize {
        let key = key(entry.port, entry.unit, entry.function);
        let [shelf, ..] = key.wrapping_mul(0x9E37_79B9_7F4A_7C15).to_be_bytes();
        let shelf = usize::from(shelf);
        match self.recent.get(shelf) {
            Some((recent, place)) if *recent == key && *place != usize::MAX => *place,
            _ => self.look_up(key, shelf),
        }
    }

    #[cold]
    fn look_up(&mut self, key: u64, shelf: usize) -> usize {
        let fresh = self.all.len();
        let place = *self.all.entry(key).or_insert(fresh);
        self.recent.resize(Self::SHELVES, (0, usize::MAX));
        self.recent[shelf] = (key, place);
        place
    }
}

/// The times of a dialog.
#[derive(Clone, Default)]
struct Timing {
    latencies: Vec<u32>,
    silent: Vec<i64>,
}

/// The numbers of what is settled so far.
pub fn statistics(traffic: &Traffic) -> Statistics {
    let counts = traffic.entries().counts();
    let role = |role: Role| counts.roles[role as usize];
    let dialogs = dialogs(traffic);
    let sum = |number: fn(&Dialog) -> usize| dialogs.iter().map(number).sum();
    Statistics {
        telegrams: counts.verdicts.iter().sum(),
        pairs: sum(|dialog| dialog.answered),
        unanswered: sum(|dialog| dialog.unanswered),
        retries: role(Role::Retry),
        unasked: role(Role::Unasked),
        late: role(Role::Late),
        echoes: role(Role::Echo),
        copies: role(Role::Copy),
        broadcasts: role(Role::Broadcast),
        exceptions: sum(|dialog| dialog.exceptions),
        check_failed: counts.verdicts[Verdict::Wrong as usize],
        unchecked: counts.verdicts[Verdict::Unchecked as usize],
        bytes_discarded: counts.bytes_discarded,
        times: counts.times(),
        dialogs,
    }
}

/// All dialogs in their order.
fn dialogs(traffic: &Traffic) -> Vec<Dialog> {
    let counts = traffic.entries().counts();
    let times = counts.times();
    let timings = if times.is_some() { timings(traffic) } else { Vec::new() };
    let timings = timings.into_iter().chain(std::iter::repeat_with(Timing::default));
    let mut all: Vec<(Dialog, Timing)> = counts.tallies.iter().map(Tally::dialog).zip(timings).collect();
    // All of them turned out to be something else.
    all.retain(|(dialog, _)| dialog.telegrams > 0);
    all.sort_unstable_by_key(|(dialog, _)| dialog.key());
    // Answers that refuse have a function code of their own.
    all.dedup_by(|(next, later), (dialog, timing)| {
        let same = next.key() == dialog.key();
        if same {
            dialog.join(next);
            timing.join(later);
        }
        same
    });
    let whole = times.map_or(0, |(first, last)| last - first);
    all.into_iter().map(|(dialog, timing)| timing.close(whole, dialog)).collect()
}

/// The times of all tallies, by their places.
fn timings(traffic: &Traffic) -> Vec<Timing> {
    let entries = traffic.entries();
    let mut places = entries.counts().places.clone();
    let mut all = vec![Timing::default(); entries.counts().tallies.len()];
    // Most requests stand just before their answers: their times need not be looked up.
    let mut recent = [None; 8];
    for (index, entry) in entries.iter().enumerate() {
        recent[index % recent.len()] = entry.time();
        if entry.unanswered() {
            all[places.of(&entry)].silent.extend(entry.time());
        }
        let Some(request) = entry.partner().filter(|_| entry.answers()) else { continue };
        let is_recent = (index.saturating_sub(recent.len() - 1)..index).contains(&request);
        let asked = if is_recent { recent[request % recent.len()] } else { entries.time(request) };
        if let Some(latency) = latency(entry.time(), asked) {
            all[places.of(&entry)].latencies.push(latency);
        }
    }
    all
}

/// Microseconds between a response and its request, by their times.
pub fn latency(answered: Option<i64>, asked: Option<i64>) -> Option<u32> {
    u32::try_from(answered? - asked?).ok()
}

impl Timing {
    fn join(&mut self, other: &mut Self) {
        self.latencies.append(&mut other.latencies);
        self.silent.append(&mut other.silent);
    }

    /// `whole` is how long the log is.
    fn close(mut self, whole: i64, counted: Dialog) -> Dialog {
        let middle = self.latencies.len() / 2;
        let median = (!self.latencies.is_empty()).then(|| *self.latencies.select_nth_unstable(middle).1);
        let worst = self.latencies.iter().copied().max();
        Dialog { median, worst, silent: densest(&mut self.silent, whole), ..counted }
    }
}

/// The shortest stretch that holds nine of ten times, or else seven, where that is far shorter
/// than the `whole` log.
fn densest(times: &mut [i64], whole: i64) -> Option<Minutes> {
    const ENOUGH: usize = 5;
    times.sort_unstable();
    let shortest = |tenths: usize| {
        let count = (times.len() * tenths).div_ceil(10).max(ENOUGH);
        let windows = times.windows(count).map(|window| (window[0], window[count - 1]));
        windows.min_by_key(|(from, to)| to - from).filter(|(from, to)| (to - from) * 3 <= whole && whole > 0)
    };
    let (from, to) = shortest(9).or_else(|| shortest(7))?;
    let inside = times.iter().filter(|time| (from..=to).contains(*time));
    Some(Minutes { from, to, count: inside.count() })
}

//! A log in numbers.

use std::collections::HashMap;

use super::collect::Traffic;
use super::entry::{Entry, Role};
use crate::frame::Verdict;

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
    times: Option<(i64, i64)>,
    dialogs: Vec<Dialog>,
    places: Places,
}

impl Counts {
    #[inline]
    pub fn add(&mut self, entry: &Entry) {
        self.count::<1>(entry);
    }

    /// What was added as `before` is `entry` now.
    pub fn replace(&mut self, before: &Entry, entry: &Entry) {
        self.count::<-1>(before);
        self.count::<1>(entry);
    }

    #[inline]
    fn count<const BY: isize>(&mut self, entry: &Entry) {
        let add = |number: &mut usize, is: bool| *number = number.wrapping_add_signed(BY * isize::from(is));
        add(&mut self.roles[entry.role as usize], true);
        if entry.role == Role::Discarded {
            self.bytes_discarded += usize::from(entry.length);
            return;
        }
        if let Some(time) = entry.time() {
            let (first, last) = self.times.unwrap_or((time, time));
            self.times = Some((first.min(time), last.max(time)));
        }
        if entry.role == Role::Copy {
            return;
        }
        add(&mut self.verdicts[entry.verdict as usize], true);
        if entry.role == Role::Echo {
            return;
        }
        let place = self.places.of(entry);
        if place == self.dialogs.len() {
            let (port, unit, function) = (entry.port, entry.unit, entry.plain_function());
            self.dialogs.push(Dialog { port, unit, function, ..Dialog::default() });
        }
        let dialog = &mut self.dialogs[place];
        add(&mut dialog.telegrams, true);
        add(&mut dialog.requests, entry.asks());
        add(&mut dialog.answered, entry.answers());
        add(&mut dialog.unanswered, entry.unanswered());
        add(&mut dialog.retries, entry.role == Role::Retry);
        add(&mut dialog.exceptions, entry.refuses());
        add(&mut dialog.check_failed, entry.verdict == Verdict::Wrong);
    }
}

/// Port, unit and function in one number.
fn key(entry: &Entry) -> u32 {
    u32::from(entry.port) << 16
        | u32::from(entry.unit.is_some()) << 15
        | u32::from(entry.unit.unwrap_or_default()) << 7
        | u32::from(entry.plain_function())
}

/// The places of dialogs, in the order in which they are met.
#[derive(Clone, Debug, Default)]
struct Places {
    all: HashMap<u32, usize>,
    /// The last one for each shelf of keys, so that hardly any is looked up.
    recent: Vec<(u32, usize)>,
}

impl Places {
    const SHELVES: usize = 256;

    #[inline]
    fn of(&mut self, entry: &Entry) -> usize {
        let key = key(entry);
        let shelf = (key ^ key >> 7 ^ key << 4) as usize % Self::SHELVES;
        match self.recent.get(shelf) {
            Some((recent, place)) if *recent == key && *place != usize::MAX => *place,
            _ => self.look_up(key, shelf),
        }
    }

    #[cold]
    fn look_up(&mut self, key: u32, shelf: usize) -> usize {
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
    let mut dialogs = match counts.times {
        Some((first, last)) => {
            let timings = timings(traffic).into_iter().zip(&counts.dialogs);
            timings.map(|(timing, dialog)| timing.close(last - first, dialog)).collect()
        }
        None => counts.dialogs.clone(),
    };
    dialogs.sort_unstable_by_key(|dialog| (dialog.port, dialog.unit, dialog.function));
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
        times: counts.times,
        dialogs,
    }
}

/// The times of all dialogs, by their places.
fn timings(traffic: &Traffic) -> Vec<Timing> {
    let entries = traffic.entries();
    let mut places = entries.counts().places.clone();
    let mut all = vec![Timing::default(); entries.counts().dialogs.len()];
    for entry in entries {
        if entry.unanswered() {
            all[places.of(&entry)].silent.extend(entry.time());
        }
        if let Some(request) = entry.partner().filter(|_| entry.answers())
            && let Some(latency) = latency(entry.time(), entries.time(request))
        {
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
    /// `whole` is how long the log is.
    fn close(mut self, whole: i64, counted: &Dialog) -> Dialog {
        let middle = self.latencies.len() / 2;
        let median = (!self.latencies.is_empty()).then(|| *self.latencies.select_nth_unstable(middle).1);
        let worst = self.latencies.iter().copied().max();
        Dialog { median, worst, silent: densest(&mut self.silent, whole), ..*counted }
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

//! A log in numbers.

use std::collections::HashMap;

use super::collect::Traffic;
use super::entries::Entries;
use super::entry::{Entry, Role};
use crate::field::Direction;
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

#[derive(Default)]
struct Gathered {
    dialog: Dialog,
    latencies: Vec<u32>,
    silent: Vec<i64>,
}

/// Counts.
pub fn statistics(traffic: &Traffic) -> Statistics {
    let entries = traffic.entries();
    let mut all = Statistics::default();
    let mut dialogs = Dialogs { all: Vec::new(), places: HashMap::new(), recent: [0; 256] };
    for entry in entries {
        if entry.role == Role::Discarded {
            all.bytes_discarded += usize::from(entry.length);
            continue;
        }
        if let Some(time) = entry.time() {
            let (first, last) = all.times.unwrap_or((time, time));
            all.times = Some((first.min(time), last.max(time)));
        }
        if entry.role == Role::Copy {
            all.copies += 1;
            continue;
        }
        all.telegrams += 1;
        all.check_failed += usize::from(entry.verdict == Verdict::Wrong);
        all.unchecked += usize::from(entry.verdict == Verdict::Unchecked);
        all.unanswered += usize::from(entry.unanswered());
        all.exceptions += usize::from(entry.refuses());
        all.pairs += usize::from(entry.direction == Direction::Response && entry.partner().is_some());
        match entry.role {
            Role::Retry => all.retries += 1,
            Role::Unasked => all.unasked += 1,
            Role::Late => all.late += 1,
            Role::Echo => all.echoes += 1,
            Role::Broadcast => all.broadcasts += 1,
            Role::Plain | Role::Copy | Role::Discarded => {}
        }
        if entry.role != Role::Echo {
            count(dialogs.of(&entry), &entry, entries);
        }
    }
    let whole = all.times.map_or(0, |(first, last)| last - first);
    all.dialogs = dialogs.all.into_iter().map(|gathered| gathered.close(whole)).collect();
    all.dialogs.sort_unstable_by_key(|dialog| (dialog.port, dialog.unit, dialog.function));
    all
}

/// What is gathered so far, and where whose numbers are.
struct Dialogs {
    all: Vec<Gathered>,
    places: HashMap<(u16, Option<u8>, u8), usize>,
    /// The last place for each [`shelf`](Self::of) of keys, so that hardly any is looked up.
    recent: [usize; 256],
}

impl Dialogs {
    fn of(&mut self, entry: &Entry) -> &mut Gathered {
        let (port, unit, function) = (entry.port, entry.unit, entry.plain_function());
        let shelf = usize::from(unit.unwrap_or_default() ^ function.rotate_left(4) ^ port as u8);
        let recent = self.recent[shelf];
        let same =
            |it: &Gathered| (it.dialog.port, it.dialog.unit, it.dialog.function) == (port, unit, function);
        if self.all.get(recent).is_none_or(|it| !same(it)) {
            let fresh = self.all.len();
            let place = *self.places.entry((port, unit, function)).or_insert(fresh);
            if place == fresh {
                let dialog = Dialog { port, unit, function, ..Dialog::default() };
                self.all.push(Gathered { dialog, ..Gathered::default() });
            }
            self.recent[shelf] = place;
        }
        &mut self.all[self.recent[shelf]]
    }
}

fn count(gathered: &mut Gathered, entry: &Entry, entries: &Entries) {
    let dialog = &mut gathered.dialog;
    dialog.telegrams += 1;
    dialog.requests += usize::from(entry.asks());
    dialog.unanswered += usize::from(entry.unanswered());
    dialog.retries += usize::from(entry.role == Role::Retry);
    dialog.exceptions += usize::from(entry.refuses());
    dialog.check_failed += usize::from(entry.verdict == Verdict::Wrong);
    if entry.unanswered() {
        gathered.silent.extend(entry.time());
    }
    if entry.direction == Direction::Response
        && let Some(request) = entry.partner()
    {
        dialog.answered += 1;
        if let Some(latency) = latency(entry.time(), entries.time(request)) {
            gathered.latencies.push(latency);
        }
    }
}

/// Microseconds between a response and its request, by their times.
pub fn latency(answered: Option<i64>, asked: Option<i64>) -> Option<u32> {
    u32::try_from(answered? - asked?).ok()
}

impl Gathered {
    /// `whole` is how long the log is.
    fn close(mut self, whole: i64) -> Dialog {
        let middle = self.latencies.len() / 2;
        let median = (!self.latencies.is_empty()).then(|| *self.latencies.select_nth_unstable(middle).1);
        let worst = self.latencies.iter().copied().max();
        Dialog { median, worst, silent: densest(&mut self.silent, whole), ..self.dialog }
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

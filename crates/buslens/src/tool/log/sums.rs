//! What all telegrams of a log tell together, found in one go: there can be many millions of them.

use std::collections::BTreeMap;

use super::findings::EVIDENCE;
use super::{Entry, Log, Role};
use crate::field::Direction;
use crate::frame::Verdict;

#[derive(Debug, Default)]
pub(super) struct Sums {
    /// How many a person should look at.
    pub wrong: usize,
    /// How many checks do not match.
    pub failed: usize,
    /// All bytes, and those in no right telegram.
    pub bytes: usize,
    pub lost: usize,
    /// The slow answers of each unit of a port.
    pub slow: BTreeMap<(u16, Option<u8>), Shown>,
    /// Requests before an answer to the last one could come.
    pub hasty: Shown,
}

/// Telegrams of a kind.
#[derive(Debug, Default)]
pub(super) struct Shown {
    pub count: usize,
    /// The indices of the first ones.
    pub first: Vec<u32>,
    /// Of answers: the shortest time from the request, in microseconds.
    pub least: Option<u32>,
}

impl Shown {
    fn add(&mut self, index: u32, latency: Option<u32>) {
        self.count += 1;
        if self.first.len() < EVIDENCE {
            self.first.push(index);
        }
        self.least = self.least.into_iter().chain(latency).min();
    }
}

impl Log {
    pub(super) fn sums(&self) -> &Sums {
        self.sums.get_or_init(|| Sums::of(self))
    }
}

impl Sums {
    fn of(log: &Log) -> Self {
        let mut sums = Self::default();
        let usual = log.statistics().dialogs.iter().filter_map(|dialog| dialog.median).min();
        let mut before: Option<Entry> = None;
        for (entry, index) in log.entries().iter().zip(0_u32..) {
            let (length, discarded) = (usize::from(entry.length), entry.role == Role::Discarded);
            let failed = entry.verdict == Verdict::Wrong;
            sums.bytes += length;
            sums.lost += if failed | discarded { length } else { 0 };
            sums.failed += usize::from(failed & !discarded);
            sums.wrong += usize::from(log.state(&entry).is_wrong());
            if log.is_slow(&entry) {
                sums.slow.entry((entry.port, entry.unit)).or_default().add(index, log.latency(&entry));
            }
            if let Some(usual) = usual.filter(|_| entry.counts()) {
                if before.is_some_and(|before| is_hasty(&before, &entry, usual)) {
                    sums.hasty.add(index, None);
                }
                before = Some(entry);
            }
        }
        sums
    }
}

/// Whether a request comes before an answer to the one before it could, where that usually takes so long.
fn is_hasty(before: &Entry, entry: &Entry, usual: u32) -> bool {
    let asked = before.direction == Direction::Request && before.asks();
    let serial = || entry.protocol().waiting == 1;
    asked
        && entry.asks()
        && serial()
        && matches!((before.time(), entry.time()), (Some(then), Some(now))
            if (0..i64::from(usual) / 2).contains(&(now - then)))
}

//! What can be seen at a glance: telegrams, errors and response times over time, and the values of
//! a register.

use std::collections::BTreeMap;

use super::filter::is_error;
use super::{Bytes, Entry, Log, Source};
use crate::field::Direction;

/// A log cut into equal stretches.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timeline {
    /// The stretches are of time, in microseconds; otherwise of telegrams.
    pub timed: bool,
    pub from: i64,
    pub to: i64,
    pub buckets: Vec<Bucket>,
}

/// What happened in a stretch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bucket {
    pub telegrams: u32,
    pub errors: u32,
    /// Microseconds from request to response, on average.
    pub latency: Option<u32>,
    pub worst: Option<u32>,
}

/// A value at a place of the log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub index: usize,
    pub time: Option<i64>,
    pub value: f64,
}

/// A register that a log has values of.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(serde::Serialize, serde::Deserialize))]
pub struct Held {
    pub unit: Option<u8>,
    pub address: u16,
    /// What the device's manual calls it; empty where it has no name.
    pub name: String,
}

impl Log {
    /// Cuts the log, or those of its telegrams that `chosen` names, into `count` stretches.
    pub fn timeline(&self, chosen: Option<&[u32]>, count: usize) -> Timeline {
        let entries = self.entries();
        let all = entries.len();
        let timed = self.statistics().times.filter(|(from, to)| to > from);
        let (from, to) = timed.unwrap_or((0, all.saturating_sub(1) as i64));
        let mut buckets = vec![(Bucket::default(), 0_u64, 0_u64); count.max(1)];
        let mut add = |index: usize, entry: &Entry| {
            let at = match timed {
                Some(_) => entry.time(),
                None => Some(index as i64),
            };
            let Some(at) = at else { return };
            let [at, from, to] = [at, from, to].map(i128::from);
            let place = ((at - from) * count as i128 / ((to - from).max(0) + 1)) as usize;
            let Some((bucket, sum, answers)) = buckets.get_mut(place) else { return };
            bucket.telegrams += u32::from(entry.counts());
            bucket.errors += u32::from(is_error(entry));
            if entry.direction == Direction::Response
                && let Some(latency) = self.latency(entry)
            {
                *sum += u64::from(latency);
                *answers += 1;
                bucket.worst = bucket.worst.max(Some(latency));
            }
        };
        match chosen {
            Some(chosen) => {
                chosen.iter().for_each(|index| add(*index as usize, &self.entry(*index as usize)));
            }
            None => entries.iter().enumerate().for_each(|(index, entry)| add(index, &entry)),
        }
        let average = |(bucket, sum, answers): (Bucket, u64, u64)| Bucket {
            latency: (answers > 0).then(|| (sum / answers) as u32),
            ..bucket
        };
        Timeline { timed: timed.is_some(), from, to, buckets: buckets.into_iter().map(average).collect() }
    }

    /// The values of register `address` of `unit`, as they were read and written, at most `most` of
    /// them. Where the device's manual knows what stands there, its value is meant, else the number
    /// in the register.
    pub fn series(&self, source: &dyn Source, unit: Option<u8>, address: u16, most: usize) -> Vec<Point> {
        let mut bytes = Bytes::new(self, source);
        let mut holds = |entry: &Entry| {
            let right = entry.unit == unit && entry.counts() && !entry.refuses();
            // What is read stands in the response, what is written in the request.
            let reads = matches!(entry.function, 3 | 4 | 100);
            right
                && reads == (entry.direction == Direction::Response)
                && self.registers_in(&mut bytes, entry).is_some_and(|(start, count)| {
                    address >= start && usize::from(address - start) < usize::from(count)
                })
        };
        let found: Vec<usize> = self
            .entries()
            .iter()
            .enumerate()
            .filter(|(_, entry)| holds(entry))
            .map(|(index, _)| index)
            .collect();
        let step = found.len().div_ceil(most.max(1)).max(1);
        let point = |index: &usize| {
            let entry = self.entry(*index);
            Some(Point { index: *index, time: entry.time(), value: self.value(source, *index, address)? })
        };
        found.iter().step_by(step).filter_map(point).collect()
    }

    /// The registers that the log has values of, by unit and address, with their names where the device's
    /// manual has one.
    pub fn held(&self, source: &dyn Source) -> Vec<Held> {
        /// Each has registers of its own; a log that asks for more of them is not one that is looked through.
        const RANGES: usize = 200;
        let mut ranges: BTreeMap<(Option<u8>, u16, u16), usize> = BTreeMap::new();
        let mut bytes = Bytes::new(self, source);
        for (index, entry) in self.entries().iter().enumerate() {
            let carries = match entry.direction {
                Direction::Response => matches!(entry.function, 3 | 4 | 100) && !entry.refuses(),
                Direction::Request => matches!(entry.function, 6 | 16 | 101),
            };
            if carries
                && entry.counts()
                && ranges.len() < RANGES
                && let Some((start, count)) = self.registers_in(&mut bytes, &entry)
            {
                ranges.entry((entry.unit, start, count)).or_insert(index);
            }
        }
        let mut held: BTreeMap<(Option<u8>, u16), String> = BTreeMap::new();
        for ((unit, start, _), index) in ranges {
            let (report, place) = self.report_of(source, index);
            let Some(detail) = report.detail(place) else { continue };
            for block in &detail.device.blocks {
                held.insert((unit, block.from), block.label().sentence());
            }
            let named = |address: u16| {
                detail.device.blocks.iter().any(|block| (block.from..=block.to).contains(&address))
            };
            let count = u16::try_from(detail.values.len()).unwrap_or(u16::MAX);
            for address in (start..start.saturating_add(count)).filter(|address| !named(*address)) {
                held.entry((unit, address)).or_default();
            }
        }
        let held = held.into_iter().map(|((unit, address), name)| Held { unit, address, name });
        held.collect()
    }

    /// The value of a register in telegram `index`.
    fn value(&self, source: &dyn Source, index: usize, address: u16) -> Option<f64> {
        let (report, place) = self.report_of(source, index);
        let detail = report.detail(place)?;
        let mut blocks = detail.device.blocks.iter();
        let known =
            blocks.find(|block| (block.from..=block.to).contains(&address)).and_then(|block| block.value());
        let number = known.and_then(|text| {
            lexical_core::parse::<f64>(text.to_string().replace('\u{2212}', "-").as_bytes()).ok()
        });
        let raw = || {
            let at = usize::from(address.checked_sub(detail.start?)?);
            detail.values.get(at).map(|value| f64::from(*value))
        };
        number.or_else(raw).filter(|value| value.is_finite())
    }
}

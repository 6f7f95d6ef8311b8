//! What happened over time, a lane for each unit.

#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};

use super::{Entry, Log, Role, State};
use crate::field::in_order;

/// A log cut into stretches of the same length, with a lane for each unit.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Lanes {
    /// The stretches are of time, in microseconds; otherwise of telegrams.
    pub timed: bool,
    pub from: i64,
    pub to: i64,
    /// How many stretches there are.
    pub stretches: usize,
    /// The busiest units. What is left over, and what only damaged telegrams name, is one lane more.
    pub lanes: Vec<Lane>,
}

#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Lane {
    pub port: u16,
    pub unit: Option<u8>,
    /// All other units, and damaged telegrams.
    pub others: bool,
    /// The stretches in which something happened, in their order.
    pub marks: Vec<Mark>,
}

/// What happened in a stretch.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Mark {
    /// Which stretch.
    pub at: usize,
    pub telegrams: usize,
    /// The gravest of its telegrams.
    pub state: State,
    /// The longest time from request to response in it, in microseconds.
    pub worst: Option<u32>,
}

/// More lanes are hard to tell apart.
const MOST: usize = 8;

impl Log {
    /// The log, or what of it lies from `between.0` to `between.1`, in so many stretches.
    pub fn lanes(&self, between: Option<(i64, i64)>, stretches: usize) -> Lanes {
        let stretches = stretches.max(1);
        let timed = self.statistics().times.filter(|(from, to)| to > from);
        let whole = timed.unwrap_or((0, self.entries().len().saturating_sub(1) as i64));
        let (from, to) = between.filter(|(from, to)| to >= from).unwrap_or(whole);
        let overview = self.overview();
        let units = overview.units.iter().map(|unit| (unit.telegrams, unit.port, unit.unit));
        let busiest = in_order(units, |(telegrams, ..)| std::cmp::Reverse(*telegrams)).into_iter().take(MOST);
        let units = in_order(busiest, |(_, port, unit)| (*port, *unit));
        let mut lanes: Vec<Lane> = units
            .iter()
            .map(|(_, port, unit)| Lane { port: *port, unit: *unit, ..Lane::default() })
            .collect();
        lanes.push(Lane { others: true, ..Lane::default() });
        let lane_of = |entry: &Entry| {
            let found = units.iter().position(|(_, port, unit)| (*port, *unit) == (entry.port, entry.unit));
            found.filter(|_| entry.role != Role::Discarded).unwrap_or(units.len())
        };
        let span = i128::from(to) - i128::from(from) + 1;
        // Most telegrams are of the same stretch as the one before: its first and last place.
        let (mut place, mut stretch) = (0, from..=from);
        for (index, entry) in self.entries().iter().enumerate() {
            let at = if timed.is_some() { entry.time() } else { Some(index as i64) };
            let Some(at) = at.filter(|at| (from..=to).contains(at)) else { continue };
            if !stretch.contains(&at) {
                let behind = (i128::from(at) - i128::from(from)) * stretches as i128 / span;
                let begins = |stretch: i128| {
                    i128::from(from) + (stretch * span + stretches as i128 - 1) / stretches as i128
                };
                place = behind as usize;
                stretch = begins(behind) as i64..=(begins(behind + 1) - 1) as i64;
            }
            let state = self.state(&entry);
            let worst = if state == State::Slow { self.latency(&entry) } else { None };
            let marks = &mut lanes[lane_of(&entry)].marks;
            // Times may run backwards for a while.
            let known = match marks.last() {
                Some(last) if last.at == place => Ok(marks.len() - 1),
                _ => marks.binary_search_by_key(&place, |mark| mark.at),
            };
            match known {
                Ok(known) => {
                    let mark = &mut marks[known];
                    mark.telegrams += 1;
                    mark.state = mark.state.max(state);
                    mark.worst = mark.worst.max(worst);
                }
                Err(new) => marks.insert(new, Mark { at: place, telegrams: 1, state, worst }),
            }
        }
        lanes.retain(|lane| !lane.others || !lane.marks.is_empty());
        Lanes { timed: timed.is_some(), from, to, stretches, lanes }
    }
}

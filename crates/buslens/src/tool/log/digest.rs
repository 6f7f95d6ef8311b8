//! A log in short, for a mail and a report.

use std::collections::HashMap;

use super::{Bytes, Entry, Finding, Log, Role, Source, State};
use crate::field::{Direction, in_order};
use crate::tool::digest::{self, Digest, Line, MOST, Party};

impl Log {
    /// The log in short, with these of its [`findings`](Self::findings).
    pub fn digest(&self, source: &dyn Source, findings: &[Finding]) -> Digest {
        let overview = self.overview();
        let (chosen, of) = self.that_matter(source, findings);
        let several = overview.ports.len() > 1;
        let units = overview.units.into_iter().map(|unit| {
            let name = unit.unit.map_or("The line".to_owned(), |unit| format!("Unit {unit}"));
            let port = self.port_name(unit.port).filter(|_| several);
            let name = port.map_or(name.clone(), |port| format!("{name} on {port}"));
            let device = self.options().device_of(unit.unit).map_or("", |device| device.label);
            Party { name, device: device.to_owned(), unit }
        });
        let finding = |finding: &Finding| digest::Finding {
            text: finding.text.sentence() + ".",
            telegrams: finding.evidence.len(),
        };
        let mut remarks = overview.remarks;
        remarks.extend(overview.fault);
        Digest {
            title: String::new(),
            read: overview.read,
            headline: overview.headline,
            remarks,
            findings: findings.iter().map(finding).collect(),
            units: units.collect(),
            telegrams: chosen
                .iter()
                .filter_map(|(index, times)| self.in_a_line(source, *index, *times))
                .collect(),
            of,
            wrong: true,
        }
    }

    fn in_a_line(&self, source: &dyn Source, index: u32, times: usize) -> Option<Line> {
        let entry = &self.entry(index as usize);
        if entry.role == Role::Discarded {
            let row = self.rows(source, &[index]).pop()?;
            return Some(Line {
                number: row.index + 1,
                time: row.time.map(super::time_text),
                unit: None,
                direction: None,
                said: row.said,
                state: row.state,
                latency: None,
                times,
                bytes: self.bytes(source, entry).into_owned(),
                faults: Vec::new(),
                fields: Vec::new(),
            });
        }
        let (report, place) = self.report_of(source, index as usize);
        Line::of(&report, place, self.state(entry)).map(|line| Line { times, ..line })
    }

    /// The telegrams that a person should look at, with how often the same happened, and how many such there
    /// are: what shows the findings, then of each state what happened most.
    fn that_matter(&self, source: &dyn Source, findings: &[Finding]) -> (Vec<(u32, usize)>, usize) {
        let entries = self.entries();
        let mut bytes = Bytes::new(self, source);
        let mut groups: HashMap<Event, (u32, usize)> = HashMap::new();
        for (entry, index) in entries.iter().zip(0_u32..) {
            if let Some(event) = self.event(&mut bytes, &entry) {
                groups.entry(event).or_insert((index, 0)).1 += 1;
            }
        }
        let of = groups.len();
        let mut chosen: Vec<(u32, usize)> = Vec::new();
        // What is not wrong by itself shows something by what it became.
        let is_wrong =
            |index: &&u32| entries.get(**index as usize).is_some_and(|entry| self.state(&entry).is_wrong());
        let shown = findings
            .iter()
            .filter_map(|finding| finding.evidence.iter().find(is_wrong).or(finding.evidence.last()));
        for index in shown {
            let event = entries.get(*index as usize).and_then(|entry| self.event(&mut bytes, &entry));
            let group = event.and_then(|event| groups.remove(&event)).unwrap_or((*index, 1));
            if chosen.len() < MOST && chosen.iter().all(|(other, _)| *other != group.0) {
                chosen.push(group);
            }
        }
        // Of each state in turn.
        let mut by_state: Vec<(State, Vec<(u32, usize)>)> =
            GRAVEST_FIRST.iter().map(|state| (*state, Vec::new())).collect();
        for (event, group) in groups {
            if let Some((_, list)) = by_state.iter_mut().find(|(state, _)| *state == event.state) {
                list.push(group);
            }
        }
        for (_, list) in &mut by_state {
            let all = std::mem::take(list);
            *list = in_order(all, |(index, times)| (*times, std::cmp::Reverse(*index)));
        }
        while chosen.len() < MOST && by_state.iter().any(|(_, list)| !list.is_empty()) {
            for (_, list) in &mut by_state {
                chosen.extend(list.pop().filter(|_| chosen.len() < MOST));
            }
        }
        let chosen = in_order(chosen, |group| *group);
        (chosen.clone(), of.max(chosen.len()))
    }

    /// What happened with a telegram; `None` if nothing is wrong with it.
    fn event(&self, bytes: &mut Bytes<'_>, entry: &Entry) -> Option<Event> {
        let state = self.state(entry);
        if !state.is_wrong() {
            return None;
        }
        // The same is what was asked for in the same way, and came to the same.
        let partner = entry.partner().filter(|_| entry.direction == Direction::Response);
        let asked = match (state, partner) {
            (State::Discarded, _) => &[],
            (State::Damaged | State::Cut, _) | (_, None) => bytes.of(entry),
            (_, Some(request)) => bytes.of(&self.entry(request)),
        };
        // Each request over Modbus TCP has a number of its own.
        let numbered = entry.protocol().waiting > 1 && state != State::Damaged;
        let asked = if numbered { asked.get(4..).unwrap_or_default() } else { asked };
        Some(Event {
            state,
            port: entry.port,
            unit: entry.unit.filter(|_| state != State::Discarded),
            asked: asked.to_vec(),
        })
    }
}

/// What happened, and to which request.
#[derive(PartialEq, Eq, Hash)]
struct Event {
    state: State,
    port: u16,
    unit: Option<u8>,
    asked: Vec<u8>,
}

const GRAVEST_FIRST: [State; 8] = [
    State::Damaged,
    State::Refused,
    State::Unanswered,
    State::Slow,
    State::Late,
    State::Unasked,
    State::Cut,
    State::Discarded,
];

//! A log as a list of rows, and what stands above the list: plain data that can go to another thread.

#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};

use super::{Dialog, Entry, Format, Log, Role, Source};
use crate::dialogue::Certainty;
use crate::field::{Direction, Message, hex, in_order, many};
use crate::frame::Verdict;
use crate::tool::decode::Report;

/// How it went with a telegram, in one word: the gravest that there is to say of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub enum State {
    /// A request that went its way, or a telegram that nothing is known of.
    Plain,
    /// A response as it should be.
    Ok,
    /// A request to all.
    Broadcast,
    /// The log has it twice.
    Copy,
    /// A request that came back to its sender over the same wires.
    Echo,
    /// A request that repeats one without an answer.
    Retry,
    /// A response that took much longer than others of its unit.
    Slow,
    /// A response that came after other requests.
    Late,
    /// A response that nobody asked for.
    Unasked,
    /// The server refuses.
    Refused,
    /// A request that nobody answered.
    Unanswered,
    /// Too short to be checked.
    Cut,
    /// Its check does not match.
    Damaged,
    /// Bytes that are no telegram.
    Discarded,
}

impl State {
    pub const ALL: [Self; 14] = [
        Self::Plain,
        Self::Ok,
        Self::Broadcast,
        Self::Copy,
        Self::Echo,
        Self::Retry,
        Self::Slow,
        Self::Late,
        Self::Unasked,
        Self::Refused,
        Self::Unanswered,
        Self::Cut,
        Self::Damaged,
        Self::Discarded,
    ];

    /// The word for it.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Plain => "sent",
            Self::Ok => "ok",
            Self::Broadcast => "to all",
            Self::Copy => "twice",
            Self::Echo => "echo",
            Self::Retry => "retry",
            Self::Slow => "slow",
            Self::Late => "late",
            Self::Unasked => "unexpected",
            Self::Refused => "rejected",
            Self::Unanswered => "unanswered",
            Self::Cut => "cut short",
            Self::Damaged => "damaged",
            Self::Discarded => "no telegram",
        }
    }

    /// The stable word of exports.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Plain => "sent",
            Self::Ok => "ok",
            Self::Broadcast => "broadcast",
            Self::Copy => "copy",
            Self::Echo => "echo",
            Self::Retry => "retry",
            Self::Slow => "slow",
            Self::Late => "late",
            Self::Unasked => "unasked",
            Self::Refused => "rejected",
            Self::Unanswered => "unanswered",
            Self::Cut => "cut",
            Self::Damaged => "damaged",
            Self::Discarded => "no-telegram",
        }
    }

    /// Whether a person should look at it.
    pub const fn is_wrong(self) -> bool {
        matches!(
            self,
            Self::Slow
                | Self::Late
                | Self::Unasked
                | Self::Refused
                | Self::Unanswered
                | Self::Cut
                | Self::Damaged
                | Self::Discarded
        )
    }
}

/// A telegram in the list.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Row {
    /// Its index in the log.
    pub index: usize,
    /// Microseconds as the log has them.
    pub time: Option<i64>,
    /// Microseconds since the telegram before it in the log.
    pub delta: Option<i64>,
    pub unit: Option<u8>,
    pub function: u8,
    /// `None` for what is no telegram.
    pub direction: Option<Direction>,
    /// What it says, without who says it.
    pub said: String,
    pub state: State,
    /// Microseconds from the request to this response.
    pub latency: Option<u32>,
}

/// What there is to say of the whole log.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Overview {
    /// What the file is: "QModMaster bus monitor".
    pub format: String,
    /// What most of its telegrams are.
    pub protocol: String,
    /// The log in one sentence.
    pub headline: String,
    /// What was read: "104 telegrams of Modbus RTU in 104 lines".
    pub read: String,
    /// What there is to say besides the units.
    pub remarks: Vec<String>,
    /// What kept the file from being read to its end.
    pub fault: Option<String>,
    /// All rows, those of no telegram included.
    pub rows: usize,
    pub telegrams: usize,
    /// Rows that a person should look at.
    pub wrong: usize,
    pub lines: usize,
    /// Unread lines.
    pub unread: usize,
    /// The first and the last time.
    pub times: Option<(i64, i64)>,
    /// They are UTC, as captures have them; others are whatever the program took for the time.
    pub utc: bool,
    pub units: Vec<Unit>,
    pub functions: Vec<u8>,
    /// Lines and connections with their names, where there are several.
    pub ports: Vec<(u16, String)>,
}

/// What a unit was asked, and what came of it.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Unit {
    pub port: u16,
    /// `None` where the protocol has none.
    pub unit: Option<u8>,
    pub functions: Vec<u8>,
    pub telegrams: usize,
    pub requests: usize,
    pub answered: usize,
    pub unanswered: usize,
    pub retries: usize,
    pub refused: usize,
    pub damaged: usize,
    /// Microseconds from request to response.
    pub median: Option<u32>,
    pub worst: Option<u32>,
}

impl Log {
    /// How it went with a telegram.
    pub fn state(&self, entry: &Entry) -> State {
        match (entry.role, entry.verdict) {
            (Role::Discarded, _) => State::Discarded,
            (Role::Copy, _) => State::Copy,
            (_, Verdict::Wrong) => State::Damaged,
            (_, Verdict::Unchecked) => State::Cut,
            (Role::Echo, _) => State::Echo,
            _ if entry.refuses() => State::Refused,
            _ if entry.unanswered() => State::Unanswered,
            (Role::Late, _) => State::Late,
            (Role::Unasked, _) => State::Unasked,
            (Role::Retry, _) => State::Retry,
            (Role::Broadcast, _) => State::Broadcast,
            _ if self.is_slow(entry) => State::Slow,
            _ if entry.direction == Direction::Response => State::Ok,
            _ => State::Plain,
        }
    }

    /// Whether a response took much longer than is usual for its unit and function.
    pub(super) fn is_slow(&self, entry: &Entry) -> bool {
        if !self.some_slow || entry.direction == Direction::Request {
            return false;
        }
        let Some(latency) = self.latency(entry) else { return false };
        let key = (entry.port, entry.unit, entry.plain_function());
        let dialogs = &self.statistics().dialogs;
        let at = dialogs.binary_search_by_key(&key, |dialog| (dialog.port, dialog.unit, dialog.function));
        at.is_ok_and(|at| is_slow(&dialogs[at], latency))
    }

    /// The rows of the telegrams `indices`.
    pub fn rows(&self, source: &dyn Source, indices: &[u32]) -> Vec<Row> {
        let entries = self.entries();
        let telegrams = indices.iter().map(|index| *index as usize).filter(|index| *index < entries.len());
        // A response says more when its request is known.
        let read =
            self.with_partners(telegrams.clone().filter(|index| self.entry(*index).role != Role::Discarded));
        let report = self.report(source, &read);
        let row = |index: usize| {
            let entry = &self.entry(index);
            let before = index.checked_sub(1).and_then(|before| entries.time(before));
            let place = read.binary_search(&index).ok();
            let said = place.and_then(|place| report.detail(place)).map(|detail| brief(&detail.said));
            Row {
                index,
                time: entry.time(),
                delta: entry.time().zip(before).map(|(time, before)| time - before),
                unit: entry.unit.filter(|_| entry.role != Role::Discarded),
                function: entry.plain_function(),
                direction: (entry.role != Role::Discarded).then_some(entry.direction),
                said: said.unwrap_or_else(|| self.discarded(source, entry)),
                state: self.state(entry),
                latency: self.latency(entry).filter(|_| entry.direction == Direction::Response),
            }
        };
        telegrams.map(row).collect()
    }

    fn discarded(&self, source: &dyn Source, entry: &Entry) -> String {
        const SHOWN: usize = 24;
        let bytes = self.bytes(source, entry);
        let more = if bytes.len() > SHOWN { " …" } else { "" };
        let count = Message::bytes(bytes.len());
        format!("{count} of no telegram: {}{more}", hex(&bytes[..bytes.len().min(SHOWN)]))
    }

    /// What there is to say of the whole log.
    pub fn overview(&self) -> Overview {
        let all = self.statistics();
        let said = |sentence: &Message| sentence.sentence() + ".";
        let units = self.unit_rows();
        let dialogs = all.dialogs.iter().filter(|dialog| dialog.check_failed < dialog.telegrams);
        let functions = dialogs.clone().map(|dialog| dialog.function).filter(|function| *function > 0);
        let mut functions = in_order(functions, |function| *function);
        functions.dedup();
        let mut ports: Vec<(u16, String)> =
            dialogs.filter_map(|dialog| Some((dialog.port, self.port_name(dialog.port)?))).collect();
        ports.dedup();
        Overview {
            format: self.format().name(),
            protocol: self.protocol().label.to_owned(),
            headline: headline(all.telegrams, all.check_failed, &units),
            read: self.story().first().map_or(String::new(), said),
            remarks: self.remarks().iter().map(said).collect(),
            fault: self.fault(),
            rows: self.entries().len(),
            telegrams: all.telegrams,
            wrong: self.sums().wrong,
            lines: self.lines() as usize,
            unread: self.unread().len(),
            times: all.times,
            utc: matches!(self.format(), Format::Capture { .. }),
            units,
            functions,
            ports,
        }
    }

    /// A row for each unit. What only damaged telegrams name is no unit: the damage made it up.
    fn unit_rows(&self) -> Vec<Unit> {
        let mut units: Vec<Unit> = Vec::new();
        for dialog in &self.statistics().dialogs {
            if dialog.check_failed == dialog.telegrams {
                continue;
            }
            let same = |unit: &Unit| (unit.port, unit.unit) == (dialog.port, dialog.unit);
            if !units.last().is_some_and(same) {
                units.push(Unit { port: dialog.port, unit: dialog.unit, ..Unit::default() });
            }
            let Some(unit) = units.last_mut() else { continue };
            if dialog.function > 0 {
                unit.functions.push(dialog.function);
            }
            unit.telegrams += dialog.telegrams;
            unit.requests += dialog.requests;
            unit.answered += dialog.answered;
            unit.unanswered += dialog.unanswered;
            unit.retries += dialog.retries;
            unit.refused += dialog.exceptions;
            unit.damaged += dialog.check_failed;
            unit.median = unit.median.max(dialog.median);
            unit.worst = unit.worst.max(dialog.worst);
        }
        units
    }
}

impl Report {
    /// How it went with telegram `index`, as far as the telegrams beside it tell.
    pub fn state(&self, index: usize) -> State {
        let Some(telegram) = self.telegrams.get(index) else { return State::Plain };
        if let Some(state) = telegram.state {
            return state;
        }
        let told = telegram.guess.certainty != Certainty::Open;
        let request = telegram.guess.direction == Direction::Request;
        match telegram.verdict {
            Verdict::Wrong => return State::Damaged,
            Verdict::Unchecked => return State::Cut,
            Verdict::Right | Verdict::NoCheck => {}
        }
        let exchange = (telegram.choice.protocol.exchange)(&telegram.line.bytes);
        if told && !request && self.detail(index).is_some_and(|detail| detail.exception.is_some()) {
            State::Refused
        } else if told && request {
            // The last one may still be answered.
            let last = index + 1 == self.telegrams.len();
            let waits = telegram.answered_by.is_none() && exchange.is_some() && !last;
            if waits { State::Unanswered } else { State::Plain }
        } else if told {
            State::Ok
        } else {
            State::Plain
        }
    }
}

/// Whether a response of so many microseconds took much longer than others of its dialog.
pub(super) fn is_slow(dialog: &Dialog, latency: u32) -> bool {
    /// Less than this nobody notices.
    const LEAST: u32 = 100_000;
    latency >= LEAST && dialog.median.is_some_and(|median| latency / 5 > median)
}

/// What a telegram says, in a list that has columns for who speaks and to whom.
pub fn brief(said: &Message) -> String {
    let Some((_, who)) = said.arguments.iter().find(|(name, _)| *name == "who") else {
        return said.sentence();
    };
    let (text, who) = (said.to_string(), who.to_string());
    let rest = text.strip_prefix(&who).map(|rest| rest.trim_start_matches([' ', ',', ':']));
    let mut brief = match rest {
        Some(rest) => {
            let endings = [
                ("confirms the write: ", "written: "),
                ("answers: ", ""),
                ("answers with ", ""),
                ("rejects the request: ", ""),
            ];
            let short = endings.iter().find_map(|(long, short)| Some((short, rest.strip_prefix(long)?)));
            short.map_or_else(|| rest.to_owned(), |(short, rest)| format!("{short}{rest}"))
        }
        None => {
            let asked = text.replacen(&format!("ask {who} for "), "read ", 1);
            let written = asked.replacen(&format!("write to {who}: "), "write ", 1);
            written.replacen(&format!(" of {who}"), "", 1)
        }
    };
    if let Some(first) = brief.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    brief
}

/// The log in one sentence.
fn headline(telegrams: usize, damaged: usize, units: &[Unit]) -> String {
    if telegrams == 0 {
        return "There is no telegram in this log.".to_owned();
    }
    let name = |unit: &Unit| unit.unit.map_or("the other side".to_owned(), |unit| format!("unit {unit}"));
    let asked: Vec<&Unit> = units.iter().filter(|unit| unit.requests > 0).collect();
    let silent: Vec<&Unit> =
        asked.iter().copied().filter(|unit| unit.answered == 0 && unit.unanswered > 0).collect();
    let mut clauses = Vec::new();
    match (asked.len(), &silent[..]) {
        (0, _) => clauses.push(many(telegrams, "telegram")),
        (1, []) => clauses.push(format!("{} answers", name(asked[0]))),
        (n, []) => clauses.push(format!("all {n} units answer")),
        (1, [unit]) => clauses.push(format!("{} does not answer", name(unit))),
        (n, [unit]) => clauses.push(format!("{} of {n} units answer; {} is silent", n - 1, name(unit))),
        (n, silent) if n == silent.len() => clauses.push(format!("none of {n} units answers")),
        (n, silent) => {
            clauses.push(format!("{} of {n} units answer, {} are silent", n - silent.len(), silent.len()))
        }
    }
    let sum = |count: fn(&Unit) -> usize| asked.iter().map(|unit| count(unit)).sum::<usize>();
    let lost = sum(|unit| unit.unanswered) - silent.iter().map(|unit| unit.unanswered).sum::<usize>();
    let refused = sum(|unit| unit.refused);
    if lost > 0 {
        clauses.push(format!("{} went unanswered", many(lost, "request")));
    }
    if damaged > 0 {
        clauses.push(format!("{} damaged", many(damaged, "telegram")));
    }
    if refused > 0 {
        clauses.push(format!("{} rejected", many(refused, "request")));
    }
    let mut text = clauses.join("; ") + ".";
    if let Some(first) = text.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::message;

    #[test]
    fn a_row_does_not_repeat_its_columns() {
        let who = || message!("unit {n}", n = 1_u8);
        let things = || message!("{n} = 5", n = 200_u8);
        for (said, expected) in [
            (message!("{who} answers: {things}", who = who(), things = things()), "200 = 5"),
            (message!("ask {who} for {things}", who = who(), things = things()), "Read 200 = 5"),
            (message!("write to {who}: {things}", who = who(), things = things()), "Write 200 = 5"),
            (
                message!("{who} confirms the write: {things}", who = who(), things = things()),
                "Written: 200 = 5",
            ),
            (message!("{who} rejects the request: {things}", who = who(), things = things()), "200 = 5"),
            (message!("nothing of that"), "Nothing of that"),
        ] {
            assert_eq!(brief(&said), expected);
        }
    }

    #[test]
    fn damage_makes_no_units() {
        let text = "01 03 00 C8 00 01 05 F4\n01 03 02 00 05 78 47\n41 03 00 C8 00 01 05 F4\n";
        let log = Log::read(text.as_bytes(), &super::super::Reading::default(), Default::default()).unwrap();
        let overview = log.overview();
        let units: Vec<_> = overview.units.iter().map(|unit| unit.unit).collect();
        assert_eq!(units, [Some(1)]);
        let rows = log.rows(&text.as_bytes(), &[0, 1, 2]);
        let states: Vec<_> = rows.iter().map(|row| row.state).collect();
        assert_eq!(states, [State::Plain, State::Ok, State::Damaged]);
    }
}

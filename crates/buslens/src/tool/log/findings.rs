//! What is wrong in the plant, as far as a log tells: one cause behind many symptoms, with evidence.

use std::collections::{BTreeMap, HashMap};
use std::hash::Hash;

use super::sums::{Shown, Sums};
use super::{Dialog, Entry, Log, Role, Source};
use crate::dialogue::Cause;
use crate::field::{Message, grouped, many};
use crate::frame::Verdict;
use crate::message;
use crate::tool::{Proposal, ValueFinding, value_findings};

/// Something that explains much of what went wrong.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The stable word of exports.
    pub code: &'static str,
    /// What it is, and what to do about it.
    pub text: Message,
    /// The indices of telegrams that show it.
    pub evidence: Vec<u32>,
}

/// So many telegrams are shown as evidence.
pub(super) const EVIDENCE: usize = 1000;

impl Log {
    /// The findings, the gravest first. It takes as long as explaining some hundred telegrams.
    pub fn findings(&self, source: &dyn Source) -> Vec<Finding> {
        let mut findings = Vec::new();
        findings.extend(self.of_checks(source));
        findings.extend(self.of_noise());
        findings.extend(self.of_silence());
        findings.extend(self.of_refusals());
        findings.extend(self.of_lateness());
        findings.extend(self.of_slowness());
        findings.extend(self.of_clients());
        findings.extend(self.of_pauses());
        findings.extend(self.of_values(source));
        findings
    }

    /// Which devices the units look like, where none is chosen; by the beginning of the log.
    pub fn proposals(&self, source: &dyn Source) -> Vec<Proposal> {
        /// A device shows in few of them.
        const ENOUGH: usize = 500;
        let mut indices = self.beginning();
        indices.truncate(ENOUGH);
        let mut found = crate::tool::proposals(&self.report(source, &indices));
        for proposal in &mut found {
            proposal.evidence = proposal.evidence.iter().filter_map(|at| indices.get(*at)).copied().collect();
        }
        found
    }

    /// What the values show, by the beginning of the log.
    fn of_values(&self, source: &dyn Source) -> Vec<Finding> {
        if self.options().devices().next().is_none() {
            return Vec::new();
        }
        let indices = self.beginning();
        let found = value_findings(&self.report(source, &indices)).into_iter();
        let finding = |found: ValueFinding| {
            let evidence = found.evidence.iter().filter_map(|at| Some(*indices.get(*at)? as u32));
            Finding { code: found.code, text: found.text, evidence: evidence.take(EVIDENCE).collect() }
        };
        found.map(finding).collect()
    }

    /// As many telegrams from the first on as can be read one by one.
    fn beginning(&self) -> Vec<usize> {
        const MOST: usize = 4000;
        let counted = self.entries().iter().enumerate().filter(|(_, entry)| entry.counts());
        counted.map(|(index, _)| index).take(MOST).collect()
    }

    fn indices(&self, chosen: impl Fn(&Entry) -> bool) -> Vec<u32> {
        let entries = self.entries().iter().zip(0_u32..);
        entries.filter(|(entry, _)| chosen(entry)).map(|(_, index)| index).take(EVIDENCE).collect()
    }

    /// One cause behind most failed checks.
    fn of_checks(&self, source: &dyn Source) -> Option<Finding> {
        /// So many are explained, spread over the log.
        const SAMPLE: usize = 300;
        const FEWEST: usize = 3;
        let failed = self.sums().failed;
        if failed == 0 {
            return None;
        }
        let entries = self.entries().iter().enumerate();
        let wrong = entries
            .filter(|(_, entry)| entry.verdict == Verdict::Wrong && entry.role != Role::Discarded)
            .map(|(index, _)| index);
        let sample: Vec<usize> = wrong.step_by(failed.div_ceil(SAMPLE)).collect();
        let mut causes: BTreeMap<&'static str, (Cause, Vec<u32>)> = BTreeMap::new();
        for index in &sample {
            let (report, place) = self.report_of(source, *index);
            if let Some(best) = report.explanations(place).into_iter().next() {
                let cause = best.hypothesis.cause;
                causes.entry(cause.key()).or_insert((cause, Vec::new())).1.push(*index as u32);
            }
        }
        let (cause, evidence) = causes.into_values().max_by_key(|(_, evidence)| evidence.len())?;
        if evidence.len() < FEWEST || evidence.len() * 10 < sample.len() * 6 {
            return None;
        }
        let (what, advice) = advice(cause);
        let of = match sample.len() < failed {
            true => {
                format!("{} looked at ({} in all)", many(sample.len(), "wrong checksum"), grouped(failed))
            }
            false => many(sample.len(), "wrong checksum"),
        };
        Some(Finding {
            code: cause.key(),
            text: message!(
                "{n} of {of}: {what}. {advice}",
                n = grouped(evidence.len()),
                of = of,
                what = what.to_owned(),
                advice = advice.to_owned()
            ),
            evidence,
        })
    }

    /// Much that is no telegram at all.
    fn of_noise(&self) -> Option<Finding> {
        let Sums { bytes: all, lost, .. } = *self.sums();
        let bad = |entry: &Entry| entry.role == Role::Discarded || entry.verdict == Verdict::Wrong;
        (all > 200 && lost * 2 > all).then(|| Finding {
            code: "not-understood",
            text: message!(
                "{percent} % of the bytes are no right telegram: suspect the baud rate, parity or stop bits that the log was taken with, or another protocol",
                percent = lost * 100 / all
            ),
            evidence: self.indices(bad),
        })
    }

    /// Units that never answer.
    fn of_silence(&self) -> Vec<Finding> {
        const FEWEST: usize = 5;
        let silent = |unit: &Dialog| unit.requests >= FEWEST && unit.answered == 0 && unit.unit.is_some();
        let silent: Vec<Dialog> = self.units().into_iter().filter(silent).collect();
        let evidence = self.evidence(
            silent.iter().map(|unit| (unit.port, unit.unit)),
            |entry| (entry.port, entry.unit),
            Entry::unanswered,
        );
        let of_unit = |(unit, evidence): (&Dialog, Vec<u32>)| Finding {
            code: "unit-silent",
            text: message!(
                "Unit {unit} answered none of {n}: it is off, not connected, or has another address, baud rate or parity",
                unit = unit.unit.unwrap_or_default(),
                n = many(unit.requests, "request")
            ),
            evidence,
        };
        let mut findings: Vec<Finding> = silent.iter().zip(evidence).map(of_unit).collect();
        shorten(&mut findings, |n| message!("{n} more answered no request", n = many(n, "unit")));
        findings
    }

    /// Requests that are always refused.
    fn of_refusals(&self) -> Vec<Finding> {
        const FEWEST: usize = 3;
        let refused = |it: &&Dialog| {
            it.exceptions >= FEWEST && it.exceptions * 10 >= it.answered * 9 && it.unit.is_some()
        };
        let refused: Vec<&Dialog> = self.statistics().dialogs.iter().filter(refused).collect();
        let evidence = self.evidence(
            refused.iter().map(|it| (it.port, it.unit, it.function)),
            |entry| (entry.port, entry.unit, entry.plain_function()),
            Entry::refuses,
        );
        let of_dialog = |(dialog, evidence): (&&Dialog, Vec<u32>)| Finding {
            code: "always-refused",
            text: message!(
                "Unit {unit} rejects function {function}, {n} of {of}: does the device know it, and these addresses?",
                unit = dialog.unit.unwrap_or_default(),
                function = dialog.function,
                n = grouped(dialog.exceptions),
                of = many(dialog.answered, "time")
            ),
            evidence,
        };
        let mut findings: Vec<Finding> = refused.iter().zip(evidence).map(of_dialog).collect();
        shorten(&mut findings, |n| {
            message!("{n} more are always rejected by their units", n = many(n, "function"))
        });
        findings
    }

    /// The telegrams that show something of each of `keys`, found in one go.
    fn evidence<Key: Hash + Eq>(
        &self,
        keys: impl Iterator<Item = Key>,
        key: impl Fn(&Entry) -> Key,
        shows: impl Fn(&Entry) -> bool,
    ) -> Vec<Vec<u32>> {
        let places: HashMap<Key, usize> = keys.zip(0..).collect();
        let mut evidence = vec![Vec::new(); places.len()];
        if places.is_empty() {
            return evidence;
        }
        for (entry, index) in self.entries().iter().zip(0_u32..).filter(|(entry, _)| shows(entry)) {
            if let Some(place) = places.get(&key(&entry))
                && evidence[*place].len() < EVIDENCE
            {
                evidence[*place].push(index);
            }
        }
        evidence
    }

    /// Responses after the client had given up.
    fn of_lateness(&self) -> Option<Finding> {
        const FEWEST: usize = 3;
        let late = self.statistics().late;
        (late >= FEWEST).then(|| Finding {
            code: "too-late",
            text: message!(
                "{n} arrived after the client had given up: increase its timeout",
                n = many(late, "response")
            ),
            evidence: self.indices(|entry| entry.role == Role::Late),
        })
    }

    /// Units whose answers sometimes take much longer than usual.
    fn of_slowness(&self) -> Vec<Finding> {
        const FEWEST: usize = 3;
        let units = self.units();
        let of_unit = |((port, unit), slow): (&(u16, Option<u8>), &Shown)| {
            let usual = units.iter().find(|it| (it.port, it.unit) == (*port, *unit))?.median?;
            let who = unit.map_or("The server".to_owned(), |unit| format!("Unit {unit}"));
            let least = slow.least.filter(|_| slow.count >= FEWEST)?;
            Some(Finding {
                code: "slow-answers",
                text: message!(
                    "{who}: {n} took {least} ms or more, usually {usual} ms. See what it was busy with then, or let the \
                     client wait longer",
                    who = who,
                    n = many(slow.count, "answer"),
                    least = grouped(least as usize / 1000),
                    usual = grouped((usual as usize).div_ceil(1000))
                ),
                evidence: slow.first.clone(),
            })
        };
        let mut findings: Vec<Finding> = self.sums().slow.iter().filter_map(of_unit).collect();
        shorten(&mut findings, |n| message!("{n} more answered slowly at times", n = many(n, "unit")));
        findings
    }

    /// Requests before an answer to the last one could come.
    fn of_clients(&self) -> Option<Finding> {
        const FEWEST: usize = 5;
        let hasty = &self.sums().hasty;
        (hasty.count >= FEWEST).then(|| Finding {
            code: "two-clients",
            text: message!(
                "{n} sent before the previous one could be answered: are there two clients (masters) on the line?",
                n = many(hasty.count, "request")
            ),
            evidence: hasty.first.clone(),
        })
    }

    /// Pauses within telegrams, where the log has times for their parts.
    fn of_pauses(&self) -> Option<Finding> {
        const FEWEST: usize = 3;
        let long = self.traffic.pauses();
        let longest = long.iter().map(|(_, pause)| *pause).max()?;
        (long.len() >= FEWEST).then(|| Finding {
            code: "pauses-within",
            text: message!(
                "{n} came in parts, with pauses of up to {ms} ms within: for Modbus RTU a pause of 3.5 characters ends a telegram. Look at the converter's latency timer or buffer",
                n = many(long.len(), "telegram"),
                ms = longest as usize / 1000
            ),
            evidence: long.iter().map(|(index, _)| *index).take(EVIDENCE).collect(),
        })
    }
}

/// Puts all findings of a kind behind the first few into one, which says how many there are.
fn shorten(findings: &mut Vec<Finding>, more: impl FnOnce(usize) -> Message) {
    /// Nobody reads more of the same.
    const MOST: usize = 50;
    if findings.len() <= MOST + 1 {
        return;
    }
    let others = findings.split_off(MOST);
    let mut evidence: Vec<u32> = others.iter().flat_map(|finding| &finding.evidence).copied().collect();
    evidence.sort_unstable();
    evidence.truncate(EVIDENCE);
    findings.push(Finding { code: others[0].code, text: more(others.len()), evidence });
}

/// A cause in words, and what to do about it.
fn advice(cause: Cause) -> (&'static str, &'static str) {
    match cause {
        Cause::FlowControl => (
            "bytes 11h and 13h are being removed",
            "Switch off software flow control (XON/XOFF) on the converter or port",
        ),
        Cause::CheckSwapped => {
            ("the two bytes of the checksum are swapped", "The low byte goes first in Modbus RTU")
        }
        Cause::CheckMissing => {
            ("the checksum is missing", "Either the logging program or the sender leaves it out")
        }
        Cause::CheckWithoutAddress => {
            ("the checksum leaves out the address", "It covers all bytes, from the address on")
        }
        Cause::CheckOfOtherKind(_) => (
            "the checksum is of another kind",
            "Modbus RTU takes CRC-16 with polynomial 8005h reflected and start FFFFh",
        ),
        Cause::CheckCopied => {
            ("the checksum is that of another telegram", "Recalculate it for every telegram")
        }
        Cause::LineTurn => (
            "there are 00 or FF around the telegram",
            "The line floats when the direction changes: add bias resistors, or set the converter's turnaround time",
        ),
        Cause::EchoInFront | Cause::Joined => (
            "two telegrams are in one",
            "Switch off the echo of the converter, or let the program that logs part them at pauses",
        ),
        Cause::BitFlipped | Cause::ByteChanged => (
            "single bits or bytes were changed",
            "Check shield, ground, terminating resistors and the distance to power cables",
        ),
        Cause::ByteMissing | Cause::Cut => (
            "a byte is missing",
            "The receiver lost it: look at the buffer of the port, and at pauses within telegrams",
        ),
        Cause::ByteDoubled | Cause::ByteExtra | Cause::LeadingBytes | Cause::TrailingBytes => (
            "there are bytes too many",
            "Two devices may be transmitting at once, or the converter switches its direction too early",
        ),
        Cause::WordsSwapped => {
            ("the bytes of each word are swapped", "The high byte of a register goes first")
        }
        Cause::OtherProtocol => ("they are of another protocol", "Choose it above the list"),
        _ => ("the same is wrong with all", "Look at one of them for what it is"),
    }
}

//! What values tell that single telegrams do not: a state that turned, a value that stands still, a write
//! without effect, steps out of order.

use std::collections::BTreeMap;

use super::decode::Report;
use super::{Detail, Verdict};
use crate::field::{Argument, Direction, Field, Format, Message, Role, Value, count, in_order, leaves};
use crate::message;

/// Something that several telegrams show together.
#[derive(Clone, Debug)]
pub struct ValueFinding {
    /// The stable word of exports.
    pub code: &'static str,
    pub text: Message,
    /// The indices of the telegrams that show it.
    pub evidence: Vec<usize>,
}

/// What the values of a report show, in the order in which it begins. It needs a device: without one, a
/// register is a number.
pub fn value_findings(report: &Report) -> Vec<ValueFinding> {
    let mut follow = Follow::default();
    if report.options.devices().next().is_none() {
        return Vec::new();
    }
    for (index, telegram) in report.telegrams.iter().enumerate() {
        if telegram.verdict == Verdict::Wrong {
            continue;
        }
        let Some(detail) = report.detail(index) else { continue };
        follow.refusal(index, &detail);
        follow.order(index, &detail);
        for block in &detail.device.blocks {
            let values: Vec<&Field> = leaves(std::slice::from_ref(&block.field));
            if values.is_empty() || values.iter().all(|leaf| leaf.value.raw().is_none()) {
                continue;
            }
            let key = (telegram.unit, block.label().to_string());
            let seen = Seen {
                index,
                value: block.value().map(|value| value.to_string()).unwrap_or_default(),
                status: block.status().map(|status| status.to_string()).unwrap_or_default(),
            };
            follow.not_a_number(&key, index, &values);
            if detail.writes && telegram.guess.direction == Direction::Request {
                follow.written.insert(key, seen);
            } else if !detail.writes {
                follow.read(key, seen, &values);
            }
        }
    }
    follow.finish()
}

/// Unit and name of a block.
type Key = (Option<u8>, String);

/// A value as it was written or read.
#[derive(Clone, Debug)]
struct Seen {
    index: usize,
    value: String,
    status: String,
}

/// What a block held so far.
#[derive(Debug, Default)]
struct History {
    last: Option<Seen>,
    changes: usize,
    /// Since when it stands still, and the readings since then.
    still: Vec<usize>,
    moving: bool,
}

#[derive(Default)]
struct Follow {
    found: Vec<ValueFinding>,
    written: BTreeMap<Key, Seen>,
    histories: BTreeMap<Key, History>,
    /// What is found alike is told once, with all that shows it.
    alike: BTreeMap<String, usize>,
}

impl Follow {
    fn add(&mut self, code: &'static str, text: Message, evidence: Vec<usize>) {
        let said = format!("{code} {text}");
        match self.alike.get(&said) {
            Some(at) => self.found[*at].evidence.extend(evidence),
            None => {
                self.alike.insert(said, self.found.len());
                self.found.push(ValueFinding { code, text, evidence });
            }
        }
    }

    fn refusal(&mut self, index: usize, detail: &Detail) {
        if detail.exception.is_some()
            || detail.channel.as_ref().is_some_and(|channel| channel.refusal().is_some())
        {
            self.add("refused", detail.said.clone(), vec![index]);
        }
    }

    fn order(&mut self, index: usize, detail: &Detail) {
        const ORDER: &[&str] =
            &["order", "handshake-not-changed", "job-not-finished", "not-set-up", "handshake-changed"];
        let problems = detail.problems();
        let wrong: Vec<Message> = problems
            .iter()
            .filter(|problem| ORDER.contains(&problem.code))
            .map(|problem| problem.message.clone())
            .collect();
        for message in wrong {
            self.add("out-of-order", message, vec![index]);
        }
    }

    fn not_a_number(&mut self, key: &Key, index: usize, values: &[&Field]) {
        for leaf in values.iter().filter(|leaf| leaf.spec.format == Format::Float) {
            let text = leaf.value_text();
            let far = text.contains("NaN") || text.contains("infinity");
            // Numbers that makers put in place of a value.
            let stands_in =
                matches!(text.trim_start_matches('\u{2212}'), "999999" | "9999999" | "3.4028235e38" | "1e30");
            if far || stands_in {
                let text = message!(
                    "{what} is {value}, which is no measured value",
                    what = named(key),
                    value = text
                );
                self.add("no-value", text, vec![index]);
            }
        }
    }

    fn read(&mut self, key: Key, seen: Seen, values: &[&Field]) {
        if let Some(written) = self.written.get(&key)
            && !written.value.is_empty()
            && written.value != seen.value
            && is_state(values)
        {
            let text = message!(
                "{what} was written as {written}, but is read as {read}",
                what = named(&key),
                written = written.value.clone(),
                read = seen.value.clone()
            );
            let evidence = vec![written.index, seen.index];
            self.written.remove(&key);
            self.add("no-effect", text, evidence);
        }
        let history = self.histories.entry(key.clone()).or_default();
        history.moving |= values.iter().any(|leaf| leaf.spec.format == Format::Float);
        let Some(last) = history.last.replace(seen.clone()) else {
            history.still.push(seen.index);
            return;
        };
        if last.value == seen.value {
            history.still.push(seen.index);
        } else {
            history.changes += 1;
            history.still = vec![seen.index];
        }
        let (before, now) = (worth(&last.status), worth(&seen.status));
        if before != now {
            let text = message!(
                "{what} turned from {before} to {now}",
                what = named(&key),
                before = last.status,
                now = seen.status
            );
            let code = if now > before { "worse" } else { "better" };
            self.add(code, text, vec![last.index, seen.index]);
        }
    }

    fn finish(mut self) -> Vec<ValueFinding> {
        /// So often a value has to have changed before, and to be read the same then.
        const CHANGES: usize = 3;
        const STILL: usize = 10;
        for (key, history) in std::mem::take(&mut self.histories) {
            if let (true, CHANGES.., STILL.., Some(last)) =
                (history.moving, history.changes, history.still.len(), &history.last)
            {
                let text = message!(
                    "{what} stands at {value} for {n}, after it changed before",
                    what = named(&key),
                    value = last.value.clone(),
                    n = count(history.still.len(), "reading")
                );
                self.add("frozen", text, history.still);
            }
        }
        in_order(self.found, |finding| finding.evidence.first().copied())
    }
}

/// "Universal channel 3 of unit 1".
fn named((unit, name): &Key) -> Message {
    let name = Argument::Text(name.clone());
    match unit {
        Some(unit) => message!("{name} of unit {unit}", name = name, unit = *unit),
        None => message!("{name}", name = name),
    }
}

/// How bad a state is, by its words.
fn worth(status: &str) -> u8 {
    match status {
        "" => 0,
        good if good.starts_with("good") => 0,
        uncertain if uncertain.starts_with("uncertain") => 1,
        _ => 2,
    }
}

/// What stays as it was written: no measured value, and nothing that is a command.
fn is_state(values: &[&Field]) -> bool {
    values.iter().all(|leaf| {
        matches!(leaf.value, Value::Number { .. })
            && leaf.spec.format != Format::Float
            && leaf.spec.role != Role::Function
    })
}

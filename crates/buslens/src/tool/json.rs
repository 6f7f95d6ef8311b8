//! Telegrams as JSON Lines: one object for each telegram, then one summary. Keys that do not apply are left out.
//!
//! | key | value |
//! | --- | --- |
//! | `n` | running number from 1 |
//! | `line`, `offset` | first line of the text, from 1; or where it begins in a stream, which has no lines |
//! | `length`, `bytes` | how many bytes it has, and they themselves |
//! | `time` | when it was sent, as its log says |
//! | `protocol` | the key of its protocol |
//! | `direction` | `request`, `response` or `unknown` |
//! | `unit`, `function`, `exception` | numbers, the function without the bit of an exception |
//! | `check` | `kind`, `ok`, `found` and `computed`; not of telegrams without one |
//! | `state` | how it went: `ok`, `slow`, `late`, `unanswered`, `rejected`, `damaged` and so on |
//! | `start`, `count`, `values` | registers as numbers, coils as `true` and `false` |
//! | `index`, `subindex`, `handshake`, `service`, `error` | the parameter channel; the service is `none`, `read`, `write` or `both`, the error why a slave did not do a job: `class`, `code` and `additional` |
//! | `job` | the job of the parameter channel that it belongs to: its `number` and its `state`, which is `asked`, `running`, `done` or `failed` |
//! | `meaning` | a sentence |
//! | `device` | what the device's manual says about its registers or its parameter, see below |
//! | `pair` | the number of the request that it answers, or of its response |
//! | `latency_ms` | from the request to the response |
//! | `problems` | each with `code`, `text` and `span`; those of the text that it was written in have no span |
//! | `comment` | what a person noted on it |
//! | `hypotheses` | possible causes where the check is wrong, best first: `code`, `text`, `bytes` and `odds` |
//! | `fields` | if asked for: the tree of its fields, each with `key`, `label`, `span`, `value`, `text` and `fields` |
//!
//! A block of registers, or a parameter, has a `name`, a `value` (a number where it is one, or text), its `unit` and
//! `status`, the addresses that the telegram has of it as `register` (`215 to 217`), a `note`, the parameter that its
//! value `stands_for`, and as `facts` what the manual says of it whatever its value.

mod write;

use super::{Detail, Explanation, Report, Verdict};
use crate::device::Block;
use crate::field::{Bits, Check, Direction, Field, Span};
use crate::profibus::{self, jobs::Step};
use write::{Json, Object};

/// The whole report, a line for each telegram and one for the summary, each with its line end.
pub fn lines(report: &Report, fields: bool) -> String {
    let mut text = String::new();
    for index in 0..report.telegrams.len() {
        push_line(&mut text, report, index, fields);
        text.push('\n');
    }
    Object::write(&mut text, |last| last.object("summary", |object| write_summary(object, report)));
    text.push('\n');
    text
}

/// Telegram `index`, in a line without its end; nothing if there is none.
pub fn line(report: &Report, index: usize, fields: bool) -> String {
    let mut text = String::new();
    push_line(&mut text, report, index, fields);
    text
}

/// The same behind what `text` holds.
pub fn push_line(text: &mut String, report: &Report, index: usize, fields: bool) {
    if let Some(detail) = report.detail(index) {
        Object::write(text, |row| write_telegram(row, report, index, &detail, fields));
    }
}

fn write_telegram(row: &mut Object<'_>, report: &Report, index: usize, detail: &Detail, fields: bool) {
    let telegram = &report.telegrams[index];
    let line = &telegram.line;
    row.put("n", telegram.number);
    row.put("line", (line.number > 0).then_some(line.number));
    row.put("offset", (line.number == 0).then_some(line.span.from));
    row.put("length", line.bytes.len());
    row.put("time", telegram.time.as_deref());
    row.put("protocol", telegram.choice.protocol.key);
    row.put("direction", telegram.guess.told().map_or("unknown", Direction::key));
    row.put("bytes", line.bytes.as_slice());
    row.put("unit", detail.unit);
    row.put("function", detail.function);
    row.put("exception", detail.exception);
    if let (Some(check), Verdict::Right | Verdict::Wrong) = (detail.check(), telegram.verdict) {
        row.object("check", |object| write_check(object, &check));
    }
    row.put("state", report.state(index).key());
    row.put("start", detail.start);
    row.put("count", detail.count);
    row.list_if_any("values", &detail.values, |text, value| match detail.coils {
        true => (*value != 0).write(text),
        false => value.write(text),
    });
    if let Some(channel) = &detail.channel {
        write_channel(row, channel);
    }
    if let Some(Step { job, state, .. }) = &detail.step {
        row.object("job", |object| {
            object.put("number", *job);
            object.put("state", state.key());
        });
    }
    row.text("meaning", |text| {
        detail.meaning().push_sentence(text);
        text.push('.');
    });
    row.list_if_any("device", &detail.device.blocks, |text, block| {
        Object::write(text, |object| write_block(object, block));
    });
    let pair = telegram.answers.or(telegram.answered_by).and_then(|pair| report.telegrams.get(pair));
    row.put("pair", pair.map(|pair| pair.number));
    row.put("latency_ms", telegram.latency.map(|micros| f64::from(micros) / 1000.0));
    let problems = detail.problems().into_iter().map(|it| (it.code, &it.message, Some(it.span)));
    let remarks = line.remarks.iter().map(|it| (it.code, &it.message, None));
    row.list_if_any("problems", problems.chain(remarks), |text, (code, message, span)| {
        Object::write(text, |object| {
            object.put("code", code);
            object.text("text", |text| message.push_sentence(text));
            object.put("span", span);
        });
    });
    row.text_if_any("comment", |text| text.push_str(&telegram.comment));
    row.list_if_any("hypotheses", report.explanations(index), |text, explanation| {
        Object::write(text, |object| write_hypothesis(object, &explanation, &line.bytes));
    });
    if fields {
        row.list("fields", &detail.fields, write_field);
    }
}

fn write_check(object: &mut Object<'_>, check: &Check) {
    object.put("kind", check.kind);
    object.put("ok", check.ok());
    for (key, bytes) in [("found", check.found), ("computed", check.computed)] {
        object.put(key, &bytes.to_be_bytes()[8 - check.width..]);
    }
}

fn write_channel(row: &mut Object<'_>, channel: &profibus::Channel) {
    row.put("index", channel.index);
    row.put("subindex", channel.subindex);
    row.put("handshake", channel.handshake());
    row.put("service", channel.service().key());
    if let Some(refusal) = channel.refusal() {
        row.object("error", |object| {
            object.put("class", refusal.class);
            object.put("code", refusal.code);
            object.put("additional", refusal.additional);
        });
    }
}

fn write_block(object: &mut Object<'_>, block: &Block) {
    object.put("name", &block.label());
    if let Some(value) = block.value() {
        write_value(object, &value.to_string());
    }
    object.text_if_any("unit", |text| text.push_str(block.field.spec.unit));
    object.put("status", block.status().as_ref());
    object.put("register", block.registers().as_str());
    object.put("note", block.note.as_ref());
    object.put("stands_for", block.stands_for.as_ref());
    object.list_if_any("facts", &block.facts, |text, fact| fact.write(text));
}

/// A value as a number, where it is one, or as text.
fn write_value(object: &mut Object<'_>, value: &str) {
    let plain = value.replace('\u{2212}', "-");
    let number = || lexical_core::parse::<f64>(plain.as_bytes()).ok().filter(|number| number.is_finite());
    match (plain.parse::<i64>(), number()) {
        (Ok(whole), _) => object.put("value", whole),
        (_, Some(number)) => object.put("value", number),
        _ => object.put("value", value),
    }
}

fn write_hypothesis(object: &mut Object<'_>, explanation: &Explanation, found: &[u8]) {
    let hypothesis = &explanation.hypothesis;
    object.put("code", hypothesis.cause.key());
    object.text("text", |text| hypothesis.text(found).push_sentence(text));
    object.put("bytes", hypothesis.bytes.as_slice());
    object.put("odds", &hypothesis.odds());
}

/// A field with those within it, and with the parts of its number whose bits say something.
fn write_field(text: &mut String, field: &Field) {
    Object::write(text, |object| {
        object.put("key", field.spec.key);
        object.put("label", &field.label());
        object.put("span", field.span);
        object.put("value", field.value.raw());
        object.text_if_any("text", |text| {
            let from = text.len();
            field.push_value(text);
            let between = text.len();
            if let Some(meaning) = field.meaning() {
                text.push_str(if between > from { ": " } else { "" });
                let before = text.len();
                meaning.push_to(text);
                if text.len() == before {
                    text.truncate(between);
                }
            }
        });
        let parts = field.parts().map(Below::Part);
        object.list_if_any("fields", parts.chain(field.children.iter().map(Below::Field)), |text, below| {
            match below {
                Below::Part((part, value)) => write_part(text, part, value, field.span),
                Below::Field(field) => write_field(text, field),
            }
        });
    });
}

/// What is within a field.
enum Below<'a> {
    Part((&'static Bits, u64)),
    Field(&'a Field),
}

fn write_part(text: &mut String, part: &'static Bits, value: u64, span: Span) {
    Object::write(text, |object| {
        object.put("key", part.key);
        object.put("label", part.label);
        object.put("span", span);
        object.put("value", value);
        object.text_if_any("text", |text| text.push_str(part.name(value).map_or("", |name| name.label)));
    });
}

fn write_summary(object: &mut Object<'_>, report: &Report) {
    let summary = report.summary();
    object.put("telegrams", summary.telegrams);
    object.put("check_failed", summary.check_failed);
    object.put("pairs", summary.pairs);
    object.put("unanswered", summary.unanswered);
    object.put("unpaired", summary.unpaired);
    object.put("lines", summary.lines);
    object.put("lines_not_understood", summary.lines_not_understood);
    object.put("bytes_discarded", summary.bytes_discarded);
    object.put("layout", summary.layout);
}

//! Telegrams as JSON Lines: one object for each telegram, then one summary.

use serde::Serialize;

use super::{Detail, Explanation, Report, Telegram, Verdict};
use crate::device::Block;
use crate::field::{Direction, Field, Message, hex};
use crate::profibus;

/// One telegram. Keys that do not apply are left out.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Running number from 1.
    pub n: usize,
    /// First line of the text, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// Where it begins in a stream that has no lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset: Option<usize>,
    pub length: usize,
    /// When it was sent, as its log says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<String>,
    pub protocol: &'static str,
    /// `request`, `response` or `unknown`.
    pub direction: &'static str,
    pub bytes: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub function: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exception: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub check: Option<Check>,
    /// How it went: `ok`, `slow`, `late`, `unanswered`, `rejected`, `damaged` and so on.
    pub state: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<RawValue>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub channel: Option<Channel>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub job: Option<Job>,
    pub meaning: String,
    /// What the device's manual says about the registers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub device: Vec<Known>,
    /// The number of the request that this answers, or of its response.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pair: Option<usize>,
    /// From the request to the response.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latency_ms: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub problems: Vec<Problem>,
    /// What a person noted on it.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub comment: String,
    /// Possible causes where the check failed, best first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hypotheses: Vec<Hypothesis>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fields: Option<Vec<Node>>,
}

/// The parameter channel.
#[derive(Debug, Serialize)]
pub struct Channel {
    pub index: u16,
    pub subindex: u8,
    pub handshake: u8,
    /// `none`, `read`, `write` or `both`.
    pub service: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<Refusal>,
}

/// Why a slave did not do a job.
#[derive(Debug, Serialize)]
pub struct Refusal {
    pub class: u8,
    pub code: u8,
    pub additional: u16,
}

/// The job of the parameter channel that a telegram belongs to.
#[derive(Debug, Serialize)]
pub struct Job {
    pub number: usize,
    /// `asked`, `running`, `done` or `failed`.
    pub state: &'static str,
}

/// A register's number, or a coil's state.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum RawValue {
    Number(u32),
    Coil(bool),
}

/// A value as a number, where it is one, or as text.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Shown {
    Whole(i64),
    Number(f64),
    Text(String),
}

/// A block of registers, or a parameter.
#[derive(Debug, Serialize)]
pub struct Known {
    pub name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<Shown>,
    #[serde(skip_serializing_if = "str::is_empty")]
    pub unit: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub status: Option<String>,
    /// The addresses that the telegram has of it: `215 to 217`.
    pub register: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The parameter that the value stands for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stands_for: Option<String>,
    /// What the manual says of it whatever its value: other addresses, software versions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub facts: Vec<String>,
}

#[derive(Debug, Serialize)]
pub struct Check {
    pub kind: &'static str,
    pub ok: bool,
    pub found: String,
    pub computed: String,
}

/// A problem of the telegram, or (without a span) of the text it was written in.
#[derive(Debug, Serialize)]
pub struct Problem {
    pub code: &'static str,
    pub text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub span: Option<[usize; 2]>,
}

#[derive(Debug, Serialize)]
pub struct Hypothesis {
    pub code: &'static str,
    pub text: String,
    pub bytes: String,
    pub odds: String,
}

/// A field with those within it.
#[derive(Debug, Serialize)]
pub struct Node {
    pub key: &'static str,
    pub label: String,
    pub span: [usize; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<u64>,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub text: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fields: Vec<Node>,
}

/// The last object.
#[derive(Debug, Serialize)]
pub struct Last {
    pub summary: Summary,
}

#[derive(Debug, Serialize)]
pub struct Summary {
    pub telegrams: usize,
    pub check_failed: usize,
    pub pairs: usize,
    pub unanswered: usize,
    pub unpaired: usize,
    pub lines: usize,
    pub lines_not_understood: usize,
    pub bytes_discarded: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layout: Option<&'static str>,
}

/// The whole report, a line for each telegram and one for the summary, each with its line end.
pub fn lines(report: &Report, fields: bool) -> serde_json::Result<String> {
    let mut text = String::new();
    for index in 0..report.telegrams.len() {
        text += &line(report, index, fields)?;
        text.push('\n');
    }
    text += &serde_json::to_string(&last(report))?;
    text.push('\n');
    Ok(text)
}

/// Telegram `index`, in a line without its end; nothing if there is none.
pub fn line(report: &Report, index: usize, fields: bool) -> serde_json::Result<String> {
    let (Some(telegram), Some(detail)) = (report.telegrams.get(index), report.detail(index)) else {
        return Ok(String::new());
    };
    let pair = telegram.answers.or(telegram.answered_by).and_then(|pair| report.telegrams.get(pair));
    let mut row = row(telegram, pair, detail, report.state(index).key(), fields);
    let explained = report.explanations(index).into_iter();
    row.hypotheses = explained.map(|one| hypothesis(one, &telegram.line.bytes)).collect();
    serde_json::to_string(&row)
}

fn row(
    telegram: &Telegram,
    pair: Option<&Telegram>,
    detail: Detail,
    state: &'static str,
    fields: bool,
) -> Row {
    let line = &telegram.line;
    let problems = detail.problems().into_iter().map(|problem| Problem {
        code: problem.code,
        text: problem.message.sentence(),
        span: Some([problem.span.from, problem.span.to]),
    });
    let remarks = line.remarks.iter().map(|remark| Problem {
        code: remark.code,
        text: remark.message.sentence(),
        span: None,
    });
    Row {
        n: telegram.number,
        line: (line.number > 0).then_some(line.number),
        offset: (line.number == 0).then_some(line.span.from),
        time: telegram.time.clone(),
        latency_ms: telegram.latency.map(|micros| f64::from(micros) / 1000.0),
        length: line.bytes.len(),
        protocol: telegram.choice.protocol.key,
        direction: telegram.guess.told().map_or("unknown", Direction::key),
        bytes: hex(&line.bytes),
        unit: detail.unit,
        function: detail.function,
        exception: detail.exception,
        check: detail.check().filter(|_| matches!(telegram.verdict, Verdict::Right | Verdict::Wrong)).map(
            |check| Check {
                kind: check.kind,
                ok: check.ok(),
                found: check.found_bytes(),
                computed: check.computed_bytes(),
            },
        ),
        state,
        start: detail.start,
        count: detail.count,
        meaning: detail.meaning().sentence() + ".",
        pair: pair.map(|pair| pair.number),
        problems: problems.chain(remarks).collect(),
        comment: telegram.comment.clone(),
        hypotheses: Vec::new(),
        fields: fields.then(|| detail.fields.iter().map(node).collect()),
        channel: detail.channel.as_ref().map(channel),
        job: detail.step.as_ref().map(|step| Job { number: step.job, state: step.state.key() }),
        values: detail.values.iter().map(|value| raw(*value, detail.coils)).collect(),
        device: detail.device.blocks.iter().map(known).collect(),
    }
}

fn hypothesis(explanation: Explanation, found: &[u8]) -> Hypothesis {
    let hypothesis = explanation.hypothesis;
    Hypothesis {
        code: hypothesis.cause.key(),
        text: hypothesis.text(found).sentence(),
        odds: hypothesis.odds().to_string(),
        bytes: hex(&hypothesis.bytes),
    }
}

fn channel(channel: &profibus::Channel) -> Channel {
    Channel {
        index: channel.index,
        subindex: channel.subindex,
        handshake: channel.handshake(),
        service: channel.service().key(),
        error: channel.refusal().map(|refusal| Refusal {
            class: refusal.class,
            code: refusal.code,
            additional: refusal.additional,
        }),
    }
}

fn raw(value: u32, coil: bool) -> RawValue {
    if coil { RawValue::Coil(value != 0) } else { RawValue::Number(value) }
}

fn shown(text: String) -> Shown {
    let plain = text.replace('\u{2212}', "-");
    let number = || lexical_core::parse::<f64>(plain.as_bytes()).ok().filter(|number| number.is_finite());
    match (plain.parse(), number()) {
        (Ok(whole), _) => Shown::Whole(whole),
        (_, Some(number)) => Shown::Number(number),
        _ => Shown::Text(text),
    }
}

fn known(block: &Block) -> Known {
    let text = |message: Message| message.to_string();
    Known {
        name: text(block.label()),
        value: block.value().map(|value| shown(text(value))),
        unit: block.field.spec.unit,
        status: block.status().map(text),
        register: block.registers(),
        note: block.note.clone().map(text),
        stands_for: block.stands_for.clone().map(text),
        facts: block.facts.iter().map(Message::to_string).collect(),
    }
}

fn node(field: &Field) -> Node {
    let meaning = field.meaning().map(|meaning| meaning.to_string());
    let texts = [Some(field.value_text()), meaning];
    let text: Vec<String> = texts.into_iter().flatten().filter(|part| !part.is_empty()).collect();
    let span = [field.span.from, field.span.to];
    let parts = field.parts().map(|(part, value)| Node {
        key: part.key,
        label: part.label.to_owned(),
        span,
        value: Some(value),
        text: part.name(value).map_or(String::new(), |name| name.label.to_owned()),
        fields: Vec::new(),
    });
    Node {
        key: field.spec.key,
        label: field.label().to_string(),
        span,
        value: field.value.raw(),
        text: text.join(": "),
        fields: parts.chain(field.children.iter().map(node)).collect(),
    }
}

fn last(report: &Report) -> Last {
    let summary = report.summary();
    Last {
        summary: Summary {
            telegrams: summary.telegrams,
            check_failed: summary.check_failed,
            pairs: summary.pairs,
            unanswered: summary.unanswered,
            unpaired: summary.unpaired,
            lines: summary.lines,
            lines_not_understood: summary.lines_not_understood,
            bytes_discarded: summary.bytes_discarded,
            layout: summary.layout,
        },
    }
}

//! What holds for every telegram.

use buslens::field::{Field, Span, Value, hex, leaves};
use buslens::tool::log::Log;
use buslens::tool::{Report, Verdict, csv, json};
use serde::de::IgnoredAny;

/// The leaves cover the bytes without gap or overlap, and no field or problem lies outside them.
pub fn assert_tiled(fields: &[Field], bytes: &[u8]) {
    let mut position = 0;
    for leaf in leaves(fields) {
        assert_eq!(leaf.span.from, position, "{} of {}", leaf.spec.key, hex(bytes));
        position = leaf.span.to;
    }
    assert_eq!(position, bytes.len(), "{}", hex(bytes));
    assert_inside(fields, bytes);
}

/// No field and no problem lies outside the bytes.
pub fn assert_inside(fields: &[Field], bytes: &[u8]) {
    let inside = |span: Span, what: &str| {
        let ordered = span.from <= span.to && span.to <= bytes.len();
        assert!(ordered, "{what} at {span:?} of {}", hex(bytes));
    };
    for field in fields {
        field.visit(&mut |field| {
            inside(field.span, field.spec.key);
            field.problems.iter().for_each(|problem| inside(problem.span, problem.code));
            if let Value::Check(check) = field.value {
                inside(check.covered, "what a check covers");
            }
        });
    }
}

/// What is shown of telegram `index` of a report.
pub fn assert_telegram(report: &Report, index: usize) {
    let telegram = &report.telegrams[index];
    let bytes = &telegram.line.bytes;
    let detail = report.detail(index).expect("every telegram has its detail");
    assert_tiled(&detail.fields, bytes);
    detail.device.blocks.iter().for_each(|block| assert_inside(std::slice::from_ref(&block.field), bytes));
    for problem in detail.problems() {
        assert!(problem.span.to <= bytes.len(), "{} at {:?} of {}", problem.code, problem.span, hex(bytes));
        assert!(!problem.message.sentence().is_empty());
    }
    assert!(detail.registers.is_none_or(|span| span.to <= bytes.len()));
    assert!(!detail.meaning().sentence().is_empty());
    let check = detail.check().map(|check| check.ok());
    match telegram.verdict {
        Verdict::Right => assert_eq!(check, Some(true), "{}", hex(bytes)),
        Verdict::Wrong => assert_ne!(check, Some(true), "{}", hex(bytes)),
        Verdict::Unchecked | Verdict::NoCheck => {}
    }
    assert!(telegram.answers.is_none_or(|other| report.telegrams[other].answered_by == Some(index)));
    assert!(telegram.answered_by.is_none_or(|other| report.telegrams[other].answers == Some(index)));
}

/// The exports of telegram `index`: JSON parses, and its spans lie inside; rows have equal columns.
pub fn assert_exports(report: &Report, index: usize) {
    let line = json::line(report, index, true);
    let read: Result<IgnoredAny, _> = serde_json::from_str(&line);
    assert!(read.is_ok(), "no JSON: {line}");
    assert!(!line.contains('\n'), "more than a line: {line}");
    assert_eq!(columns(&csv::telegram(report, index)), columns(&csv::head()));
}

/// A table and JSON Lines of a whole report of `all` telegrams: rows have equal columns, every line parses.
pub fn assert_file(table: &str, lines: &str, all: usize) {
    // Only what is quoted can hold an end of a line.
    let mut rows = table.split_inclusive("\r\n").peekable();
    assert!(rows.peek().is_some(), "a table has a head");
    rows.for_each(|row| assert_eq!(columns(row), columns(&csv::head()), "{row}"));
    assert_eq!(lines.lines().count(), all + 1);
    for line in lines.lines() {
        let read: Result<IgnoredAny, _> = serde_json::from_str(line);
        assert!(read.is_ok(), "no JSON: {line}");
    }
}

/// How many columns a row has.
fn columns(row: &str) -> usize {
    let mut quoted = false;
    let commas = row.bytes().filter(|byte| {
        quoted ^= *byte == b'"';
        *byte == b',' && !quoted
    });
    let columns = commas.count() + 1;
    assert!(!quoted, "a quote is not closed: {row}");
    columns
}

/// Two readings of the same log say the same.
pub fn assert_same(parts: &Log, whole: &Log, file: &[u8], how: &str) {
    assert_eq!(parts.entries().len(), whole.entries().len(), "telegrams {how}");
    for (index, (one, other)) in parts.entries().iter().zip(whole.entries()).enumerate() {
        assert_eq!(one, other, "telegram {index} {how}");
        assert_eq!(parts.bytes(&file, &one), whole.bytes(&file, &other), "telegram {index} {how}");
    }
    assert_eq!(parts.unread(), whole.unread(), "lines without bytes {how}");
    assert_eq!(parts.lines(), whole.lines(), "lines {how}");
    assert_eq!(parts.statistics(), whole.statistics(), "statistics {how}");
    assert_eq!(parts.fault(), whole.fault(), "{how}");
}

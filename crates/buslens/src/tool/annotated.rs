//! A report as plain text for a mail or a ticket: every telegram with its bytes and what they say.

use super::digest::columns;
use super::{Report, Verdict};
use crate::field::{Direction, Severity, count, hex, shortest};

/// The whole report.
///
/// ```
/// use buslens::tool::{Options, annotated, decode};
///
/// let text = annotated::text(&decode("01 03 00 C8 00 03 84 35", Options::default()));
/// assert!(text.contains("00 C8"), "{text}");
/// ```
pub fn text(report: &Report) -> String {
    let mut text = summary(report);
    for index in 0..report.telegrams.len() {
        text.push('\n');
        text += &telegram(report, index);
    }
    for line in &report.not_understood {
        text += &format!("\nLine {}: no bytes found.\n", line.number);
    }
    text
}

/// "3 telegrams, 1 answered, 1 failed check".
pub fn summary(report: &Report) -> String {
    let summary = report.summary();
    let mut parts = vec![count(summary.telegrams, "telegram"), format!("{} answered", summary.pairs)];
    if summary.unanswered > 0 {
        parts.push(format!("{} unanswered", summary.unanswered));
    }
    parts.push(match (summary.check_failed, summary.checked) {
        (0, 0) => "nothing to check".to_owned(),
        (0, checked) if checked == summary.telegrams => "all checksums valid".to_owned(),
        (0, checked) => format!("{checked} checked, all valid"),
        (failed, _) => format!("{} wrong", count(failed, "checksum")),
    });
    if summary.lines_not_understood > 0 {
        parts.push(format!("{} left unread", count(summary.lines_not_understood, "line")));
    }
    format!("{}.\n", parts.join(", "))
}

/// Telegram `index`: what it says, its bytes, a line for each field, what is wrong.
pub fn telegram(report: &Report, index: usize) -> String {
    let (Some(telegram), Some(detail)) = (report.telegrams.get(index), report.detail(index)) else {
        return String::new();
    };
    let direction = telegram.guess.told().map_or("telegram", Direction::key);
    let bytes = &telegram.line.bytes;
    let asked = telegram.answers.and_then(|request| report.telegrams.get(request));
    let mut text = format!(
        "{}. {} {direction}{}: {}.\n   {}\n",
        telegram.number,
        telegram.choice.protocol.label,
        asked.map_or(String::new(), |request| format!(" to {}", request.number)),
        detail.meaning().sentence(),
        hex(bytes),
    );
    if let Some(time) = &telegram.time {
        text += &format!("   {time}");
        if let (Some(micros), Some(_)) = (telegram.latency, asked) {
            text += &format!(", {} ms after the request", shortest(f64::from(micros) / 1000.0));
        }
        text.push('\n');
    }
    if !telegram.comment.is_empty() {
        text += &format!("   Note: {}\n", telegram.comment);
    }
    for row in columns(&report.field_rows(index)) {
        text += &format!("   {row}\n");
    }
    for problem in detail.problems() {
        let mark = if problem.severity == Severity::Error { "Error" } else { "Warning" };
        text += &format!("   {mark}: {}.\n", problem.message.sentence());
    }
    if telegram.verdict == Verdict::Wrong {
        for explanation in report.explanations(index).into_iter().take(EXPLAINED) {
            let hypothesis = explanation.hypothesis;
            let (cause, odds) = (hypothesis.text(bytes).sentence(), hypothesis.odds());
            text += &format!("   Perhaps: {cause} (fits by chance: {odds}).\n");
        }
    }
    text
}

/// So many causes of a failed check are told.
const EXPLAINED: usize = 2;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::{Options, decode};

    #[test]
    fn everything_found_is_in_the_text() {
        let text = text(&decode(
            "01 03 00 C8 00 03 84 35\n01 03 06 00 08 42 A4 F1 DE B0 F8\nhello",
            Options::default(),
        ));
        assert!(
            text.starts_with("2 telegrams, 1 answered, 1 checksum wrong, 1 line left unread.\n"),
            "{text}"
        );
        assert!(text.contains("\n1. Modbus RTU request: Ask unit 1"), "{text}");
        assert!(text.contains("\n2. Modbus RTU response to 1: "), "{text}");
        assert!(text.contains("\n   01                 Unit address"), "{text}");
        assert!(text.contains("\n   Error: CRC is wrong"), "{text}");
        assert!(text.contains("\nLine 3: no bytes found."), "{text}");
        assert!(text.lines().all(|line| !line.ends_with(' ')), "{text}");
    }
}

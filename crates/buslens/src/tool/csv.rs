//! A report as a table for spreadsheets: RFC 4180, a row for each telegram.

use super::{Report, Verdict};
use crate::field::{Direction, hex, shortest};

/// The columns.
const HEAD: [&str; 15] = [
    "number",
    "line",
    "protocol",
    "direction",
    "unit",
    "function",
    "exception",
    "check",
    "state",
    "bytes",
    "meaning",
    "problems",
    "time",
    "latency ms",
    "comment",
];

/// The whole report, with a row of titles.
///
/// ```
/// use buslens::tool::{Options, csv, decode};
///
/// let table = csv::table(&decode("01 03 00 C8 00 03 84 35", Options::default()));
/// assert!(table.lines().nth(1).unwrap().starts_with("1,1,modbus-rtu,request,1,3,,right,sent,01 03 00 C8"));
/// ```
pub fn table(report: &Report) -> String {
    let rows = (0..report.telegrams.len()).map(|index| telegram(report, index));
    std::iter::once(head()).chain(rows).collect()
}

/// The row of titles.
pub fn head() -> String {
    row(HEAD.map(str::to_owned))
}

/// The row of telegram `index`; nothing if there is none.
pub fn telegram(report: &Report, index: usize) -> String {
    let (Some(telegram), Some(detail)) = (report.telegrams.get(index), report.detail(index)) else {
        return String::new();
    };
    let direction = telegram.guess.told().map_or("unknown", Direction::key);
    let check = match telegram.verdict {
        Verdict::Right => "right",
        Verdict::Wrong => "wrong",
        Verdict::Unchecked => "too short",
        Verdict::NoCheck => "none",
    };
    let latency = telegram.latency.filter(|_| telegram.answers.is_some());
    let number = |number: Option<u8>| number.map_or(String::new(), |number| number.to_string());
    let problems: Vec<String> =
        detail.problems().into_iter().map(|problem| problem.message.sentence()).collect();
    row([
        telegram.number.to_string(),
        telegram.line.number.to_string(),
        telegram.choice.protocol.key.to_owned(),
        direction.to_owned(),
        number(detail.unit),
        number(detail.function),
        number(detail.exception),
        check.to_owned(),
        report.state(index).key().to_owned(),
        hex(&telegram.line.bytes),
        detail.meaning().sentence(),
        problems.join("; "),
        telegram.time.clone().unwrap_or_default(),
        // Once for an exchange: what counts and adds up goes by rows.
        latency.map_or(String::new(), |micros| shortest(f64::from(micros) / 1000.0)),
        telegram.comment.clone(),
    ])
}

fn row<const N: usize>(cells: [String; N]) -> String {
    let mut row = cells.map(quoted).join(",");
    row.push_str("\r\n");
    row
}

/// A cell; in quotes where it holds what would end it.
fn quoted(cell: String) -> String {
    if cell.contains(['"', ',', '\r', '\n']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::{Options, decode};

    #[test]
    fn cells_keep_their_commas() {
        let report = decode("01 03 06 00 08 42 A4 F1 DE B0 F8\nhello\n01 03 O0", Options::default());
        let table = table(&report);
        let lines: Vec<&str> = table.split_terminator("\r\n").collect();
        assert_eq!(lines.len(), 1 + report.telegrams.len());
        assert!(lines[1].contains(",wrong,damaged,01 03 06"), "{table}");
        assert!(lines[1].contains("\"Unit 1 answers with 3 holding registers: 8, 17060, 61918,"), "{table}");
        assert_eq!(quoted("say \"no\"".to_owned()), "\"say \"\"no\"\"\"");
    }
}

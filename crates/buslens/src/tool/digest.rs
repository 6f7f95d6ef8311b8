//! What was read in short, for a mail and as the first page of a report: what it is, what is wrong and what to
//! do about it, the units, and the telegrams that matter, a line each.

#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};

use super::annotated;
use super::decode::{Report, Telegram};
use super::log::{State, Unit, brief};
use crate::field::{Direction, Field, Severity, count, grouped, hex, many};
use crate::frame::Verdict;

/// What was read in short.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Digest {
    /// What it is called, such as the name of a file; empty where it has no name.
    pub title: String,
    /// "104 telegrams of Modbus RTU in 104 lines, from 10:00:00 to 10:00:08".
    pub read: String,
    /// All of it in one sentence.
    pub headline: String,
    /// What else there is to say: echoes, unread lines.
    pub remarks: Vec<String>,
    pub findings: Vec<Finding>,
    pub units: Vec<Party>,
    pub telegrams: Vec<Line>,
    /// How many telegrams there are of which these are some.
    pub of: usize,
    /// Something is wrong with each of those.
    pub wrong: bool,
}

/// Something that is wrong, and what to do about it.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Finding {
    pub text: String,
    /// So many telegrams show it.
    pub telegrams: usize,
}

/// A unit, and what came of its requests.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Party {
    pub name: String,
    /// What it is, where a person said so.
    pub device: String,
    pub unit: Unit,
}

/// A telegram in a line.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub struct Line {
    /// Its number, from 1.
    pub number: usize,
    pub time: Option<String>,
    pub unit: Option<u8>,
    pub direction: Option<Direction>,
    /// What it says, without who says it.
    pub said: String,
    pub state: State,
    /// Microseconds that a slow response took.
    pub latency: Option<u32>,
    /// The same happened so often.
    pub times: usize,
    pub bytes: Vec<u8>,
    /// What is wrong with it, and what may have happened.
    pub faults: Vec<String>,
    /// Bytes, name, value and meaning of each field, where there are few telegrams.
    pub fields: Vec<[String; 4]>,
}

/// More telegrams are for a file.
pub(super) const MOST: usize = 10;

impl Line {
    /// Telegram `index` of a report.
    pub(super) fn of(report: &Report, index: usize, state: State) -> Option<Self> {
        let (telegram, detail) = (report.telegrams.get(index)?, report.detail(index)?);
        // What happened says more than what is wrong since then.
        let faults = match cause(report, index, telegram) {
            Some(cause) => vec![cause],
            None => {
                let problems = detail.problems().into_iter();
                let errors = problems.filter(|problem| problem.severity == Severity::Error);
                errors.map(|problem| problem.message.sentence() + ".").collect()
            }
        };
        Some(Self {
            number: telegram.number,
            time: telegram.time.clone(),
            unit: telegram.unit,
            direction: telegram.guess.told(),
            said: brief(&detail.said),
            state,
            latency: telegram.latency.filter(|_| telegram.answers.is_some()),
            times: 1,
            bytes: telegram.line.bytes.clone(),
            faults,
            fields: Vec::new(),
        })
    }

    /// "damaged", "slow, 428 ms, 5 times"; nothing for what went its way.
    pub fn fate(&self) -> String {
        let word = (self.state != State::Plain).then(|| self.state.word().to_owned());
        let slow = self.latency.filter(|_| self.state == State::Slow);
        let slow = slow.map(|micros| format!("{} ms", micros / 1000));
        let times = (self.times > 1).then(|| format!("{} times", grouped(self.times)));
        [word, slow, times].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// The bytes in hex, of long telegrams the first ones.
    pub fn hex(&self) -> String {
        const SHOWN: usize = 40;
        match self.bytes.len() {
            all if all > SHOWN => format!("{} … ({all} bytes)", hex(&self.bytes[..SHOWN])),
            _ => hex(&self.bytes),
        }
    }

    /// The time, the unit and who speaks: "10:00:00.130, unit 9 asked".
    fn who(&self) -> String {
        let asked = match self.direction {
            Some(Direction::Request) => "to ",
            Some(Direction::Response) => "from ",
            None => "",
        };
        let unit = self.unit.map(|unit| format!("{asked}unit {unit}"));
        [self.time.clone(), unit].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// What most likely happened to a telegram whose check is wrong.
fn cause(report: &Report, index: usize, telegram: &Telegram) -> Option<String> {
    if telegram.verdict != Verdict::Wrong {
        return None;
    }
    let best = report.explanations(index).into_iter().next()?;
    let cause = best.hypothesis.text(&telegram.line.bytes).sentence();
    Some(format!("Possible cause: {cause}. Corrected: {}.", best.said))
}

impl Report {
    /// The report in short. Of a telegram or two, all fields are told.
    pub fn digest(&self) -> Digest {
        const FIELDS: usize = 2;
        let all = self.telegrams.len();
        let mut wrong: Vec<usize> = (0..all).filter(|index| self.state(*index).is_wrong()).collect();
        let few = all <= MOST;
        if few {
            wrong = (0..all).collect();
        }
        let of = wrong.len();
        wrong.truncate(MOST);
        let mut telegrams: Vec<Line> =
            wrong.iter().filter_map(|index| Line::of(self, *index, self.state(*index))).collect();
        if all <= FIELDS {
            for (line, index) in telegrams.iter_mut().zip(&wrong) {
                line.fields = self.field_rows(*index);
            }
        }
        let protocol = self.telegrams.first().map(|telegram| telegram.choice.protocol.label);
        let device = self.device(0).map(|device| device.label);
        // The sentence of one telegram does not count it.
        let counted = (all == 1).then(|| count(all, "telegram"));
        let facts = [counted, protocol.map(str::to_owned), device.map(str::to_owned)];
        let headline = match (all, self.detail(0)) {
            (1, Some(detail)) => detail.meaning().sentence() + ".",
            _ => annotated::summary(self).trim_end().to_owned(),
        };
        Digest {
            read: facts.into_iter().flatten().collect::<Vec<_>>().join(", ") + ".",
            headline,
            telegrams,
            of,
            wrong: !few,
            ..Digest::default()
        }
    }

    /// Bytes, name, value and meaning of each field of telegram `index`: what the device's manual says of it
    /// first.
    pub fn field_rows(&self, index: usize) -> Vec<[String; 4]> {
        let (Some(telegram), Some(detail)) = (self.telegrams.get(index), self.detail(index)) else {
            return Vec::new();
        };
        let mut rows = Vec::new();
        for field in detail.device.blocks.iter().map(|block| &block.field).chain(&detail.fields) {
            add_rows(field, &telegram.line.bytes, 0, &mut rows);
        }
        rows
    }
}

/// Bytes, label, value and meaning of a field and of those within it.
fn add_rows(field: &Field, bytes: &[u8], depth: usize, rows: &mut Vec<[String; 4]>) {
    let meaning = field.meaning().map_or(String::new(), |meaning| meaning.to_string());
    let label = format!("{}{}", "  ".repeat(depth), field.label().sentence());
    rows.push([hex(field.span.of(bytes)), label, field.value_text(), meaning]);
    field.children.iter().for_each(|child| add_rows(child, bytes, depth + 1, rows));
}

impl Digest {
    const WRONG: &'static str = "What is wrong";

    /// Above the telegrams.
    fn title_of_telegrams(&self) -> String {
        let shown = self.telegrams.len();
        match (self.wrong, self.of > shown) {
            (true, true) => format!("Telegrams that matter ({shown} of {})", grouped(self.of)),
            (true, false) => "Telegrams that matter".to_owned(),
            (false, _) => "Telegrams".to_owned(),
        }
    }

    /// As plain text, which reads well in any letters.
    ///
    /// ```
    /// use buslens::tool::{Options, decode};
    ///
    /// let digest = decode("01 03 00 C8 00 03 84 35", Options::default()).digest();
    /// assert!(digest.text(true).contains("01 03 00 C8 00 03 84 35"));
    /// ```
    pub fn text(&self, with_bytes: bool) -> String {
        let mut text = String::new();
        let mut say = |line: &str| {
            text += line;
            text.push('\n');
        };
        match self.title.as_str() {
            "" => say(&self.read),
            title => say(&format!("{title}: {}", self.read)),
        }
        say(&self.headline);
        self.remarks.iter().for_each(|remark| say(&format!("- {remark}")));
        if !self.findings.is_empty() {
            say(&format!("\n{}", Self::WRONG));
            for (number, finding) in (1..).zip(&self.findings) {
                say(&format!("{number}. {} ({})", finding.text, many(finding.telegrams, "telegram")));
            }
        }
        if !self.units.is_empty() {
            say("\nUnits");
            self.units.iter().for_each(|unit| say(&format!("- {}", unit.sentence())));
        }
        if !self.telegrams.is_empty() {
            say(&format!("\n{}", self.title_of_telegrams()));
        }
        for line in &self.telegrams {
            let (who, fate) = (line.who(), line.fate());
            let who = if who.is_empty() { String::new() } else { format!(" {who}") };
            let fate = if fate.is_empty() { String::new() } else { format!(" [{fate}]") };
            say(&format!("#{}{who}: {}{fate}", line.number, line.said));
            if with_bytes {
                say(&format!("   {}", line.hex()));
            }
            line.faults.iter().for_each(|fault| say(&format!("   {fault}")));
            if !line.fields.is_empty() {
                columns(&line.fields).iter().for_each(|row| say(&format!("   {row}")));
            }
        }
        text
    }

    /// As HTML for the clipboard: elements and attributes that mails keep, and no styles, which browsers drop
    /// from what pages under a strict policy copy.
    pub fn html(&self, with_bytes: bool) -> String {
        let mut html = String::from("<div>");
        let title =
            if self.title.is_empty() { String::new() } else { format!("<b>{}</b>: ", escaped(&self.title)) };
        html += &format!("<p>{title}{}<br><b>{}</b></p>", escaped(&self.read), escaped(&self.headline));
        if !self.remarks.is_empty() {
            let remarks: String =
                self.remarks.iter().map(|remark| format!("<li>{}</li>", escaped(remark))).collect();
            html += &format!("<ul>{remarks}</ul>");
        }
        if !self.findings.is_empty() {
            let findings = self.findings.iter().map(|finding| {
                format!("<li>{} ({})</li>", escaped(&finding.text), many(finding.telegrams, "telegram"))
            });
            html += &format!("<p><b>{}</b></p><ol>{}</ol>", Self::WRONG, findings.collect::<String>());
        }
        if !self.units.is_empty() {
            let rows: Vec<Vec<String>> =
                self.units.iter().map(|unit| unit.cells().map(|cell| escaped(&cell)).to_vec()).collect();
            html += &format!("<p><b>Units</b></p>{}", table(&Party::HEADS, &rows));
        }
        if !self.telegrams.is_empty() {
            let heads = ["No.", "Time", "Unit", "Says", "State"];
            let rows: Vec<Vec<String>> = self.telegrams.iter().map(|line| line.cells(with_bytes)).collect();
            html += &format!("<p><b>{}</b></p>{}", self.title_of_telegrams(), table(&heads, &rows));
        }
        for line in self.telegrams.iter().filter(|line| !line.fields.is_empty()) {
            let rows: Vec<Vec<String>> = line
                .fields
                .iter()
                .map(|[bytes, label, value, meaning]| {
                    vec![code(bytes), indented(label), escaped(value), escaped(meaning)]
                })
                .collect();
            let heads = ["Bytes", "Field", "Value", "Meaning"];
            html += &format!("<p><b>Fields of telegram {}</b></p>{}", line.number, table(&heads, &rows));
        }
        html + "</div>"
    }
}

impl Line {
    fn cells(&self, with_bytes: bool) -> Vec<String> {
        let arrow = match self.direction {
            Some(Direction::Request) => " &rarr;",
            Some(Direction::Response) => " &larr;",
            None => "",
        };
        let unit = self.unit.map_or(String::new(), |unit| format!("{unit}{arrow}"));
        let mut said = escaped(&self.said);
        if with_bytes {
            said += &format!("<br>{}", code(&self.hex()));
        }
        for fault in &self.faults {
            said += &format!("<br>{}", escaped(fault));
        }
        let time = escaped(self.time.as_deref().unwrap_or_default());
        vec![self.number.to_string(), time, unit, said, format!("<b>{}</b>", escaped(&self.fate()))]
    }
}

impl Party {
    /// The columns of a table of them.
    pub const HEADS: [&'static str; 9] = [
        "Unit",
        "Device",
        "Requests",
        "Answered",
        "Unanswered",
        "Damaged",
        "Rejected",
        "Usual time",
        "Longest time",
    ];

    /// A row of that table.
    pub fn cells(&self) -> [String; 9] {
        let Unit { requests, answered, unanswered, damaged, refused, median, worst, .. } = self.unit;
        let time = |micros: Option<u32>| micros.map_or(String::new(), milliseconds);
        [
            self.name.clone(),
            self.device.clone(),
            grouped(requests),
            grouped(answered),
            grouped(unanswered),
            grouped(damaged),
            grouped(refused),
            time(median),
            time(worst),
        ]
    }

    /// "Unit 1 (Memograph M RSG45): 24 requests, all answered; 4 damaged; usually after 31 ms, at most 35 ms".
    fn sentence(&self) -> String {
        let Unit { telegrams, requests, answered, unanswered, damaged, refused, median, worst, .. } =
            self.unit;
        let device = if self.device.is_empty() { String::new() } else { format!(" ({})", self.device) };
        let mut parts = vec![match requests {
            0 => many(telegrams, "telegram"),
            _ if answered == requests && requests > 1 => {
                format!("{}, all answered", many(requests, "request"))
            }
            _ => format!("{}, {} answered", many(requests, "request"), grouped(answered)),
        }];
        for (n, word) in [(unanswered, "unanswered"), (damaged, "damaged"), (refused, "rejected")] {
            if n > 0 {
                parts.push(format!("{} {word}", grouped(n)));
            }
        }
        if let (Some(median), Some(worst)) = (median, worst) {
            parts.push(format!("usually after {}, at most {}", milliseconds(median), milliseconds(worst)));
        }
        format!("{}{device}: {}", self.name, parts.join("; "))
    }
}

/// "31 ms", "0.4 ms".
fn milliseconds(micros: u32) -> String {
    match micros {
        10_000.. => format!("{} ms", (micros + 500) / 1000),
        _ => format!("{}.{} ms", micros / 1000, micros % 1000 / 100),
    }
}

/// Text in columns of their own width.
pub(super) fn columns(rows: &[[String; 4]]) -> Vec<String> {
    /// Longer runs of bytes have no column of their own.
    const WIDEST: usize = 24;
    let width = |column: usize| {
        let widths = rows.iter().map(|row| row[column].chars().count());
        widths.max().unwrap_or(0).min(if column == 0 { WIDEST } else { usize::MAX })
    };
    let [w0, w1, w2] = [0, 1, 2].map(width);
    let row = |[bytes, label, value, meaning]: &[String; 4]| {
        format!("{bytes:w0$}  {label:w1$}  {value:w2$}  {meaning}").trim_end().to_owned()
    };
    rows.iter().map(row).collect()
}

/// A table whose cells are HTML already.
fn table(heads: &[&str], rows: &[Vec<String>]) -> String {
    let head: String = heads.iter().map(|head| format!("<th align=\"left\">{head}</th>")).collect();
    let row = |row: &Vec<String>| {
        let cells: String = row.iter().map(|cell| format!("<td>{cell}</td>")).collect();
        format!("<tr valign=\"top\">{cells}</tr>")
    };
    let rows: String = rows.iter().map(row).collect();
    format!(
        "<table border=\"1\" cellpadding=\"4\" cellspacing=\"0\"><tr valign=\"top\">{head}</tr>{rows}</table>"
    )
}

fn code(text: &str) -> String {
    format!("<code>{}</code>", escaped(text))
}

/// A label whose place in the tree its spaces say.
fn indented(label: &str) -> String {
    let plain = label.trim_start();
    format!("{}{}", "&emsp;".repeat((label.len() - plain.len()) / 2), escaped(plain))
}

/// Text that is no markup.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use crate::tool::{Options, Profile, decode};

    #[test]
    fn one_telegram_is_told_with_its_fields() {
        let options = Options { device: Profile::of("memograph-rsg45"), ..Options::default() };
        let digest = decode("01 03 06 00 08 42 A4 F1 DE B0 F8", options).digest();
        assert_eq!((digest.telegrams.len(), digest.of), (1, 1));
        let text = digest.text(true);
        assert!(text.starts_with("1 telegram, Modbus RTU, "), "{text}");
        assert!(text.contains("[damaged]") && text.contains("Possible cause: "), "{text}");
        assert!(text.contains("01 03 06 00 08 42 A4 F1 DE B0 F8") && text.contains("Byte count"), "{text}");
    }

    #[test]
    fn what_is_read_is_no_markup() {
        let mut digest = decode("01 03 00 C8 00 03 84 35", Options::default()).digest();
        digest.title = "<b>\"a\" & b.log".to_owned();
        let html = digest.html(true);
        assert!(html.contains("<b>&lt;b&gt;&quot;a&quot; &amp; b.log</b>: 1 telegram"), "{html}");
        for tag in ["p", "ol", "ul", "table", "tr", "td", "th", "div", "b", "code", "li"] {
            let ends = html.matches(&format!("</{tag}>")).count();
            let begins =
                html.matches(&format!("<{tag}>")).count() + html.matches(&format!("<{tag} ")).count();
            assert_eq!(begins, ends, "{tag}");
        }
    }
}

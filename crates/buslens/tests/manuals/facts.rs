use std::fmt::Write as _;

use buslens::device::Profile;
use buslens::field::Field;
use buslens::tool::log::Reading;
use buslens::tool::{Detail, Options, Protocol, Report, decode, decode_file, search, settings};

use super::{lines, profile, write_lines};

/// A fact.
pub struct Row {
    table: &'static str,
    cells: Vec<String>,
}

const TABLES: [(&str, &str); 3] = [
    ("keb_f5_modbus", "keb-f5-modbus"),
    ("keb_f5_profibus", "keb-f5-profibus"),
    ("memograph_rsg45", "memograph-rsg45"),
];

pub fn rows() -> Vec<Row> {
    let of = |(table, _)| lines(table).into_iter().map(move |cells| Row { table, cells });
    TABLES.into_iter().flat_map(of).collect()
}

/// What is wrong with what Buslens says of the fact.
pub fn wrong(row: &Row) -> Option<String> {
    let said = row.said();
    let expected = (row.cell(4), row.cell(5));
    let mut wrong = String::new();
    if (said.sentence.as_str(), said.problems.as_str()) != expected {
        let _ = write!(
            wrong,
            "\n  expected {} [{}]\n  found    {} [{}]",
            expected.0, expected.1, said.sentence, said.problems
        );
    }
    for text in row.cell(6).split(" | ").filter(|text| !text.is_empty()) {
        if !said.besides.contains(text) {
            let _ = write!(wrong, "\n  “{text}” is not said");
        }
    }
    if said.sentence.is_empty() {
        wrong.push_str("\n  nothing is checked");
    }
    (!wrong.is_empty()).then(|| format!("{} {}, {}:{wrong}", row.table, row.cell(0), row.cell(1)))
}

/// Writes what Buslens says into the tables.
pub fn bless(rows: &[Row]) {
    for (table, _) in TABLES {
        write_lines(
            table,
            rows.iter().filter(|row| row.table == table).map(|row| {
                let said = row.said();
                let mut cells = row.cells.clone();
                cells[4] = said.sentence;
                cells[5] = said.problems;
                cells
            }),
        );
    }
}

#[derive(Default)]
struct Said {
    sentence: String,
    problems: String,
    /// All else that can be read about it.
    besides: String,
}

impl Row {
    fn cell(&self, at: usize) -> &str {
        self.cells.get(at).map_or("", String::as_str)
    }

    fn device(&self) -> &'static Profile {
        let (_, key) = TABLES.into_iter().find(|(table, _)| *table == self.table).expect("a table");
        profile(key)
    }

    fn said(&self) -> Said {
        let (how, rest) = self.cell(2).split_once(' ').unwrap_or((self.cell(2), ""));
        let telegrams = self.cell(3).replace(" / ", "\n");
        match how {
            "lengths" => self.lengths(),
            "search" => self.found(&telegrams),
            "display" => self.displayed(&decode(&telegrams, self.options())),
            "display-file" => {
                let report = decode_file(telegrams.as_bytes(), &Reading::default(), self.options());
                self.displayed(&report.expect("a file"))
            }
            "printed" => self.printed(rest, &telegrams),
            _ => {
                let report = decode(&telegrams, self.options());
                let Some(last) = report.telegrams.len().checked_sub(1) else { return Said::default() };
                said(&report, last)
            }
        }
    }

    /// As the cell says: `channel`, and settings as a file has them.
    fn options(&self) -> Options {
        let mut options = Options { device: Some(self.device()), ..Options::default() };
        let words = self.cell(2).split("; ");
        let (keys, lines): (Vec<&str>, Vec<&str>) = words.partition(|word| !word.contains('='));
        if keys.contains(&"channel") {
            options.protocol = Protocol::of("profibus-parameter-channel");
        }
        if !lines.is_empty() {
            options.settings = settings::read(&lines.join("\n")).expect("settings");
        }
        options
    }

    /// What comes first for each of the words that are typed into Build.
    fn found(&self, words: &str) -> Said {
        let best = |word: &str| {
            let found = search(word, Some(self.device()));
            found.first().map_or_else(|| "nothing".to_owned(), |found| found.label().sentence())
        };
        Said { sentence: words.lines().map(best).collect::<Vec<_>>().join("; "), ..Said::default() }
    }

    /// How many of the lengths in the cell (`index:subindex=bytes`) the table has.
    fn lengths(&self) -> Said {
        let listed = self.cell(3).split(' ').filter(|entry| {
            let (place, length) = entry.split_once('=').expect("a length");
            let (index, subindex) = place.split_once(':').expect("a subindex");
            let index = u16::from_str_radix(index, 16).expect("an index");
            let mut parameters = self.device().parameters();
            let found = parameters.find(|it| it.address == index && it.subindex == subindex.parse().ok());
            found.and_then(|parameter| parameter.length) == length.parse().ok()
        });
        let all = self.cell(3).split(' ').count();
        Said { sentence: format!("{} of {all} lengths", listed.count()), ..Said::default() }
    }

    fn displayed(&self, report: &Report) -> Said {
        let remarks = report.lines().flat_map(|line| &line.remarks);
        Said { sentence: remarks.map(|remark| remark.message.sentence()).collect(), ..Said::default() }
    }

    /// A telegram that the manual misprints: what is right says the sentence, the first hypothesis is besides.
    fn printed(&self, printed: &str, right: &str) -> Said {
        let mut said = said(&decode(right, self.options()), 0);
        let report = decode(printed, self.options());
        for one in report.explanations(0).iter().take(1) {
            said.besides = one.hypothesis.text(&report.telegrams[0].line.bytes).sentence();
        }
        said
    }
}

/// The telegram in a sentence with the device's notes, its problems, and all that its fields say.
fn said(report: &Report, index: usize) -> Said {
    let detail = report.detail(index).expect("a telegram");
    let mut notes: Vec<String> =
        detail.device.blocks.iter().filter_map(|block| Some(block.note.as_ref()?.to_string())).collect();
    notes.dedup();
    let mut sentence = detail.meaning().sentence() + ".";
    if !notes.is_empty() {
        let _ = write!(sentence, " ({})", notes.join("; "));
    }
    let problems: Vec<String> = detail
        .problems()
        .iter()
        .map(|problem| format!("{}: {}", problem.code, problem.message.sentence()))
        .collect();
    Said { sentence, problems: problems.join("; "), besides: besides(&detail) }
}

fn besides(detail: &Detail) -> String {
    let mut text = format!("{}\n{}\n", detail.kind, detail.note);
    let mut add = |field: &Field| {
        let meaning = field.meaning().map(|meaning| meaning.to_string()).unwrap_or_default();
        let _ = writeln!(text, "{}: {} {meaning}\n{}", field.label(), field.value_text(), field.spec.note);
        let raw = field.value.raw().unwrap_or_default();
        let named = field.spec.name(raw).map(|name| name.note);
        let parts = field
            .parts()
            .flat_map(|(part, value)| [part.note, part.name(value).map_or("", |name| name.note)].into_iter());
        for note in named.into_iter().chain(parts) {
            let _ = writeln!(text, "{note}");
        }
    };
    detail.fields.iter().for_each(|field| field.visit(&mut add));
    detail.device.blocks.iter().for_each(|block| block.field.visit(&mut add));
    for fact in detail.device.blocks.iter().flat_map(|block| &block.facts) {
        let _ = writeln!(text, "{fact}");
    }
    text
}

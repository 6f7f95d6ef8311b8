//! One small file for each telegram, below `tests/vectors`.
//!
//! The head is written by hand: what it is, its `source`, the `hex` as pasted, the true `direction`
//! and `check`, the codes of its `problems`, if it has some, and its `protocol`, if that is not
//! Modbus RTU. `before` has telegrams that came before it on the line, parted by `|`; `device` names
//! the device whose table is to be used, `as` a protocol that a person chooses because the bytes do
//! not tell it. `gallery: yes` shows it in Learn, as everything is that a manual prints; `slip` and `right` say what
//! is wrong in print, and how it should be, where the device's table does not. Behind `---` stands what Buslens makes of it; `BLESS=1 cargo test --test vectors`
//! rewrites that part, and only that part.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use buslens::field::{Field, Severity, Value, leaves};
use buslens::modbus::{KINDS, OTHER_KINDS};
use buslens::profibus;
use buslens::tool::{Certainty, Detail, Options, PROFILES, PROTOCOLS, Report, Telegram, Verdict, decode};

#[test]
fn every_vector_reads_as_written() {
    let bless = std::env::var_os("BLESS").is_some();
    let mut failures = Vec::new();
    for path in vectors() {
        let text = std::fs::read_to_string(&path).unwrap();
        let vector = Vector::parse(&text);
        let (report, index) = vector.decode();
        let detail = report.detail(index).unwrap_or_else(|| panic!("{}: no telegram", path.display()));
        let shown = show(&report, index, &detail);
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        for (key, truth) in truths(&report.telegrams[index], &detail) {
            let otherwise = if key == "protocol" { "modbus-rtu" } else { "none" };
            let stated = vector.find(key).unwrap_or(otherwise);
            if stated != truth {
                failures.push(format!("{name}: {key} is {truth}, stated {stated}"));
            }
        }
        if bless {
            // In one go: the other tests read the same files meanwhile.
            let draft = path.with_extension("new");
            std::fs::write(&draft, format!("{}---\n{shown}", vector.head)).unwrap();
            std::fs::rename(draft, &path).unwrap();
        } else if vector.expected != shown {
            failures.push(format!("{name}: expected\n{}\nfound\n{shown}", vector.expected));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_kind_has_a_vector() {
    let seen: BTreeSet<&str> = vectors()
        .iter()
        .filter_map(|path| {
            let text = std::fs::read_to_string(path).unwrap();
            let (report, index) = Vector::parse(&text).decode();
            let fields = report.detail(index)?.fields;
            leaves(&fields).into_iter().find_map(|leaf| match leaf.value {
                Value::Selector { chosen, .. } => Some(chosen.key),
                _ => None,
            })
        })
        .collect();
    for kind in KINDS.iter().chain(OTHER_KINDS) {
        // These look exactly like the request.
        let twins = [
            "write_single_coil_response",
            "write_single_register_response",
            "diagnostics_response",
            "write_file_record_response",
            "mask_write_register_response",
            "unknown_response",
        ];
        let twin = twins.contains(&kind.spec.key);
        assert!(twin || seen.contains(kind.spec.key), "no vector of {}", kind.spec.key);
    }
}

#[test]
fn every_protocol_and_every_profibus_kind_has_a_vector() {
    let mut seen = BTreeSet::new();
    let mut kinds = BTreeSet::new();
    for path in vectors() {
        let text = std::fs::read_to_string(path).unwrap();
        let (report, index) = Vector::parse(&text).decode();
        let telegram = &report.telegrams[index];
        seen.insert(telegram.choice.protocol.key);
        if telegram.choice.protocol.key.starts_with("profibus") {
            let kind = report.detail(index).unwrap().kind.to_string();
            kinds.insert((kind, telegram.guess.direction.key()));
        }
    }
    for protocol in PROTOCOLS {
        assert!(seen.contains(protocol.key), "no vector of {}", protocol.key);
    }
    for kind in profibus::KINDS.iter().chain(profibus::OTHER_KINDS) {
        let named = (kind.spec.label.to_owned(), kind.direction.key());
        assert!(kinds.contains(&named), "no vector of {}", kind.spec.key);
    }
}

/// All 71 telegrams that the Memograph manual prints: 58 right, 13 with a slip.
#[test]
fn the_memograph_manual_is_complete() {
    let (mut right, mut wrong) = (0, 0);
    let printed = |path: &&PathBuf| path.file_stem().unwrap().to_string_lossy().starts_with("2_6_");
    for path in vectors().iter().filter(printed) {
        let text = std::fs::read_to_string(path).unwrap();
        let (report, index) = Vector::parse(&text).decode();
        match report.telegrams[index].verdict {
            Verdict::Right => right += 1,
            Verdict::Wrong => wrong += 1,
            Verdict::Unchecked | Verdict::NoCheck => panic!("{}: not checked", path.display()),
        }
    }
    assert_eq!((right, wrong), (58, 13));
}

struct Vector<'a> {
    /// With the line end of its last line.
    head: &'a str,
    expected: &'a str,
}

impl<'a> Vector<'a> {
    fn parse(text: &'a str) -> Self {
        let (head, expected) = text.split_once("---\n").unwrap_or((text, ""));
        Self { head, expected }
    }

    fn find(&self, key: &str) -> Option<&'a str> {
        self.head.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(": "))
    }

    /// The report of all telegrams, and the index of the vector's.
    fn decode(&self) -> (Report, usize) {
        let before = self.find("before").map_or(String::new(), |before| before.replace('|', "\n") + "\n");
        let device = self.find("device").map(|key| {
            let known = PROFILES.iter().copied().find(|profile| profile.key == key);
            known.unwrap_or_else(|| panic!("no device {key}"))
        });
        let protocol = self.find("as").map(|key| {
            let known = PROTOCOLS.iter().copied().find(|protocol| protocol.key == key);
            known.unwrap_or_else(|| panic!("no protocol {key}"))
        });
        let options = Options { device, protocol, ..Options::default() };
        let report = decode(&(before + self.head("hex")), options);
        let last = report.telegrams.len().saturating_sub(1);
        (report, last)
    }

    fn head(&self, key: &str) -> &'a str {
        self.find(key).unwrap_or_else(|| panic!("no {key} in\n{}", self.head))
    }
}

fn vectors() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vectors")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "txt") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// What the head of a vector states.
fn truths(telegram: &Telegram, detail: &Detail) -> [(&'static str, String); 4] {
    let direction = telegram.guess.direction.key();
    let direction = match telegram.guess.certainty {
        Certainty::Certain => direction.to_owned(),
        Certainty::Likely => format!("likely {direction}"),
        Certainty::Open => "open".to_owned(),
    };
    let check = match telegram.verdict {
        Verdict::Right => "right",
        Verdict::Wrong => "wrong",
        Verdict::Unchecked | Verdict::NoCheck => "none",
    };
    let mut codes: Vec<_> = detail.problems().iter().map(|problem| problem.code).collect();
    codes.extend(telegram.line.remarks.iter().map(|remark| remark.code));
    let problems = if codes.is_empty() { "none".to_owned() } else { codes.join(", ") };
    let protocol = telegram.choice.protocol.key.to_owned();
    [("protocol", protocol), ("direction", direction), ("check", check.to_owned()), ("problems", problems)]
}

/// A telegram as text that a reviewer can read.
fn show(report: &Report, index: usize, detail: &Detail) -> String {
    let telegram = &report.telegrams[index];
    let mut text = String::new();
    writeln!(text, "{}.", detail.meaning().sentence()).unwrap();
    writeln!(text, "{}; {}", detail.kind, telegram.guess.reason).unwrap();
    for field in &detail.fields {
        show_field(&mut text, field, 0);
    }
    for remark in &telegram.line.remarks {
        writeln!(text, "text {}..{}: {}", remark.span.from, remark.span.to, remark.message).unwrap();
    }
    if let Some(step) = &detail.step {
        let repeated = if step.repeated { ", repeated" } else { "" };
        writeln!(text, "job {}: {}{repeated}", step.job, step.state.key()).unwrap();
        for problem in &step.problems {
            let (from, to) = (problem.span.from, problem.span.to);
            writeln!(text, "job {from}..{to} {}: {}", problem.code, problem.message).unwrap();
        }
    }
    for problem in &detail.device.problems {
        writeln!(text, "device {}: {}", problem.code, problem.message).unwrap();
    }
    for block in &detail.device.blocks {
        let note = block.note.as_ref().map(|note| format!("; {note}")).unwrap_or_default();
        writeln!(text, "device {}: {}{note}", block.registers(), block.label()).unwrap();
        show_field(&mut text, &block.field, 0);
    }
    text
}

fn show_field(text: &mut String, field: &Field, depth: usize) {
    let meaning = field.meaning().map(|meaning| format!(" ({meaning})")).unwrap_or_default();
    let (from, to) = (field.span.from, field.span.to);
    let place = format!("{:indent$}{from}..{to}", "", indent = 2 * depth);
    let label = field.label();
    writeln!(text, "{place:<12}{label}: {}{meaning}", field.value_text()).unwrap();
    for problem in &field.problems {
        let mark = if problem.severity == Severity::Error { "error" } else { "warning" };
        writeln!(text, "{:12}{mark} {}: {}", "", problem.code, problem.message).unwrap();
    }
    for child in &field.children {
        show_field(text, child, depth + 1);
    }
}

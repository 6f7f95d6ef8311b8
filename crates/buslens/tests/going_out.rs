//! What goes out: the summary for a mail, a capture, and a log to pass on.
//!
//! `tests/digests` has three logs, each with its summary as text and as HTML. `BLESS=1 cargo test --test
//! going_out` writes the two; read them before you commit them.

#![cfg(feature = "captures")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use buslens::tool::log::{CaptureFile, Hidden, Kind, Log, Reading, Redacted, Replaced};
use buslens::tool::{Options, Profile, csv};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/digests")
}

fn text(name: &str) -> Vec<u8> {
    std::fs::read(folder().join(name)).unwrap()
}

fn options(device: &str) -> Options {
    Options { device: Profile::of(device), ..Options::default() }
}

fn read(text: &[u8], device: &str) -> Log {
    Log::read(text, &Reading::default(), options(device)).unwrap()
}

const LOGS: [(&str, &str); 3] =
    [("converter.log", ""), ("recorder.log", "memograph-rsg45"), ("server.log", "")];

#[test]
fn the_summaries_are_as_written() {
    let bless = std::env::var_os("BLESS").is_some();
    for (name, device) in LOGS {
        let file = text(name);
        let log = read(&file, device);
        let source = file.as_slice();
        let mut digest = log.digest(&source, &log.findings(&source));
        digest.title = name.to_owned();
        let html = digest.html(false).replace("<tr>", "\n<tr>").replace("<p>", "\n<p>") + "\n";
        for (end, written) in [("txt", digest.text(true)), ("html", html)] {
            let path = folder().join(name).with_extension(end);
            if bless {
                std::fs::write(&path, &written).unwrap();
            }
            assert_eq!(std::fs::read_to_string(&path).unwrap_or_default(), written, "{}", path.display());
        }
        assert!(digest.telegrams.len() <= 10 && digest.telegrams.is_sorted_by_key(|line| line.number));
    }
}

/// All telegrams of a log as a capture.
fn captured(log: &Log, source: &[u8]) -> Vec<u8> {
    let mut file = CaptureFile::default();
    let all: Vec<usize> = (0..log.entries().len()).collect();
    let notes = BTreeMap::from([(1, "first".to_owned())]);
    let mut bytes = file.begin();
    for part in all.chunks(7) {
        bytes.extend(file.telegrams(log, &source, part, &notes));
    }
    bytes
}

#[test]
fn a_capture_holds_what_the_log_held() {
    for (name, device) in LOGS {
        let file = text(name);
        let log = read(&file, device);
        let capture = captured(&log, &file);
        let again = read(&capture, device);
        assert_eq!(again.fault(), None, "{name}");
        let held = |log: &Log, file: &[u8]| -> Vec<_> {
            let counted = log.entries().iter().filter(|entry| entry.counts());
            counted
                .map(|it| {
                    let bytes = log.bytes(&file, &it).into_owned();
                    (bytes, it.direction, it.time(), it.protocol().key, log.state(&it))
                })
                .collect()
        };
        assert_eq!(held(&again, &capture), held(&log, &file), "{name}");
        // What stands beside them is text of the file.
        let has = |text: &str| capture.windows(text.len()).any(|part| part == text.as_bytes());
        assert!(has("Note: first") && has("[unanswered]"), "{name}");
    }
}

#[test]
fn characters_of_a_line_come_back() {
    let file = b":010300C8000331\r\n:0183027A\r\n".as_slice();
    let log = read(file, "");
    assert_eq!(log.entry(0).protocol().key, "modbus-ascii");
    let capture = captured(&log, file);
    let again = read(&capture, "");
    let held = |log: &Log, file: &[u8]| -> Vec<_> {
        let entries = log.entries().iter();
        entries.map(|it| (it.protocol().key, log.bytes(&file, &it).into_owned())).collect()
    };
    assert_eq!(held(&again, &capture), held(&log, file));
}

fn hidden() -> Hidden {
    Hidden { units: true, addresses: true, texts: true, names: vec!["Miller".to_owned()] }
}

fn redacted(file: &[u8], hidden: &Hidden) -> Redacted {
    read(file, "").redacted(&file, file.len() as u64, hidden)
}

#[test]
fn a_log_to_pass_on_reads_as_before() {
    for (name, device) in LOGS {
        let file = text(name);
        let log = read(&file, device);
        let passed = log.redacted(&file.as_slice(), file.len() as u64, &hidden());
        let again = read(&passed.file, device);
        assert_eq!(passed.file.len(), file.len(), "{name}");
        assert_eq!((passed.left, passed.is_capture), (0, false), "{name}");
        let states = |log: &Log| -> Vec<_> {
            log.entries().iter().map(|it| (log.state(&it), it.time(), it.line, it.verdict)).collect()
        };
        assert_eq!(states(&again), states(&log), "{name}");
        // What happened to damaged telegrams can still be found.
        let causes = |log: &Log, file: &[u8]| -> Vec<_> {
            let all: Vec<usize> = (0..log.entries().len()).collect();
            let report = log.report(&file, &all);
            let best =
                |index| report.explanations(index).into_iter().next().map(|it| it.hypothesis.cause.key());
            all.iter().map(|index| best(*index)).collect()
        };
        assert_eq!(causes(&again, &passed.file), causes(&log, &file), "{name}");
        for it in &passed.replaced {
            assert!(it.times > 0 && it.from.len() == it.to.len() && it.from != it.to, "{it:?}");
            let gone = it.kind == Kind::Unit
                || !passed.file.windows(it.from.len()).any(|part| part == it.from.as_bytes());
            assert!(gone, "{name}: {} is still there", it.from);
        }
        assert!(passed.replaced.iter().any(|it| it.kind == Kind::Unit), "{name}");
    }
}

#[test]
fn the_same_is_replaced_by_the_same() {
    let file = b"# gateway 10.1.2.3:502 and 10.1.2.77, card 00:0E:8C:01:02:03, Miller's plant\n\
        10:00:00 unit 5 <- 05 03 00 C8 00 03 85 B1\n\
        10:00:01 slave=5 -> 05 03 06 4D 69 6C 6C 65 72 5B 88 Miller\n\
        10:00:02 10.1.2.3 unit 6 <- 06 03 00 C8 00 03 85 82\n";
    let passed = redacted(file, &hidden());
    let said = String::from_utf8(passed.file.clone()).unwrap();
    let lines: Vec<&str> = said.lines().collect();
    let first = lines[0].strip_prefix("# gateway ").unwrap().split(':').next().unwrap();
    assert_eq!(first.len(), "10.1.2.3".len());
    assert!(lines[3].contains(first), "{said}");
    assert!(!said.contains("Miller") && !said.contains("10.1.2") && !said.contains("0E:8C"), "{said}");
    assert!(lines[1].contains("unit 1 <- 01 03 00 C8 00 03 84 35"), "{said}");
    assert!(lines[2].contains("slave=1 -> 01 03 06 "), "{said}");
    assert!(lines[3].contains("unit 2 <- 02 03 00 C8 00 03 84 06"), "{said}");
    // The text in the telegram and that in the words became the same.
    let bytes: Vec<u8> =
        lines[2].split(' ').skip(6).take(6).map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect();
    assert!(lines[2].ends_with(str::from_utf8(&bytes).unwrap()), "{said}");
    let list: String = passed.replaced.iter().map(Replaced::line).collect();
    assert!(list.contains("unit\t5\t1\t4\n") && list.contains("network address\t10.1.2.3\t"), "{list}");
    // Nothing that nobody asked to hide.
    let none = redacted(file, &Hidden::default());
    assert_eq!((none.file.as_slice(), none.replaced), (file.as_slice(), Vec::new()));
}

/// Whoever names nothing hides nothing: it was looked for without end.
#[test]
fn an_empty_name_hides_nothing() {
    let file = text("server.log");
    let capture = captured(&read(&file, ""), &file);
    for file in [file, capture] {
        let hidden = |names: Vec<String>| Hidden { names, ..Hidden::default() };
        let (none, empty) =
            (redacted(&file, &hidden(Vec::new())), redacted(&file, &hidden(vec![String::new()])));
        assert_eq!((empty.file, empty.replaced), (none.file, none.replaced));
    }
}

#[test]
fn bytes_are_replaced_as_they_are_written() {
    for (line, passed) in [
        ("05 03 00 c8 00 03 85 b1", "01 03 00 c8 00 03 84 35"),
        ("0x05, 0x83, 0x02, 0x81, 0x30", "0x01, 0x83, 0x02, 0xC0, 0xF1"),
        (r"\x05\x83\x02\x81\x30", r"\x01\x83\x02\xC0\xF1"),
        ("05h 83h 02h 81h 30h", "01h 83h 02h C0h F1h"),
        ("[05][83][02][81][30]", "[01][83][02][C0][F1]"),
        ("0583028130", "018302C0F1"),
        ("Tx: 5 131 2 129 48", "Tx: 1 131 2 192 241"),
        (":05830276", ":0183027A"),
    ] {
        let hidden = Hidden { units: true, ..Hidden::default() };
        let file = format!("{line}\n{line}\n");
        let found = redacted(file.as_bytes(), &hidden);
        assert_eq!(String::from_utf8(found.file).unwrap(), format!("{passed}\n{passed}\n"));
    }
}

#[test]
fn a_capture_to_pass_on_has_other_ends() {
    let file = text("server.log");
    let capture = captured(&read(&file, ""), &file);
    let passed = redacted(&capture, &hidden());
    assert!(passed.is_capture);
    let (again, before) = (read(&passed.file, ""), read(&capture, ""));
    let states =
        |log: &Log| -> Vec<_> { log.entries().iter().map(|it| (log.state(&it), it.time())).collect() };
    assert_eq!(states(&again), states(&before));
}

/// An exchange has one latency, and each row its state.
#[test]
fn latencies_of_a_table_add_up() {
    let file = text("server.log");
    let table = csv::table(&read(&file, "").whole_report(&file.as_slice()));
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let column = |name: &str| head.iter().position(|it| *it == name).unwrap();
    let (state, latency, direction) = (column("state"), column("latency ms"), column("direction"));
    let rows: Vec<Vec<&str>> = lines.collect();
    assert!(rows.iter().all(|row| row[direction] == "response" || row[latency].is_empty()));
    assert_eq!(rows.iter().filter(|row| row[state] == "unanswered").count(), 1);
    assert_eq!(rows.iter().filter(|row| row[state] == "slow").count(), 2);
}

/// Pieces that logs are made of, put together anyhow.
const PIECES: [&str; 16] = [
    "01 03 00 C8 00 03 84 35",
    "05 83 02 81 30",
    ":010300C8000331",
    "10.0.0.7:502",
    "fe80::1:2",
    "00:0E:8C:01:02:03",
    "unit 5",
    "slave_id=0x05",
    "Miller",
    "\n",
    " ",
    ", ",
    "é",
    "[01][03]",
    "0x01, 0x03, ",
    "10:00:00.5 ",
];

proptest::proptest! {
    /// Whatever a file holds, something comes out, and what nobody hides stays.
    #[test]
    fn any_file_goes_out(bytes in proptest::collection::vec(0_u8.., 0..400)) {
        goes_out(&bytes);
    }

    #[test]
    fn any_text_goes_out(picked in proptest::collection::vec(0..PIECES.len(), 0..60)) {
        let text: String = picked.into_iter().map(|at| PIECES[at]).collect();
        goes_out(text.as_bytes());
    }
}

fn goes_out(file: &[u8]) {
    let Ok(log) = Log::read(file, &Reading::default(), Options::default()) else { return };
    let digest = log.digest(&file, &log.findings(&file));
    assert!(digest.telegrams.len() <= 10 && !digest.text(true).is_empty());
    let capture = captured(&log, file);
    let again = Log::read(&capture, &Reading::default(), Options::default());
    assert!(again.is_ok_and(|again| again.fault().is_none()));
    let size = file.len() as u64;
    let none = log.redacted(&file, size, &Hidden::default());
    assert!(none.is_capture || none.file == file || str::from_utf8(file).is_err());
    let all = log.redacted(&file, size, &hidden());
    assert!(all.replaced.iter().all(|it| it.from != it.to));
}

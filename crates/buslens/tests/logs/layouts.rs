use std::fmt::Write as _;

use buslens::field::{Direction, hex};
use buslens::text::{LAYOUTS, Layout, recognise};
use buslens::tool::log::{Log, Reading, Source};
use buslens::tool::{Options, Report, decode_file};

use super::generator::{Random, exchanges};
use super::programs::{PROGRAMS, Program, clock, joined, lower, upper};

/// The log of a program, and the telegrams in it.
fn log(program: &Program, seed: u64) -> (String, Vec<(Vec<u8>, Direction)>) {
    let mut text = String::new();
    let mut truth = Vec::new();
    for (n, sent) in exchanges(seed, 40).iter().enumerate() {
        let bytes = (program.frame)(sent, n);
        (program.write)(&mut text, &bytes, sent.direction == Direction::Request, n);
        truth.push((bytes, sent.direction));
    }
    (text, truth)
}

fn read(file: &[u8]) -> Report {
    decode_file(file, &Reading::default(), Options::default()).expect("a log")
}

fn found(report: &Report) -> Vec<(Vec<u8>, Direction)> {
    report.telegrams.iter().map(|telegram| (telegram.line.bytes.clone(), telegram.guess.direction)).collect()
}

#[track_caller]
fn assert_found(text: &[u8], truth: &[(Vec<u8>, Direction)], what: &str) {
    let report = read(text);
    let found = found(&report);
    for (index, (found, truth)) in found.iter().zip(truth).enumerate() {
        assert_eq!((hex(&found.0), found.1), (hex(&truth.0), truth.1), "{what}, telegram {index}");
    }
    assert_eq!(found.len(), truth.len(), "{what}");
}

#[test]
fn every_layout_gives_its_truth() {
    for (index, program) in PROGRAMS.iter().enumerate() {
        for seed in 0..2 {
            let (text, truth) = log(program, seed);
            assert_found(text.as_bytes(), &truth, &format!("layout {index}, seed {seed}"));
            let known = recognise(text.as_bytes()).layout.map_or("", |layout| layout.key);
            assert_eq!(known, program.layout, "layout {index}");
        }
    }
}

#[test]
fn line_ends_prose_and_encodings_change_nothing() {
    const PROSE: [&str; 5] = [
        "Operator restarted pump 4, ticket 20260401 is open.",
        "please ask them to send the answer again",
        "",
        "setpoint 50 % from 12:30 on, all 4 units fine",
        "--- second page ---",
    ];
    for (index, program) in PROGRAMS.iter().enumerate() {
        let (text, truth) = log(program, 7);
        let mut random = Random(index as u64);
        let with_prose: String = text
            .lines()
            .flat_map(|line| {
                let prose = if random.below(3) == 0 { Some(random.of(&PROSE)) } else { None };
                std::iter::once(line).chain(prose)
            })
            .flat_map(|line| [line, "\n"])
            .collect();
        assert_found(with_prose.as_bytes(), &truth, &format!("prose in layout {index}"));
        assert_found(text.replace('\n', "\r\n").as_bytes(), &truth, &format!("CR LF in layout {index}"));
        assert_found(text.replace('\n', "\r").as_bytes(), &truth, &format!("CR in layout {index}"));
        let wide: Vec<u8> = format!("\u{FEFF}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_found(&wide, &truth, &format!("UTF-16 of layout {index}"));
    }
}

/// What is left of a log when lines are lost is found exactly.
#[test]
fn lost_lines_take_only_their_own_telegrams() {
    for (index, program) in PROGRAMS.iter().enumerate() {
        let mut random = Random(index as u64 + 100);
        let (mut text, mut truth) = (String::new(), Vec::new());
        for (n, sent) in exchanges(11, 60).iter().enumerate() {
            if random.below(5) > 0 {
                let bytes = (program.frame)(sent, n);
                (program.write)(&mut text, &bytes, sent.direction == Direction::Request, n);
                truth.push(hex(&bytes));
            }
        }
        let found = read(text.as_bytes()).telegrams.into_iter();
        let found: Vec<String> = found.map(|telegram| hex(&telegram.line.bytes)).collect();
        assert_eq!(found, truth, "layout {index}");
    }
}

#[test]
fn pieces_of_any_size_give_the_same() {
    for (index, program) in PROGRAMS.iter().enumerate() {
        let (text, _) = log(program, 3);
        let whole = Log::read(text.as_bytes(), &Reading::default(), Options::default()).unwrap();
        for size in [1, 7, 4096] {
            let mut log =
                Log::open(text.as_bytes(), text.len() as u64, &Reading::default(), Options::default())
                    .unwrap();
            text.as_bytes().chunks(size).for_each(|part| assert!(log.push(part)));
            log.finish();
            assert_eq!(log.entries(), whole.entries(), "layout {index} in pieces of {size}");
        }
    }
}

/// The places of a telegram's bytes are its digits.
#[test]
fn each_byte_knows_its_place_in_the_log() {
    for (index, program) in PROGRAMS.iter().enumerate() {
        let (text, _) = log(program, 5);
        let log = Log::read(text.as_bytes(), &Reading::default(), Options::default()).unwrap();
        let report = log.whole_report(&text.as_bytes());
        for telegram in &report.telegrams {
            let line = &telegram.line;
            assert_eq!(line.places.len(), line.bytes.len(), "layout {index}");
            for (place, byte) in line.places.iter().zip(&line.bytes) {
                let digits = &text[place.from..place.to];
                let plain = digits.trim_start_matches("0x").trim_start_matches("\\x").trim_end_matches('h');
                let values = [u8::from_str_radix(plain, 16).ok(), plain.parse().ok()];
                // A string is one place for all of its bytes, each character one.
                assert!(
                    values.contains(&Some(*byte)) || digits.len() == 1,
                    "layout {index}: {digits:?} for {byte:02X}"
                );
            }
        }
    }
}

/// Dumps without anything between the telegrams: xxd, `hexdump -C`, od.
#[test]
fn dumps_of_a_stream_are_split() {
    let truth: Vec<(Vec<u8>, Direction)> =
        exchanges(21, 60).iter().map(|sent| (sent.rtu(), sent.direction)).collect();
    let stream: Vec<u8> = truth.iter().flat_map(|(bytes, _)| bytes.clone()).collect();
    let shown = |part: &[u8]| -> String {
        part.iter().map(|byte| if matches!(byte, b' '..=b'~') { char::from(*byte) } else { '.' }).collect()
    };
    let mut dumps = vec![String::new(); 6];
    for (row, part) in stream.chunks(16).enumerate() {
        let at = row * 16;
        let pairs: Vec<String> = part.chunks(2).map(|pair| joined(pair, "", lower)).collect();
        writeln!(dumps[0], "{at:08x}: {:39}  {}", pairs.join(" "), shown(part)).unwrap();
        let halves: Vec<String> = part.chunks(8).map(|half| joined(half, " ", lower)).collect();
        writeln!(dumps[1], "{at:08x}  {:48}  |{}|", halves.join("  "), shown(part)).unwrap();
        writeln!(dumps[2], "{at:07o} {}", joined(part, " ", lower)).unwrap();
        let octal: Vec<String> = part.iter().map(|byte| format!("{byte:03o}")).collect();
        writeln!(dumps[4], "{at:07o} {}", octal.join(" ")).unwrap();
        // od fills half a word up with 00.
        let words = part.chunks(2).map(|pair| u16::from_le_bytes([pair[0], *pair.get(1).unwrap_or(&0)]));
        let octal: Vec<String> = words.map(|word| format!("{word:06o}")).collect();
        writeln!(dumps[5], "{at:07o} {}", octal.join(" ")).unwrap();
        if part.len() == 16 {
            let words: Vec<String> =
                part.chunks(2).map(|pair| format!("{:02x}{:02x}", pair[1], pair[0])).collect();
            writeln!(dumps[3], "{at:07x} {}", words.join(" ")).unwrap();
        }
    }
    for (dump, text) in dumps.iter().enumerate().filter(|(dump, _)| *dump != 3) {
        assert_found(text.as_bytes(), &truth, &format!("dump {dump}"));
    }
    // Words with the low byte first; the last row is left out, since it may have half a word.
    let found = found(&read(dumps[3].as_bytes()));
    assert_eq!(found[..truth.len() - 4], truth[..truth.len() - 4]);
    // The stream itself, and all of it in one line.
    let binary = Reading { input: buslens::tool::log::Input::Binary, ..Reading::default() };
    let report = decode_file(&stream, &binary, Options::default()).unwrap();
    assert_eq!(self::found(&report), truth);
    assert_found(hex(&stream).as_bytes(), &truth, "one line");
}

#[test]
fn several_telegrams_in_a_line_and_one_printed_twice() {
    let truth: Vec<(Vec<u8>, Direction)> =
        exchanges(31, 30).iter().map(|it| (it.rtu(), it.direction)).collect();
    let mut text = String::new();
    for pair in truth.chunks(2) {
        writeln!(text, "poll: TX {} RX {}", hex(&pair[0].0), hex(&pair[1].0)).unwrap();
    }
    assert_found(text.as_bytes(), &truth, "a line for each exchange");
    let mut text = String::new();
    for (bytes, direction) in &truth {
        let word = if *direction == Direction::Request { "send" } else { "recv" };
        writeln!(text, "09:00:00.100 {word} {}\n09:00:00.100 framer {word} {}", hex(bytes), hex(bytes))
            .unwrap();
    }
    assert_found(text.as_bytes(), &truth, "each twice");
}

/// How a line can be written, with things around the bytes that look like bytes.
type Line = fn(&[u8], bool, &str) -> String;

fn way(asks: bool) -> &'static str {
    if asks { "TX" } else { "RX" }
}

static LINES: &[Line] = &[
    |bytes, asks, _| format!("[0x7f3a2b10c0] {} {}", way(asks), hex(bytes)),
    |bytes, asks, time| format!("{time} 00:1B:44:11:3A:B7 {} {}", way(asks), hex(bytes)),
    |bytes, asks, _| {
        format!("id=3f2504e0-4f89-11d3-9a0c-0305e82c3301 {}: {}", way(asks), joined(bytes, " ", lower))
    },
    |bytes, asks, time| format!("{time} add bad face dead beef {}: {}", way(asks), hex(bytes)),
    |bytes, asks, time| format!("{time} (thread 0x1a2b) {}: {}", way(asks), hex(bytes)),
    // Lists as several languages print them, with numbers below 0 as well.
    |bytes, asks, _| format!("{} {bytes:?}", if asks { "write" } else { "read" }),
    |bytes, asks, _| format!("{} [{}]", way(asks), joined(bytes, " ", |byte| byte.to_string())),
    |bytes, asks, _| {
        format!("{} [{}]", way(asks), joined(bytes, ", ", |byte| byte.cast_signed().to_string()))
    },
    |bytes, asks, _| format!("{} <Buffer {}>", way(asks), joined(bytes, " ", lower)),
    |bytes, asks, _| format!("{} {}", way(asks), joined(bytes, " ", |byte| format!("16#{byte:02X}"))),
    |bytes, asks, _| format!("{} {}", way(asks), joined(bytes, ",", |byte| format!("${byte:02X}"))),
    |bytes, asks, _| format!("{} {}", way(asks), joined(bytes, "", |byte| format!("%{byte:02X}"))),
    |bytes, asks, _| format!("{} {}", way(asks), joined(bytes, " ", |byte| format!("{byte:x}"))),
    |bytes, asks, _| format!("{}_{}", way(asks), joined(bytes, "_", upper)),
    |bytes, asks, _| format!("{} {}", way(asks), joined(bytes, "/", upper)),
    // Who speaks, in other words.
    |bytes, asks, _| format!("{}: {}", if asks { "Master -> Slave" } else { "Slave -> Master" }, hex(bytes)),
    |bytes, asks, _| {
        format!("{}: {}", if asks { "server <- client" } else { "client <- server" }, hex(bytes))
    },
    |bytes, asks, _| format!("{} {}", if asks { ">" } else { "<" }, hex(bytes)),
    |bytes, _, time| format!("{time} {}", hex(bytes)),
    // Counts and remarks before and behind.
    |bytes, _, _| format!("({}) {}", bytes.len(), hex(bytes)),
    |bytes, asks, _| format!("{} {} {}", way(asks), bytes.len(), hex(bytes)),
    |bytes, asks, _| format!("{} [{:02X}] {}", if asks { ">>" } else { "<<" }, bytes.len(), hex(bytes)),
    |bytes, _, _| format!("{} ; unit {} fc {:02} as expected", hex(bytes), bytes[0], bytes[1]),
    |bytes, asks, _| {
        let check = &bytes[bytes.len() - 2..];
        format!("{} {} CRC={} OK", way(asks), hex(bytes), joined(check, "", upper))
    },
    |bytes, asks, time| format!("\"17\",\"{time}\",\"{}\",\"{}\",\"{}\"", way(asks), hex(bytes), bytes.len()),
    |bytes, asks, time| format!("\x1B[0;36m[{time}] {} {}\x1B[0m", way(asks), hex(bytes)),
    // In chunks of five.
    |bytes, asks, time| {
        let chunks: Vec<String> =
            bytes.chunks(5).map(|part| format!("{time} {}: {}", way(asks), hex(part))).collect();
        chunks.join("\n")
    },
];

#[test]
fn what_looks_like_bytes_is_none() {
    for (index, line) in LINES.iter().enumerate() {
        for seed in 40..42 {
            let (mut text, mut truth) = (String::new(), Vec::new());
            for (n, sent) in exchanges(seed, 60).iter().enumerate() {
                let asks = sent.direction == Direction::Request;
                writeln!(text, "{}", line(&sent.rtu(), asks, &clock(n))).unwrap();
                truth.push((sent.rtu(), sent.direction));
            }
            assert_found(text.as_bytes(), &truth, &format!("line {index}, seed {seed}"));
        }
    }
}

/// All of a log in one line.
#[test]
fn a_line_can_hold_a_whole_log() {
    let truth: Vec<(Vec<u8>, Direction)> =
        exchanges(51, 60).iter().map(|sent| (sent.rtu(), sent.direction)).collect();
    let words = |asks| if asks { "TX" } else { "RX" };
    let text: Vec<String> = truth
        .iter()
        .map(|(bytes, direction)| format!("{} {}", words(*direction == Direction::Request), hex(bytes)))
        .collect();
    assert_found(text.join(" ").as_bytes(), &truth, "one line with words");
}

#[test]
fn every_layout_is_tried() {
    let tried = |layout: &Layout| {
        PROGRAMS.iter().any(|program| program.layout == layout.key)
            || matches!(layout.key, "xxd" | "hexdump" | "od" | "tcpdump")
    };
    assert!(LAYOUTS.iter().all(tried));
}

/// Half a page of a source can be read again at any place.
#[test]
fn a_source_gives_what_is_there() {
    let text: &[u8] = b"01 03";
    assert_eq!(text.read(3, 10), b"03");
    assert_eq!(text.read(9, 10), b"");
}

//! What is made of bytes that come one behind the other: streams, connections, lines with a byte each.

use std::fmt::Write as _;

use buslens::dialogue::traffic::{Chunk, Dialog, Hint, Role, Statistics, Traffic, statistics};
use buslens::field::{Direction, Facts, hex};
use buslens::frame::Settings;
use buslens::tool::Protocol;

use super::{assert_table, bytes};

const ASKS: &str = "01 03 00 C8 00 03 84 35";
const ANSWERS: &str = "01 03 06 00 80 42 A4 F1 DE B0 F8";
const ANSWERS_2: &str = "01 03 06 00 80 40 F0 00 00 B9 4F";
const ANSWERS_TOO: &str = "01 03 06 00 80 00 00 00 00 1D 67";

/// How the chunks of a case come.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// Without anything that parts telegrams.
    Stream,
    /// Each by itself.
    Pieces,
    /// A byte or two each, with their times.
    Flow,
    /// Two directions of a connection.
    Connection,
}

/// The entries that come of chunks: `port hint time: bytes`, parted by slashes.
fn told(table: &mut String, way: Way, protocol: &str, chunks: &str) {
    let mut traffic = Traffic::new(Protocol::of(protocol).unwrap(), &Settings::default());
    match way {
        Way::Stream => traffic.stream(),
        Way::Flow => traffic.flow(),
        Way::Pieces | Way::Connection => {}
    }
    let mut offset = 0;
    for chunk in chunks.split(" / ") {
        let (head, text) = chunk.split_once(": ").unwrap_or(("", chunk));
        let text = text
            .replace("ANSWERS_2", ANSWERS_2)
            .replace("ASKS", ASKS)
            .replace("ANSWERS_TOO", ANSWERS_TOO)
            .replace("ANSWERS", ANSWERS);
        let bytes: Vec<u8> = text
            .split(' ')
            .filter(|part| !part.is_empty())
            .flat_map(|part| match part.split_once('x') {
                // 00x300: so many of a byte.
                Some((byte, count)) => vec![u8::from_str_radix(byte, 16).unwrap(); count.parse().unwrap()],
                None => bytes(part),
            })
            .collect();
        let mut of_head = Chunk { bytes: &bytes, offset, line: 0, ..Chunk::default() };
        for word in head.split(' ').filter(|word| !word.is_empty()) {
            match word {
                ">" => of_head.hint = Hint::Logger,
                "<" => of_head.hint = Hint::Other,
                "?" => of_head.hint = Hint::Says(Direction::Request),
                "!" => of_head.hint = Hint::Says(Direction::Response),
                "+" => of_head.joins = true,
                "known" => of_head.known_port = true,
                word => match word.strip_prefix('p') {
                    Some(port) => of_head.port = port.parse().unwrap(),
                    None => of_head.time = Some((word.parse::<f64>().unwrap() * 1e6) as i64),
                },
            }
        }
        of_head.both_ways = way == Way::Connection;
        traffic.take(of_head);
        offset += bytes.len() as u64;
    }
    traffic.untyped();
    traffic.finish();
    /// So many say what all of them would.
    const MOST: usize = 12;
    writeln!(table, "{}", chunks.chars().take(400).collect::<String>()).unwrap();
    for entry in traffic.entries().iter().take(MOST) {
        let own = traffic.entries().kept(&entry).unwrap();
        let bytes = match own.len() {
            0..=40 => hex(own),
            length => format!("{} … ({length} bytes)", hex(&own[..8])),
        };
        let mut said = format!(
            "{bytes} | at {}+{}, {} {:?} {:?}",
            entry.offset,
            entry.skip,
            entry.protocol().key,
            entry.verdict,
            entry.direction
        );
        if entry.role != Role::Plain {
            write!(said, " {:?}", entry.role).unwrap();
        }
        if let Some(partner) = entry.partner() {
            write!(said, ", with {partner}").unwrap();
        }
        write!(said, ", unit {:?}, function {}, sides {:?}", entry.unit, entry.function, entry.sides())
            .unwrap();
        if entry.port > 0 {
            write!(said, ", port {}", entry.port).unwrap();
        }
        if let Some(time) = entry.time() {
            write!(said, ", time {time}").unwrap();
        }
        writeln!(table, "    {said}").unwrap();
    }
    if !traffic.pauses().is_empty() {
        writeln!(table, "    pauses {:?}", traffic.pauses()).unwrap();
    }
    if traffic.foreign() > 0 {
        writeln!(table, "    {} of no telegrams", traffic.foreign()).unwrap();
    }
    let all = statistics(&traffic);
    let dialogs = all.dialogs.len();
    writeln!(table, "    {}, times {:?}", counts(&all), all.times).unwrap();
    for it in all.dialogs.iter().filter(|it| dialogs > 1 || it.median.is_some() || it.silent.is_some()) {
        let silent = it.silent.map(|it| (it.from, it.to, it.count));
        writeln!(
            table,
            "    {}, median {:?}, worst {:?}, silent {silent:?}",
            dialog(it),
            it.median,
            it.worst
        )
        .unwrap();
    }
}

/// What is counted of a conversation.
pub fn counts(all: &Statistics) -> String {
    format!(
        "{} telegrams, {} pairs, {} unanswered, {} retries, {} unasked, {} late, {} echoes, {} copies, {} broadcasts, \
         {} exceptions, {} wrong, {} unchecked, {} discarded",
        all.telegrams,
        all.pairs,
        all.unanswered,
        all.retries,
        all.unasked,
        all.late,
        all.echoes,
        all.copies,
        all.broadcasts,
        all.exceptions,
        all.check_failed,
        all.unchecked,
        all.bytes_discarded
    )
}

/// What is counted of a function of a unit.
pub fn dialog(it: &Dialog) -> String {
    format!(
        "port {} unit {:?} function {}: {} telegrams, {} requests, {} answered, {} unanswered, {} retries, \
         {} exceptions, {} wrong",
        it.port,
        it.unit,
        it.function,
        it.telegrams,
        it.requests,
        it.answered,
        it.unanswered,
        it.retries,
        it.exceptions,
        it.check_failed
    )
}

#[test]
fn other_protocols_are_counted() {
    let mut table = String::new();
    let mut traffic = Traffic::new(Protocol::of("modbus-rtu").unwrap(), &Settings::default());
    for text in ["10 5B 0A 65 16", "AA 55 01 00 00 0B 11 04 00 01 20"] {
        let chunk = Chunk { bytes: &bytes(text), facts: Some(Facts::default()), ..Chunk::default() };
        traffic.take(chunk);
    }
    traffic.untyped();
    traffic.finish();
    writeln!(table, "{:?}", traffic.foreign_protocols()).unwrap();
    assert_table("other_protocols", &table);
}

#[test]
fn streams_and_connections() {
    let mut table = String::new();
    // What is ambiguous by itself is told by what comes behind it, once there is enough.
    for (pause, other) in [(0.1, 0.001), (0.001, 0.1)] {
        let exchange = |n: usize| {
            let time = n as f64;
            format!(
                "{time}: 06 04 22 07 00 01 8B C4 / {}: 06 04 02 00 40 0D / {}: 00",
                time + pause,
                time + pause + other
            )
        };
        let many: Vec<String> = (0..40).map(exchange).collect();
        told(&mut table, Way::Flow, "modbus-rtu", &many.join(" / "));
        let alone: Vec<String> =
            (0..100).map(|n| format!("{n}: 06 04 02 00 40 0D / {}: 00", n as f64 + other)).collect();
        told(&mut table, Way::Flow, "modbus-rtu", &alone.join(" / "));
    }
    // Byte by byte; more is there when the first bytes are told apart.
    let one_by_one = |text: &str| {
        let chunk = |(n, byte)| format!("{}: {byte}", n as f64 / 1000.0);
        text.split(' ').enumerate().map(chunk).collect::<Vec<_>>().join(" / ")
    };
    let exchanges = " 08 03 02 8D 00 01 15 00 08 03 02 00 00 64 45".repeat(40);
    for before in [9, 10, 11] {
        told(
            &mut table,
            Way::Flow,
            "modbus-rtu",
            &one_by_one(&format!("{}{exchanges}", vec!["55"; before].join(" "))),
        );
    }
    for (way, protocol, cases) in [
        (
            Way::Stream,
            "modbus-rtu",
            &[
                "ASKS ANSWERS ASKS ANSWERS_TOO",
                "ASKS / ANSWERS",
                "01 03 00 C8 / 00 03 84 / 35 01 03 06 00 / 80 42 A4 F1 DE B0 F8",
                "55 ASKS AA AA ANSWERS FF",
                "ASKS 01 03 06 00 80 42 A4 F1 DE B0 F9 ASKS",
                "ASKS 01 03 06 00 80 ASKS ANSWERS",
                "ASKS 01 83 02 C0 F1 01 83 02 C0 F2 ASKS",
                "00x300 ASKS",
                "FFx20000 ASKS",
                "11 22 33",
                "01 03 00 C8 00 03 84",
                "11 42 01 02 03 5D 21 ASKS",
                "02 06 00 C8 00 05 00 00 ASKS",
                "ASKS ASKS ANSWERS ASKS ASKS ANSWERS ASKS ASKS ANSWERS",
                "ASKS ASKS ANSWERS ANSWERS ASKS ASKS ANSWERS ANSWERS",
                "01 05 00 C8 FF 00 0D C4 01 05 00 C8 FF 00 0D C4 01 05 00 C8 00 00 4C 34 01 05 00 C8 00 00 4C 34",
                "01 05 00 C8 FF 00 0D C4 01 05 00 C8 00 00 4C 34",
                "00 05 00 C8 FF 00 0C 15 ASKS ANSWERS",
                "ANSWERS ASKS",
                "ASKS FFx20000 ASKS",
                "08 03 02 8D 00 01 15 00 08 03 02 8D 00 01 15 00 55",
                "08 03 00 10 00 01 85 56 08 03 02 8D 00 01 15 00",
            ][..],
        ),
        (
            Way::Stream,
            "modbus-tcp",
            &[
                "00 01 00 00 00 0F 01 03 00 C8 00 03 / 00 02 00 00 00 06 01 03 00 C8 00 03 / 00 03 00 00 00 06 01 03 00 C8 00 03",
                "00 01 00 00 00 06 01 03 00 C8 00 03 00 01 00 00 00 09 01 03 06 00 80 42 A4 F1 DE",
                "00 01 00 00 00 06 01 03 00 C8 00 03 55 00 02 00 00 00 06 01 03 00 C8 00 03",
                "00 01 00 00 00 06 01 03 00 C8 / 00 03 00 02 00 00 00 06 01 03 00 C8 00",
                "00 01 00 00 00 06 01 03 00 C8 00 03 00 02 00 00 00 06 01 03 00 C8 00 03 00 02 00 00 00 03 01 83 02 \
                 00 01 00 00 00 03 01 83 02",
            ],
        ),
        (
            Way::Stream,
            "profibus-fdl",
            &[
                "10 01 02 49 4C 16 E5 68 05 05 68 81 82 5D 3B 3E D9 16 E5 DC 01 02",
                "10 01 02 49 4D 16 10 01 02 49 4C 16",
                "55 68 05 05 68 81 82 5D 3B 3E / D9 16",
            ],
        ),
        (
            Way::Pieces,
            "modbus-rtu",
            &[
                "0: ASKS / 0.02: ANSWERS / 1: ASKS / 1.5: ANSWERS / 2: ASKS / 2.03: ANSWERS",
                "> 0: ASKS / < 0.02: ANSWERS / > 1: ASKS / < 1.2: 01 83 02 C0 F1",
                "< 0: ASKS / > 0.02: ANSWERS / < 1: ASKS / > 1.02: ANSWERS",
                "> 0: ASKS / < 0.01: ASKS / < 0.02: ANSWERS / > 1: ASKS / < 1.01: ASKS / < 1.02: ANSWERS",
                "? 0: ASKS / ! 0.02: ASKS",
                "? p0 0: ASKS / ! p1 0.02: ANSWERS",
                "p0 0: ASKS / p1 0.02: ANSWERS",
                "? p0 0: 01 05 00 C8 FF 00 0D C4 / ! p1 0.02: 01 05 00 C8 FF 00 0D C4",
                "p0 0: ASKS / p1 0.01: ASKS / p0 0.02: ANSWERS / p1 0.03: ANSWERS",
                "0: ASKS / 1: ASKS / 2: 02 03 00 C8 00 03 84 06 / 2.5: ANSWERS",
                "0: ASKS / 1: 02 03 00 C8 00 03 84 06 / 2: 03 03 00 C8 00 03 85 D7 / 3: ANSWERS",
                "86399.9: ASKS / 0.1: ANSWERS",
                "50000: ASKS / 49999: ANSWERS",
                "43200: ASKS / 0: ANSWERS",
                "43201: ASKS / 0: ANSWERS",
                "90000: ASKS / 0: ANSWERS",
                "0: 01 03 00 C8 / + 0.1: 00 03 84 35",
                "0: ASKS / 1: ASKS / 2: ASKS / 3: ASKS / 4: ASKS / 5: ASKS / 100: ANSWERS",
                "0: 02 03 00 C8 00 03 84 06 / 1: 02 03 00 C9 00 03 D5 C6 / 2: 02 03 00 CA 00 03 25 C6 / 3: 02 03 00 CB 00 03 74 06 / \
                 4: 02 03 00 CC 00 03 C5 C7 / 100: ASKS / 100.02: ANSWERS",
                "0: ASKS / 0.01: ANSWERS / 1: ASKS / 1.05: ANSWERS / 2: ASKS / 2.03: ANSWERS / 3: ASKS / 3.04: ANSWERS",
                "02x300",
                "ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS ASKS",
                "01 03 00 C8 00 03 00x1100",
                "11 42 01 02 03 5D 21 / 11 42 01 02 03 5D 21",
                "11 42 01 02 03 5D 21 / 11 42 01 02 03 5D 21 / 11 42 09 09 09 D7 E7",
                "01 03 00 C8 00 03 00x1018",
                "01 03 00 C8 00 03 00x1019",
                "55x1100 ASKS / 01 03 00 C8 00 03",
                "> 0: ASKS / < 0.01: ASKS / < 0.02: ANSWERS / > 1: ASKS / < 1.01: ASKS / < 1.02: ANSWERS / > 2: 01 05 00 C8 FF 00 0D C4 / \
                 < 2.01: 01 05 00 C8 FF 00 0D C4 / < 2.02: 01 05 00 C8 FF 00 0D C4",
                "> 0: ASKS / < 0.01: ANSWERS / > 1: 01 03 02 00 05 84 35 / < 2: 01 03 00 C8 00 03 84 36",
                "5: ASKS / 5: 02 03 00 C8 00 03 84 06 / 5: ASKS / 5: 02 03 00 C8 00 03 84 06 / \
                 5: ASKS / 5: 02 03 00 C8 00 03 84 06 / 5: ASKS / 5: 02 03 00 C8 00 03 84 06 / \
                 5: ASKS / 5: 02 03 00 C8 00 03 84 06 / 5: ASKS / 5: 02 03 00 C8 00 03 84 06",
                "0: ASKS / 1: 01 03 04 00 08 00 00 12 34",
                "0: 01 03 00 C8 / 0.005: 00 03 84 35 / 1: ASKS",
                "0: 01 03 00 C8 / 0.00501: 00 03 84 35 / 1: ASKS",
                "0: ASKS / 1: 02 03 04 00 08 00 00 12 34",
                "0: ASKS / 1: 01 03 05 00 08 00 00 12 34",
                "0: ASKS / 1: 02 03 05 00 08 00 00 12 34",
                "> 0: ASKS / < 0.1: ASKS / > 1: ASKS / < 1.1: ASKS / > 2: ASKS / < 2.1: ASKS / > 3: ASKS / > 10: ASKS",
                "> 0: ASKS / < 0.1: ASKS / > 1: ASKS / < 1.1: ASKS / > 3: ANSWERS_2 / > 4: ASKS / < 5: ANSWERS / > 6: ASKS / < 7: ANSWERS / \
                 > 8: ASKS",
                "86399.9: ASKS / 0.1: ANSWERS / 86399.9: ASKS / 0.1: ANSWERS",
                "> 0: ASKS / > 1: 01 05 00 C8 FF 00 0D C4",
                "< 0: ASKS / < 1: 01 05 00 C8 FF 00 0D C4",
                "> 0: ANSWERS / > 1: 01 05 00 C8 FF 00 0D C4 / < 2: 01 05 00 C8 FF 00 0D C4",
                "> 0: ASKS / < 1: ASKS / > 2: 01 05 00 C8 FF 00 0D C4",
                "> 0: ASKS / < 1: ASKS / < 2: ASKS / < 3: 01 05 00 C8 FF 00 0D C4",
                "> 0: ASKS / < 1: ASKS / < 2: ASKS / < 3: ASKS / < 4: 01 05 00 C8 FF 00 0D C4",
                "! 0: ASKS / ? 1: ANSWERS",
                "0: ASKS / 1: ASKS / 2: ANSWERS / 3: ANSWERS / 4: ASKS / 5: ANSWERS",
                "0: ASKS / 1: ANSWERS / 2: ANSWERS / 3: ASKS / 4: ANSWERS_2 / 5: ANSWERS_2",
                "0: ASKS / 1: ANSWERS / 2: ANSWERS / 2.1: ANSWERS / 3: ASKS / 4: ANSWERS_2 / 5: ANSWERS_2",
                "p0 0: ASKS / p1 0.1: ASKS / p1 0.2: ANSWERS / p0 0.3: ANSWERS / p0 1: ASKS / p1 1.1: ASKS",
                "0: 01 03 06 00 80 42 A4 F1 DE B0 F9 / 1: ANSWERS",
                "0: ASKS / 1: 01 03 06 00 80 42 A4 F1 DE B0 F9 / 2: ANSWERS",
                "0: ASKS / 1: ASKS / 2: 01 03 00 C9 00 03 D5 F5 / 3: ANSWERS",
                "0: 01 03 00 C9 00 03 D5 F5 / 1: ASKS / 2: ANSWERS / 3: ANSWERS",
                "0: 02 03 00 C8 00 03 84 06 / 1: 03 03 00 C8 00 03 85 D7 / 2: 04 03 00 C8 00 03 84 60 / 3: 05 03 00 C8 00 03 85 B1 / \
                 4: 06 03 00 C8 00 03 85 82 / 5: 07 03 00 C8 00 03 84 53 / 6: 08 03 00 C8 00 03 84 AC / 7: ASKS / \
                 8: 09 03 00 C8 00 03 85 7D / 9: ANSWERS",
                "0: ASKS / 1: 02 03 00 C8 00 03 84 06 / 2: 03 03 00 C8 00 03 85 D7 / 3: 04 03 00 C8 00 03 84 60 / \
                 4: 05 03 00 C8 00 03 85 B1 / 5: 06 03 00 C8 00 03 85 82 / 6: 07 03 00 C8 00 03 84 53 / 7: 08 03 00 C8 00 03 84 AC / \
                 8: ANSWERS",
                "0: ASKS / 1: 02 03 00 C8 00 03 84 06 / 2: 03 03 00 C8 00 03 85 D7 / 3: 04 03 00 C8 00 03 84 60 / \
                 4: 05 03 00 C8 00 03 85 B1 / 5: 06 03 00 C8 00 03 85 82 / 6: 07 03 00 C8 00 03 84 53 / 7: 08 03 00 C8 00 03 84 AC / \
                 8: 09 03 00 C8 00 03 85 7D / 9: ANSWERS",
                "0: 02 03 00 C8 00 03 84 06 / 1: 02 03 00 C9 00 03 D5 C6 / 2: 02 03 00 CA 00 03 25 C6 / 3: 02 03 00 CB 00 03 74 06 / \
                 4: 02 03 00 CC 00 03 C5 C7 / 14: ASKS / 14.02: ANSWERS",
                "0: 02 03 00 C8 00 03 84 06 / 1: 02 03 00 C9 00 03 D5 C6 / 2: 02 03 00 CA 00 03 25 C6 / 3: 02 03 00 CB 00 03 74 06 / \
                 4: 02 03 00 CC 00 03 C5 C7 / 11: ASKS / 12: ANSWERS",
                "0: 02 03 00 C8 00 03 84 06 / 1: 02 03 00 C9 00 03 D5 C6 / 2: 02 03 00 CA 00 03 25 C6 / 3: 02 03 00 CB 00 03 74 06 / \
                 100: ASKS / 100.02: ANSWERS",
                "0: 02 03 00 C8 00 03 84 06 / 50: 02 03 00 C9 00 03 D5 C6 / 51: 02 03 00 CA 00 03 25 C6 / 52: 02 03 00 CB 00 03 74 06 / \
                 53: 02 03 00 CC 00 03 C5 C7 / 54: 02 03 00 C8 00 03 84 06 / 55: 02 03 00 C9 00 03 D5 C6 / 100: ASKS / 100.02: ANSWERS",
                "+ 0: ASKS / + 0.1: ANSWERS",
                "0: FA 05 00 01 12 34 / 1: 01 03 00 C8 / 1.1: 00 03 84 35 / 2: FA 05 00 01 12 35 / 3: 01 03 06 00 80 / 3.3: 42 A4 F1 DE B0 F8",
                "0: 01 03 00 C8 / 0.1: 00 03 84 35 / 2: FA 05 00 01 12 35 / 3: 01 03 06 00 80 / 3.3: 42 A4 F1 DE B0 F8",
                "0: 01 03 00 / + 0.4: C8 00 / + 1.9: 03 84 / + 2: 35",
                "> 0: 01 03 00 C8 / < + 0.1: 00 03 84 35",
                "01 03 06 00 80 42 A4 F1 DE B0 F8 / 01 03 06 00 80 42 A4 F1 DE B0 F8 55",
                "0: 01 03 06 00 80 42 A4 F1 DE B0 F9 / 1: ANSWERS / 11 42 01 02 03 5D 21 / 11 42 01 02 03 5D 21",
                "< + 0.1: 00 03 84 35 / > 0: 01 03 00 C8 / < 0: ASKS / > 0.02: ANSWERS / < 1: ASKS / ! > 1.02: ANSWERS",
                "< 3: 01 05 00 C8 FF 00 0D C4 / > 0: ASKS / < 1: ASKS / < 2: ASKS / > 0: ASKS",
                "< 0.02: ANSWERS / 01 03 00 C8 00 03 00x1018 / > 1: ASKS / < 1.2: 01 83 02 C0 F1",
                "0: ASKS / 0: ASKS / 1: 02 03 05 00 08 00 00 12 34",
                "p0 ! 0: ASKS / ? 1: ANSWERS / 02x300 / > 0: ASKS / < 1: ASKS / < 2: ASKS / < 3: 01 05 00 C8 FF 00 0D C4",
                "+ 1.9: 03 84 / > 0: ASKS / < 0.02: ANSWERS / > 1: ASKS / < 1.01: ASKS / < 1.02: ANSWERS / > 2: 01 05 00 C8 FF 00 0D C4 / < 2.01: 01 05 00 C8 FF 00 0D C4 / < 2.02: 01 05 00 C8 FF 00 0D C4",
            ],
        ),
        (
            Way::Flow,
            "modbus-rtu",
            &[
                "0: 01 / 0.001: 03 / 0.002: 00 / 0.003: C8 / 0.004: 00 / 0.005: 03 / 0.006: 84 / 0.007: 35 / 0.02: 01 / 0.021: 03 / \
                 0.022: 06 / 0.023: 00 / 0.024: 80 / 0.025: 42 / 0.026: A4 / 0.027: F1 / 0.028: DE / 0.029: B0 / 0.03: F8",
                "0: 01 03 / 0.5: 00 C8 / 1.4: 00 03 / 1.5: 84 35",
                "0: 01 03 / 0.5: 00 C8 / 1.6: 00 03 / 1.7: 84 35",
                "> 0: 01 03 00 C8 / < 0.1: 00 03 84 35",
                "> 0: 01 03 00 C8 00 03 84 35 / < 0.1: 01 03 06 00 / < 0.2: 80 42 A4 F1 / < 0.9: DE B0 F8",
                "0: FF / 0.1: 01 03 00 C8 00 03 84 35",
                "0: 06 04 02 07 00 01 / 0.1: 81 B7 / 0.2: 06 04 02 00 40 0D 00",
                "0: 06 04 22 07 00 01 8B C4 / 0.1: 06 04 02 00 40 0D 00",
                "0: 06 04 02 00 40 0D / 0.5: 00",
                "> 0: 01 03 00 C8 / > 1: 00 03 84 35",
                "> 0: 01 03 00 C8 / > 1.00001: 00 03 84 35",
                "> 0: 01 03 00 C8 / >: 00 03 84 35",
                ">: 01 03 00 C8 / > 5: 00 03 84 35",
                "0: 08 03 02 8D 00 01 15 00 / 0.5: 55 55 55",
                "0: 08 03 02 8D 00 01 15 / 0.5: 00 55 55 55",
                "0: 08 03 02 8D 00 01 / 0.5: 15 00 55 55 55",
                "0: 08 03 00 10 00 01 85 56 / 0.1: 08 03 02 8D 00 01 15 00 / 0.5: 55",
                "0: 08 03 02 8D 00 01 15 / 0.5: 00 08 03 02 00 00 64 45",
                "0: 08 03 02 8D 00 01 15 / 0.5: 00 55 55 08 03 02 00 00 64 45",
                "0: 08 03 02 8D 00 01 15 / 0.5: 00 55 55 55 08 03 02 00 00 64 45",
                "0: 08 03 02 8D 00 01 15 / 0.5: 00 09 03 02 00 00 58 45",
                "0: 08 03 02 8D 00 01 15 / 0.5: 00 08 03 02 00 00 64 46",
                "0: 55 06 04 22 07 00 01 8B C4 / 0.1: 06 04 02 00 40 0D 00",
                "0: 06 04 02 00 40 0D / 0.5: 00 / 0.5: 00",
                "1: 55 / 0.1: 01 03 00 C8 00 03 84 35 / 0.1: 08 03 02 8D 00 01 15 00 / 0: 08 03 00 10 00 01 85 56",
            ],
        ),
        (
            Way::Connection,
            "modbus-tcp",
            &[
                "known ? 0: 00 01 00 00 00 06 01 03 00 C8 00 03 / known ! 0.01: 00 01 00 00 00 09 01 03 06 00 80 42 A4 F1 DE",
                "? 0: 00 01 00 00 00 06 01 03 00 C8 00 03 / ! 0.01: 00 01 00 00 00 09 01 03 06 00 80 42 A4 F1 DE",
                "? 0: 00 01 00 00 00 06 01 63 00 C8 00 03 / ! 0.01: 00 01 00 00 00 09 01 63 06 00 80 42 A4 F1 DE",
                "known ? 0: 00 01 00 00 00 06 01 63 00 C8 00 03",
                "? 0: 00 01 00 00 00 06 01 07 00 C8 00 03 / ? 1: 00 02 00 00 00 02 01 07",
                "? 0: 00 01 00 00 00 02 01 07 00 02 00 00 00 02 01 07",
                "? 0: 00 01 00 00 00 06 01 / ? 0.1: 03 00 C8 00 03",
                "? 0: ASKS / ! 0.1: ANSWERS",
                "? 0: 47 45 54 20 2F / ! 0.1: 48 54 54 50",
                "? 0: 47x4000 / ? 1: 47x200 / ! 2: 48x10",
                "? 0: 47x4096 / ? 1: 00 01 00 00 00 06 01 03 00 C8 00 03",
                "? 0: 47x4097 / ? 1: 00 01 00 00 00 06 01 03 00 C8 00 03",
                "? 0: 00 01 00 00 00 06 01 03 00 C8 00 03 / ? 1: 00 02 00 00 00 06 / ? 2: 01 03 00 / ? 3: C8 00 03 00 03 00 00 00 06 / \
                 ? 4: 01 03 00 C8 00 03",
                "? 0: 00 01 00 00 00 06 01 03 00 C8 00 03 / ? 1: 00 02 00 00 00 0F 01 03 00 C8 00 03 / ? 2: 00 03 00 00 00 06 01 03 00 C8 00 03 / \
                 ? 3: 00 04 00 00 00 06 01 03 00 C8 00 03",
                "? 0: 00 01 00 00 00 06 01 03 00 C8 00 03 / ? 1: 00 02 00 00 00 0F 01 03 00 C8 00 03 00 03 00 00 / ? 2: 00 06 01 03 00 C8 00 03",
                "? 0: 01 03 00 C8 / ? 1: 00 03 84 35 / ! 2: ANSWERS",
                "? 0: 55 AA / ? 1: ASKS / ! 2: ANSWERS",
                "! 0: 00 01 00 00 00 09 01 03 06 00 80 42 A4 F1 DE / ? 1: 00 02 / ? 2: 00 00 00 06 01 03 00 C8 00 03",
                "? 0: 00 02 / ! 1: 00 01 00 00 00 09 01 03 06 00 80 42 A4 F1 DE / ? 2: 00 00 00 06 01 03 00 C8 00 03",
                "? 0: 00 02 / ! 1: 00 01 00 00 00 09 01 03 06 00 80 42 A4 F1 DE",
                "? 0: 00 01 00 00 00 06 01 01 00 C8 00 03",
                "? 0: 00 01 00 00 00 06 01 03 00 C8 00 99",
                "? 0: ASKS / ! 0.1: ANSWERS / ? 1: ASKS / ? 1.1: 01 03 02 00 05 B8 45",
                "? 0: 00 01 00 00 00 07 01 03 00 C8 00 03 / ? 1: 00 02 00 00 00 06 01 03 00 C8 00 03",
                "known ? 0: 00 01 00 00 00 06 01 03 00 C8 00 03 / known ? 1: 00 02 00 00 00 09 01 03 00 C8 00 03 / \
                 known ? 2: 00 03 00 00 00 06 01 03 00 C8 00 03",
                "known ? 0: 00 01 00 00 00 06 01 03 00 C8 00 03 / known ? 1: 00 02 00 00 00 0F 01 63 00 C8 00 03 / \
                 known ? 2: 00 03 00 00 00 06 01 03 00 C8 00 03",
                "known ? 0: 00 01 00 00 00 06 01 03 00 C8 00 03 / known ? 1: 00 02 00 00 00 0F 01 63 00 C8 00 03 / \
                 known ? 2: 00 03 00 00 00 06 01",
                "known ? 0: 00 C8 00 03 / known ? 1: 00 02 00 00 00 06 01 03 00 C8 00 03",
                "p0 known ? 0: 00 01 00 00 00 06 01 03 00 C8 00 03 / p1 ? 0: 47 45 54 / p1 ! 1: 48 54 54 50 / \
                 p0 ! 1: 00 01 00 00 00 09 01 03 06 00 80 42 A4 F1 DE",
            ],
        ),
    ] {
        for chunks in cases {
            told(&mut table, way, protocol, chunks);
        }
    }
    assert_table("traffic", &table);
}

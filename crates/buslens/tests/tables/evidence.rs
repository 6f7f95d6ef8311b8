//! What bytes without a proof are taken for, and how much speaks for it.

use std::fmt::Write as _;

use buslens::dialogue::evidence;
use buslens::field::Facts;
use buslens::frame::split::{Splitter, Waiting};
use buslens::modbus::STANDARD;
use buslens::tool::log::{Log, Reading, Role};
use buslens::tool::{Options, Protocol};

use super::{assert_table, bytes};

/// What bytes without a proof are most likely, with the bits that speak for it, and what each is worth as a proof.
#[test]
fn what_bytes_could_be() {
    let splitter = Splitter::new(&STANDARD);
    let mut table = String::new();
    let waits = [
        None,
        Some(Waiting { unit: 1, function: 3, length: Some(11) }),
        Some(Waiting { unit: 1, function: 3, length: None }),
        Some(Waiting { unit: 17, function: 66, length: None }),
    ];
    for text in [
        "",
        "01",
        "E5",
        "01 03",
        "01 83",
        "01 83 02",
        "01 83 07",
        "01 83 0C",
        "01 83 02 C0 F1",
        "01 83 02 C0 F2",
        "01 83 09 C0 F2",
        "01 03 00",
        "01 03 00 C8",
        "01 03 00 C8 00",
        "01 03 00 C8 00 03",
        "01 03 00 C8 00 03 84",
        "01 03 00 C8 00 03 85",
        "01 03 00 C8 00 03 84 35",
        "01 03 00 C8 00 03 84 36",
        "00 03 00 C8 00 03",
        "00 05 00 C8 FF 00",
        "00 64 00 C8 00 03",
        "00 06 00 C8 00 03",
        "20 03 00 C8 00 03 00 00",
        "21 03 00 C8 00 03 00 00",
        "F7 03 00 C8 00 03 00 00",
        "F8 03 00 C8 00 03 00 00",
        "01 03 00 C8 00 7D 00 00",
        "01 03 00 C8 00 7E 00 00",
        "01 03 FF FF 00 01 00 00",
        "01 03 FF FF 00 02 00 00",
        "01 03 00 C8 00 00 00 00",
        "01 01 00 C8 07 D0 00 00",
        "01 01 00 C8 07 D1 00 00",
        "01 02 00 C8 00 01",
        "01 04 00 C8 00 01",
        "01 05 00 C8 FF 00",
        "01 05 00 C8 00 00",
        "01 05 00 C8 FF 01",
        "01 05 00 C8 01 00",
        "01 06 00 C8 12 34",
        "01 07",
        "01 07 00",
        "01 08 00 00 12 34",
        "01 08 00 14 00 00",
        "01 08 00 15 00 00",
        "01 0F 00 13 00 0A 02 CD 01",
        "01 0F 00 13 00 0A 03 CD 01 00",
        "01 0F 00 13 00 0A",
        "01 0F 00 13 07 B0",
        "01 0F 00 13 07 B1",
        "01 0F 00 13 00 0A 02 CD",
        "01 10 00 C8 00 02 04 00 01 00 02",
        "01 10 00 C8 00 02 04 00 01 00 02 00 00",
        "01 10 00 C8 00 02 06 00 01 00 02 00 03",
        "01 10 00 C8 00 02 04 00 01",
        "01 10 00 C8 00 02 04 00 01 00 02 00",
        "01 10 00 C8 00 02 05 00 01",
        "01 10 00 C8 00 02",
        "01 10 00 C8 00 7B",
        "01 10 00 C8 00 7C",
        "01 65 20 00 00 01 04 00 00 00 01",
        "01 65 20 00 00 01 04 00 00 00",
        "01 65 20 00 00 01 05 00 00 00 01",
        "01 65 20 00 00 01 08 00 00 00 01 00 00 00 02",
        "01 65 20 00 00 02 08 00 00 00 01 00 00 00 02",
        "01 65 20 00 00 3E",
        "01 65 20 00 00 3F",
        "01 64 20 00 00 3E",
        "01 64 20 00 00 3F",
        "01 64 04 00 00 00 05",
        "01 64 04 00 00",
        "01 16 00 04 00 F2 00 25",
        "01 17 00 03 00 06 00 0E 00 03 06 00 FF 00 FF 00 FF",
        "01 2B 0E 01 00",
        "01 42 01 02 03",
        "11 42 01 02 03",
        "01 03 06 00 80 42 A4 F1 DE B0 F8",
        "01 03 06 00 80 42 A4 F1 DE",
        "01 03 06 00 80 42 A4 F1 DE B0 F8 00 00 00 00",
        "01 03 06 00 80 42 A4 F1 DE B0 F8 00 00 00 00 00",
        "01 03 06 00 80 42 A4 F1 DE B0",
        "01 03 06 00 80 42 A4 F1 DE B1",
        "01 03 06 00 80 42 A4 F1",
        "01 03 06 00 80",
        "01 03 06",
        "01 03 04 00 80 42 A4",
        "55 01 03 06 00 80 42",
        "55 01 03 06 00 80 42 A4 F1 DE",
        "55 01 03 06 00 80 42 A4 F1 DE B1",
        "55 AA 01 03 06 00",
        "55 AA 55 01 03 06 00",
        "01 03 05 00 80",
        "01 01 05 00 80",
        "01 02 05 00 80",
        "01 03 FA 00 80",
        "01 01 FA 00 80",
        "01 01 FB 00 80",
        "00 03 06 00 80",
        "00 10 00 C8 00 02 04 00 01",
        "01 06 00 C8 00 05 00 00",
        "03 06 00 C8 00 05 00 00",
        "01 03 FC 00 80",
        "01 17 06 00 80",
        "01 05 06 00 80",
        "03 00 C8 00 03",
        "03 06 00 80 42 A4 F1 DE",
        "10 00 C8 00 02",
        "83 02",
        "07",
        "01 03 00 C8 00 03 31",
        "01 03 00 C8 00 03 32",
        "00 01 00 00 00 06 01 03 00 C8 00 03",
        "00 01 00 00 00 07 01 03 00 C8 00 03",
        "00 01 00 00 00 0A 01 03 00 C8 00 03",
        "00 01 00 00 00 0B 01 03 00 C8 00 03",
        "00 01 00 00 00 02 01 03 00 C8 00 03",
        "00 01 00 00 00 01 01 03 00 C8 00 03",
        "00 00 00 00 00 07 01 03 00 C8 00 03",
        "00 01 00 00 01 06 01 03 00 C8 00 03",
        "00 01 00 00 02 06 01 03 00 C8 00 03",
        "00 01 00 00 00 06 01 03 00 C8",
        "00 01 00 00 00 06 01 42 00 C8",
        "00 01 00 00 00 06 01 03",
        "00 01 00 00 00 06 01",
        "00 01 00 01 00 06 01 03 00 C8 00 03",
        "68 05 05 68 81 82 5D 3B 3E D9 16",
        "68 05 05 68 81 82 5D 3B 3E DA 16",
        "68 05 06 68 81 82 5D 3B 3E D9 16",
        "68 05 05 68 81 82 5D 3B 3E",
        "68 05 05 68 81 82 5D 3B 3E D9",
        "68 05 05 68 81 82 5D 3B 3E D9 17",
        "68 05 05 68 81 82 5D 3B 16",
        "68 05 06 68 81 82 5D 3B 16",
        "68 05 05 69 81 82 5D 3B 3E",
        "68 05 05 68 81 82 5D 3B 3E D9 16 00",
        "68 05 05 68 81 82 9D 3B 3E",
        "68 05 06 68 81 82 5D 3B 3E",
        "10 01 02 49 4C 16",
        "10 01 02 49 4D 16",
        "10 01 02 49 4D 17",
        "10 01 02 49",
        "DC 01 02",
    ] {
        let bytes = bytes(text);
        for (index, waiting) in waits.into_iter().enumerate() {
            let reading = evidence::reading(&bytes, &splitter, waiting);
            if index > 0 && reading.is_none_or(|it| !it.awaited) {
                continue;
            }
            let shown = reading.map_or("nothing".to_owned(), |it| {
                let cut = if it.cut { ", cut" } else { "" };
                let awaited = if it.awaited { ", awaited" } else { "" };
                format!("{} {:?} from {}: {}{cut}{awaited}", it.protocol.key, it.verdict, it.from, it.bits)
            });
            let before = match waiting {
                Some(it) => format!(" behind {} {} {:?}", it.unit, it.function, it.length),
                None => String::new(),
            };
            writeln!(table, "{text}{before} | {shown}").unwrap();
        }
        let proofs: Vec<String> = ["modbus-rtu", "modbus-tcp", "profibus-fdl", "modbus-ascii"]
            .map(|key| evidence::proof(Protocol::of(key).unwrap(), &bytes, &splitter).to_string())
            .into();
        let ascii = evidence::ascii(&bytes, &splitter).map(|it| it.bits);
        writeln!(table, "{text} | proofs {}, ascii {ascii:?}", proofs.join(" ")).unwrap();
    }
    let facts = |change: fn(&mut Facts)| {
        let mut facts = Facts::default();
        change(&mut facts);
        evidence::place(&facts)
    };
    let places = [
        ("bare", facts(|it| it.bare = true)),
        ("said", facts(|it| it.said = true)),
        ("labelled", facts(|it| it.labelled = true)),
        ("said and labelled", facts(|it| (it.said, it.labelled) = (true, true))),
        ("wrapped", facts(|it| it.wrapped = true)),
        ("marked", facts(|it| it.marked = true)),
        ("dumped", facts(|it| it.dumped = true)),
        ("of telegrams", facts(|it| it.of_telegrams = true)),
        ("counted", facts(|it| it.counted = true)),
        ("left over", facts(|it| it.of_leftovers = true)),
        ("listed", facts(|it| it.listed = true)),
        ("words", facts(|it| it.words = true)),
        ("an array", facts(|it| (it.array, it.marked, it.wrapped) = (true, true, true))),
        ("an array, said", facts(|it| (it.array, it.said) = (true, true))),
        ("an array of telegrams", facts(|it| (it.array, it.of_telegrams) = (true, true))),
        ("an array of words", facts(|it| (it.array, it.words) = (true, true))),
    ];
    for (fact, bits) in places {
        writeln!(table, "{fact}: {bits}").unwrap();
    }
    for pieces in 0..6 {
        let company: Vec<String> = (0..=pieces)
            .flat_map(|proven| (0..=pieces - proven).map(move |alike| (proven, alike)))
            .map(|(proven, alike)| format!("{proven}+{alike}: {}", evidence::company(pieces, proven, alike)))
            .collect();
        writeln!(table, "of {pieces}, {}", company.join(", ")).unwrap();
    }
    assert_table("evidence", &table);
}

/// How much speaks for a telegram without a proof, seen from outside: among how many others that look a little
/// like telegrams it is still found. Each doubling of them asks for one bit more.
#[test]
fn how_much_speaks_for_it() {
    /// Read as a write to a unit that cannot be, of a value that cannot be.
    const OTHER: &str = "note FA 05 00 01 12 34 end\n";
    const MOST: u32 = 9;
    let mut table = String::new();
    let mut measure = |text: &str, wanted: &str| {
        let wanted = bytes(wanted);
        let is_found = |doubled: u32| {
            let text = OTHER.repeat((1 << doubled) - 1) + "\n" + text;
            let log = Log::read(text.as_bytes(), &Reading::default(), Options::default()).unwrap();
            log.entries()
                .iter()
                .any(|entry| entry.role != Role::Discarded && log.bytes(&text.as_bytes(), &entry) == wanted)
        };
        let all: Vec<u32> = (1..=MOST).collect();
        let bits = match all.partition_point(|doubled| is_found(*doubled)) as u32 {
            0 => "less than 13 bits".to_owned(),
            MOST => format!("{} bits or more", 12 + MOST),
            most => format!("{} bits", 12 + most),
        };
        writeln!(table, "{}: {bits}", text.escape_debug()).unwrap();
    };
    for place in [
        "so {} was",
        "{}",
        "TX: {}",
        "it: {}",
        "it [{}] was",
        "frame {} was",
        "discarded {} here",
        "0000  {}",
        "so {} was, {n} bytes",
    ] {
        for telegram in [
            "01 03 00 C8 00 03",
            "63 03 00 C8 00 03",
            "63 06 00 C8 00 03",
            "01 03 00 C8 00 03 84 36",
            "63 03 00 C8 00 03 84 36",
            "63 03 06 00 80 42 A4 F1 DE B0 F9",
            "01 03 06 00 80 42",
            "63 10 00 C8 00 02 04 00 01",
            "00 01 00 00 00 07 63 03 00 C8 00 03",
            "00 00 00 00 00 07 63 03 00 C8 00 03",
            "03 00 C8 00 03",
            "63 03 00 C8 00 03 CF",
            "63 83 02 C0 F2",
            "68 05 05 68 81 82 5D 3B 3E DA 16",
            "68 05 05 68 81 82 5D 3B 3E",
            "10 01 02 49 4D 16",
            "41 00 23 00 00 00 00 00",
        ] {
            let count = telegram.split(' ').count();
            measure(&place.replace("{}", telegram).replace("{n}", &count.to_string()), telegram);
        }
    }
    for (text, telegram) in [
        ("0x63, 0x03, 0x00, 0xC8, 0x00, 0x03", "63 03 00 C8 00 03"),
        (":630300C800031F", "63 03 00 C8 00 03 1F"),
        ("E5", "E5"),
        ("so 63 01 00 C8 00 03\nso 63 02 00 C8 00 03", "63 01 00 C8 00 03"),
        ("so 63 01 00 C8 00 03\nso 63 02 00 C8 00 03\nso 63 04 00 C8 00 03", "63 01 00 C8 00 03"),
        ("so 01 03 00 C8 00 03 84 35\nso 63 06 00 C8 00 03", "63 06 00 C8 00 03"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 03 00 C8 00 04", "63 03 00 C8 00 04"),
        ("so 63 03 00 C8 00 03\nas 63 03 06 00 80 42 A4 F1 DE", "63 03 06 00 80 42 A4 F1 DE"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 03 06 00 80 42 A4 F1 DE", "63 03 06 00 80 42 A4 F1 DE"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 03 06 00 80 42", "63 03 06 00 80 42"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 03 05 00 80 42 00 00", "63 03 05 00 80 42 00 00"),
        ("so 63 03 00 C8 00 03 8C 47\nas 63 83 02", "63 83 02"),
        ("so 68 05 05 68 81 82 5D 3B 3E D9 16\nas 63 06 00 C8 00 03 00 00", "63 06 00 C8 00 03 00 00"),
        ("so 68 05 05 68 81 82 5D 3B 3E D9 16\nTX: E5", "E5"),
        ("so 01 03 00 C8 00 03 84 35\nTX: E5", "E5"),
        ("so 00 01 00 00 00 06 01 03 00 C8 00 03\nas 63 06 00 C8 00 03", "63 06 00 C8 00 03"),
        ("so 63 06 00 C8 00 03 41 8A\nas 63 06 00 C8 00 03 41 8B", "63 06 00 C8 00 03 41 8B"),
        ("so 63 06 00 C8 00 03 41 8A\nTX: 63 06 00 C8 00 03 41 8B", "63 06 00 C8 00 03 41 8B"),
    ] {
        measure(text, telegram);
    }
    assert_table("weights", &table);
}

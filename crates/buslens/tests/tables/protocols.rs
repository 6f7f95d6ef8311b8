//! Which protocols telegrams are of, who speaks in them, and what is text or of others.

use std::fmt::Write as _;

use buslens::dialogue;
use buslens::dialogue::foreign::FOREIGN;
use buslens::modbus::STANDARD;
use buslens::text;
use buslens::tool::{PROTOCOLS, Protocol};

use super::{assert_table, bytes};

/// Which protocols telegrams are of, together, and who speaks in them.
#[test]
fn protocols_and_speakers() {
    let mut table = String::new();
    for lines in [
        "01 03 00 C8 00 03 84 35",
        "01 03 00 C8 00 03 84 36",
        "03 00 C8 00 03",
        "02 03 00 C8 00 05 2E",
        "00 01 00 00 00 06 01 03 00 C8 00 03",
        "00 01 00 00 00 07 01 03 00 C8 00 03",
        "00 01 00 00 00 06 01 03 00 C8 00 03 / 00 02 00 00 00 06 FF 03 00",
        "00 01 00 00 00 06 01 03 00 C8 00 03 / 01 03 00 C8 00 03 84 35",
        "01 03 00 C8 00 03 84 36 / 03 00 C8 00 03",
        "41 00 23 00 00 00 00 00 / 71 00 23 00 00 00 00 05",
        "B7 A3 93 / 00 0C 00 02 05 EB",
        "68 05 05 68 81 82 5D 3B 3E D9 16 / E5",
        "E5",
        "FF",
        "FF / 03 00 C8 00 03",
    ] {
        let telegrams: Vec<Vec<u8>> = lines.split(" / ").map(bytes).collect();
        for bus in [None, Some(PROTOCOLS[0].bus()), Some(Protocol::of("profibus-fdl").unwrap().bus())] {
            let settings = buslens::frame::Settings { bus, ..Default::default() };
            let candidates: Vec<_> =
                telegrams.iter().map(|bytes| dialogue::Candidate { bytes, written_as: None }).collect();
            let choices: Vec<String> = dialogue::protocols(&candidates, &settings)
                .iter()
                .map(|choice| {
                    let others: Vec<String> = choice
                        .others
                        .iter()
                        .map(|(protocol, fit)| format!("{} {}", protocol.key, fit.bits))
                        .collect();
                    format!("{} ({}) [{}]", choice.protocol.key, choice.reason, others.join(", "))
                })
                .collect();
            writeln!(table, "{lines} | {bus:?} | {}", choices.join(" / ")).unwrap();
        }
    }
    for text in [
        "03 00 C8 00 03",
        "03 06 00 80 42 A4 F1 DE",
        "03 06 00 80 42 A4 F1",
        "03 06 00 80 42 A4",
        "03 05 00 80 42 A4",
        "03 05 00 80 42 A4 F1",
        "03 00",
        "03 00 C8",
        "03 00 C8 00 03 84",
        "10 00 C8 00 02 04 00 01 00",
        "10 00 C8 00 02 00",
        "10 00 C8 00",
        "01 00",
        "01 01 00 00",
        "06 00 C8",
        "83",
        "83 02",
        "42 01",
        "",
        "65 20 00 00 01 04 00 00 00",
        "64 08 00 00 00 00",
        "64 04 00 00 00",
        "18 00",
    ] {
        for awaited in [false, true] {
            let guess = dialogue::direction(&bytes(text), 3, awaited, &STANDARD);
            writeln!(
                table,
                "{text} | {awaited} | {:?} {:?}: {}",
                guess.direction, guess.certainty, guess.reason
            )
            .unwrap();
        }
    }
    for leanings in [
        &[][..],
        &[0],
        &[3],
        &[-3],
        &[10],
        &[9],
        &[11],
        &[-10],
        &[-3, 3],
        &[3, -3],
        &[-3, 0, 0],
        &[-3, -3],
        &[-3, -1, 2],
        &[-3, 1, 0, 10],
        &[1, 1, 1, -3],
        &[-2, 1, 1, 0],
    ] {
        let guesses: Vec<String> = dialogue::turns(leanings)
            .iter()
            .map(|it| format!("{:?} {:?} ({})", it.direction, it.certainty, it.reason))
            .collect();
        writeln!(table, "{leanings:?}: {}", guesses.join(", ")).unwrap();
    }
    assert_table("speakers", &table);
}

/// Bytes that may be text, and telegrams of others.
#[test]
fn encodings_and_others() {
    let mut table = String::new();
    for bytes in [
        &b"01 03"[..],
        b"",
        b"\xFF\xFE0\x001\x00",
        b"\xFE\xFF\x000\x001",
        b"0\x001\x00 \x00",
        b"\x000\x001\x00 ",
        b"0\x001\x00 ",
        b"\x000\x001\x00",
        b"0\x001",
        b"0\x00",
        b"\x010\x001\x002",
        b"0\x001\x01",
        b"\xE9\x000\x001\x00",
        b"a\x00\t\x00\r\x00\n\x00~\x00",
        b"\xFF\xFE\x3D\xD8\x00\xDE",
        b"\xFF\xFE\x3D\xD8A\x00",
        b"\xFF\xFEA\x00\x3D\xD8\x00\xDE",
        b"\xFE\xFF\x00A\xD8\x3D\xDE\x00",
        b"\xFF\xFEA\x00\x3D\xDC\x00\xDE",
        b"\xFE\xFF\xD8\x3D\xDE\x00\x00A\x00",
        b"\x01\x03\x00\xC8",
        b"text with \x1B[0m colours \x07 and \x0C",
        b"a text of more than fifty characters has one odd control\x00",
        b"a text of hardly fifty characters has one as we\x01",
        b"a text of hardly forty characters \x0E",
        b"a text of hardly forty characters \x1A",
        b"a text of hardly forty characters \x1F",
        b"a text of hardly forty characters \x7F",
        b"a text of hardly forty characters \x06",
    ] {
        let encoding = text::encoding(bytes);
        let whole: Vec<usize> =
            (0..=bytes.len().min(8)).map(|length| encoding.whole(&bytes[..length])).collect();
        let read = String::from_utf8_lossy(&encoding.text(bytes)).escape_debug().to_string();
        let further = String::from_utf8_lossy(&encoding.further(bytes)).escape_debug().to_string();
        writeln!(table, "{} | {encoding:?} | {read} | {further} | {whole:?}", bytes.escape_ascii()).unwrap();
    }
    for text in [
        "10 5B 0A 65 16",
        "10 5B 0A 66 16",
        "10 5B 0A 65 17",
        "68 0B 0B 68 08 03 72 21 43 65 87 24 40 01 07 39 16",
        "68 03 03 68 53 01 51 A5 16",
        "68 03 03 68 53 01 50 A4 16",
        "68 03 03 68 53 01 52 A6 16",
        "68 03 03 68 53 01 53 A7 16",
        "68 03 03 68 73 01 5A CE 16",
        "68 03 03 68 7B 01 70 EC 16",
        "68 03 03 68 5B 01 72 CE 16",
        "68 03 03 68 18 01 78 91 16",
        "68 03 03 68 28 01 7A A3 16",
        "68 03 03 68 38 01 B8 F1 16",
        "68 03 03 68 38 01 BF F8 16",
        "68 03 03 68 38 01 C0 F9 16",
        "68 03 03 68 39 01 B8 F2 16",
        "68 03 04 68 53 01 51 A5 16",
        "68 04 04 68 53 01 51 A5 16",
        "68 02 02 68 53 01 54 16",
        "FE FE 68 21 43 65 87 09 00 68 11 04 33 33 34 33 0B 16",
        "68 21 43 65 87 09 00 68 11 04 33 33 34 33 0B 16",
        "68 21 43 65 87 09 00 68 11 03 33 33 34 0B 16",
        "68 21 43 65 87 09 00 68 11 04 33 33 34 33 0C 16",
        "7E A0 07 03 21 93 0F 01 7E",
        "7E A0 08 03 21 93 0F 01 7E",
        "7E A8 07 03 21 93 0F 01 7E",
        "7E A0 07 03 21 93 0F 00 7E",
        "55 FF 00 07 03 00 00 EB",
        "55 FF 07 07 03 00 00 EB",
        "55 FF 08 07 03 00 00 EB",
        "55 FF 7F 07 03 00 00 EB",
        "55 FF 80 07 03 00 00 EB",
        "55 FF 00 07 03 00 00",
        "04 30 31 05",
        "04 30 31 47 05",
        "02 47 30 30 03 37",
        "02 47 30 03 37",
        "02 47 7F 30 03 37",
        "02 47 1F 30 03 37",
        "AA 55 01 00 00 0B 11 04 00 01 20",
        "AA 55 01 00 00 0B 11 04 00 01 21",
        "AA 55 00 FF",
        "AA 54 00 FE",
        "7E 32 30 30 31 34 0D",
        "7E 32 30 30 31 0D",
        "7E 32 30 30 31 47 0D",
        "55 AA 01 03 00 C8 00 03 84 35",
        "5A A5 01 03 00 C8 00 03 84 35",
        "EB 90 01 03 00 C8 00 03 84 35",
        "AA 55 01 03 00 C8 00 03 84 35",
        "AA 56 01 03 00 C8 00 03 84 35",
        "55 AB 01 03 00 C8 00 03 84 35",
        "EB 90 01 03 00 C8 00 03 1B D7",
        "EB 90 01 03 00 C8 00 04 84 35",
        "55 AA 01 7E 80",
        "55 AA 01 02 81 E1",
        "55 AA 01 DE B0",
        "AA 55 7E 03 00 C8 00 03 8F FA",
        "AA 55 7F 03 00 C8 00 03 8E 2B",
        "AA 55 F7 03 00 C8 00 03 90 A3",
        "68 05 05 68 40 05 64 01 06 B0 16",
        "68 05 05 68 43 05 64 01 06 B3 16",
        "68 05 05 68 44 05 64 01 06 B4 16",
        "68 05 05 68 4A 05 64 01 06 BA 16",
        "68 05 05 68 4B 05 64 01 06 BB 16",
        "68 05 05 68 08 05 64 01 06 78 16",
        "68 05 05 68 41 05 64 01 06 B1 16",
        "68 05 05 68 48 05 64 01 06 B8 16",
        "68 05 05 68 00 05 64 01 06 70 16",
        "68 05 05 68 73 05 64 01 06 E3 16",
        "68 05 05 68 53 05 64 01 06 C3 16",
        "68 05 05 68 7B 05 64 01 06 EB 16",
        "68 03 03 68 53 05 00 58 16",
        "68 03 03 68 53 05 06 5E 16",
        "68 03 03 68 53 05 08 60 16",
        "68 03 03 68 53 05 4D A5 16",
        "68 03 03 68 53 05 5D B5 16",
        "68 03 03 68 53 05 7B D3 16",
        "68 05 06 68 53 05 64 01 06 C3 16",
        "68 06 06 68 53 05 64 01 06 C3 16",
        "68 05 05 68 53 05 64 01 06 00 16",
        "01",
    ] {
        let bytes = bytes(text);
        let names: Vec<&str> =
            FOREIGN.iter().filter(|foreign| (foreign.fits)(&bytes)).map(|foreign| foreign.name).collect();
        writeln!(table, "{text} | {}", names.join(", ")).unwrap();
    }
    for text in [
        "\"No.\",\"Time\",\"Source\"",
        "\n\n\n\n\"No.\",\"Time\",\"Source\"",
        "\n\n\n\n\n\"No.\",\"Time\",\"Source\"",
        "  No.     Time",
        "x No.     Time",
        "#separator \\x09",
        "separator \\x0",
    ] {
        let named = text::export(text.as_bytes()).map(|export| export.name);
        writeln!(table, "{} | {named:?}", text.escape_debug()).unwrap();
    }
    for line in [
        "[RTU]>Tx > 09:30:05:081 - 01 03",
        "000017-Tx:01 03",
        "  000017-Rx:01 03",
        "x 000017-Tx:01 03",
        "[01][03][00]",
        "<01><03><00>",
        "[0g][03][00]",
        ":010300C8",
        ":010300C",
        "rx [02, 64, 00]",
        "00000000: 0103 00c8",
        "0x0000:  4500 0034",
        "0000000 001 003",
        "0000000 001403 144000",
        "0000   01 03",
        "0000  01 03",
        "modbus",
    ] {
        let shown = text::Layout::shown(line.as_bytes());
        let known: Vec<&str> =
            (0..).zip(text::LAYOUTS).filter(|(at, _)| shown >> at & 1 == 1).map(|(_, it)| it.key).collect();
        writeln!(table, "{line} | {}", known.join(", ")).unwrap();
    }
    assert_table("encodings", &table);
}

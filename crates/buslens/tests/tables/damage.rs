//! What may have happened to damaged telegrams.

use std::fmt::Write as _;

use buslens::dialogue::{Context, hypotheses};
use buslens::field::{Span, hex};
use buslens::tool::Protocol;

use super::{assert_table, bytes};

/// What may have happened to damaged telegrams, in the order in which the search finds it.
#[test]
fn causes_of_damage() {
    let request = bytes("01 03 00 C8 00 03 84 35");
    let other = bytes("05 06 00 01 00 02 58 4F");
    let mut table = String::new();
    for (protocol, text) in [
        ("modbus-rtu", "01 03 00 C8 00 03 35 84"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 36"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 34"),
        ("modbus-rtu", "01 03 00 C8 00 03 85 35"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 05"),
        ("modbus-rtu", "01 03 00 C8 00 03 87 35"),
        ("modbus-rtu", "01 03 00 C8 00 03 B4 35"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 2D"),
        ("modbus-rtu", "01 03 00 C8 00 84 03 35"),
        ("modbus-rtu", "01 03 00 C8 00 08 34 35"),
        ("modbus-rtu", "01 10 00 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 00 03 12 34"),
        ("modbus-rtu", "01 03 00 C8 01 7E 80"),
        ("modbus-rtu", "01 03 00 C8 01 07 41 E2"),
        ("modbus-rtu", "01 03 00 C8 00 03"),
        ("modbus-rtu", "01 03 00 C8 00 02 84 35"),
        ("modbus-rtu", "01 03 00 8C 00 03 84 35"),
        ("modbus-rtu", "01 03 0C 80 00 03 84 35"),
        ("modbus-rtu", "01 03 C8 00 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 00 7E 84 35"),
        ("modbus-rtu", "01 03 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 55 AA 00 03 84 35"),
        ("modbus-rtu", "01 03 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 11 22 33"),
        ("modbus-rtu", "33 22 01 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "03 00 C8 00 03 86 A5"),
        ("modbus-rtu", "06 00 C8 05 C7 97"),
        ("modbus-rtu", "55 44 33 22 11 01 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 55 44 33 22 11 66 77 88"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 FF"),
        ("modbus-rtu", "00 01 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "03 01 C8 00 03 00 35 84"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 01 03 06 00 80 42 A4 F1 DE B0 F8"),
        ("modbus-rtu", "01 03 06 00 80 42 A4 F1 DE 58 4F"),
        ("modbus-rtu", "01 03 06 80 00 A4 42 DE F1 B0 F8"),
        ("modbus-rtu", "01 03 06 00 80 42 A4"),
        ("modbus-rtu", "01 83 02 F1 C0"),
        ("modbus-rtu", "01 03 00 C8 00 03 2E 84"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 2E"),
        ("modbus-rtu", "01 03 00 C8 00 03 14 47"),
        ("modbus-rtu", "01 03 00 C8 00 03 47 14"),
        ("modbus-rtu", "01 03 00 C8 00 03 FF A1"),
        ("modbus-rtu", "01 03 00 C8 00 03 A1 FF"),
        ("modbus-rtu", "01 03 0C 08 00 03 84 35"),
        ("modbus-rtu", "00 13 00 C8 00 03 84 35"),
        ("modbus-rtu", "10 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "03 01 00 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 00 C8 03 00 84 35"),
        ("modbus-rtu", "01 03 00 0C 00 03 84 35"),
        ("modbus-rtu", "01 03 00 80 00 38 43"),
        ("modbus-rtu", "01 03 00 C8 00 03 84 35 01 03 00 C8 00 03 84 35"),
        ("modbus-rtu", "01 03 06 00 80 42 A4 F1 DE B0"),
        ("modbus-rtu", "01 03 06 00 80 A4 F1 DE B0 F8"),
        ("modbus-rtu", "01 03 06 42 A4 F1 DE B0 F8"),
        ("modbus-rtu", "01 03 06 00 80 42 A4 F1 DE"),
        ("modbus-rtu", "01 03 06 00 80 42 A4 F1 DE BE EF 00"),
        ("modbus-rtu", "00 01 00 00 00 06 01 03 00 C8 00 03"),
        ("modbus-rtu", "01 03 00 C8 00 03 31"),
        ("modbus-rtu", "01 03 00 C8 00 03 31"),
        ("modbus-rtu", "01 03"),
        ("modbus-ascii", "01 03 00 C8 00 03 32"),
        ("modbus-ascii", "01 03 00 C8 00 03 30"),
        ("modbus-ascii", "01 03"),
        ("modbus-ascii", "01 03 FD"),
        ("modbus-ascii", "01 03 00 C8 00 03 01"),
        ("modbus-ascii", "01 03 00 C8 03 00 31"),
        ("modbus-ascii", "01 03 00 C8 00 31"),
        ("modbus-ascii", "01 03 00 C8 00 03 84 35"),
        ("profibus-fdl", "68 05 05 68 81 82 5D 3B 3E DA 16"),
        ("profibus-fdl", "68 05 06 68 81 82 5D 3B 3E D9 16"),
        ("profibus-fdl", "68 05 05 68 81 82 5D 3E 3B D9 16"),
        ("profibus-fdl", "10 01 02 49 4D 16"),
        ("profibus-fdl", "10 02 01 4A 4C 16"),
        ("modbus-tcp", "00 01 00 00 00 07 01 03 00 C8 00 03"),
    ] {
        let found = bytes(text);
        for digit_lost in [false, true] {
            let others: [&[u8]; 2] = [&other, &request];
            let context = Context { request: Some(&request), others: &others, digit_lost };
            for one in hypotheses(&found, Protocol::of(protocol).unwrap(), context) {
                // Most that a lost digit allows is found by chance.
                if digit_lost && !one.cause.key().contains("digit") {
                    continue;
                }
                let (gone, new) = one.difference(&found);
                let spans = |spans: &[Span]| {
                    let spans: Vec<String> =
                        spans.iter().map(|span| format!("{}..{}", span.from, span.to)).collect();
                    spans.join(" ")
                };
                writeln!(
                    table,
                    "{text} | {} | {} | {} bits, {}, {} for {}",
                    hex(&one.bytes),
                    one.text(&found),
                    one.bits(),
                    one.odds(),
                    spans(&gone),
                    spans(&new)
                )
                .unwrap();
            }
        }
    }
    assert_table("causes", &table);
}

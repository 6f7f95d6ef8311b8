//! Logs so long that they are settled in parts: what stands on both sides of where one ends is told as elsewhere.

use std::fmt::Write as _;

use buslens::field::hex;
use buslens::tool::Options;
use buslens::tool::log::{Log, Reading};

use super::assert_table;
use super::traffic::{counts, dialog};

/// So many telegrams are settled at a time.
const PART: usize = 1 << 14;

/// What is counted of a log, and the telegrams around the end of its first part and at its own end.
fn told(table: &mut String, name: &str, text: &str) {
    let mut log =
        Log::open(text.as_bytes(), text.len() as u64, &Reading::default(), Options::default()).unwrap();
    for part in text.as_bytes().chunks(1 << 16) {
        log.push(part);
    }
    log.finish();
    let all = log.statistics();
    let count = log.entries().len();
    let lines = log.unread().len();
    writeln!(table, "{name}: {count} entries, {}, {lines} lines unread", counts(all)).unwrap();
    for it in &all.dialogs {
        writeln!(table, "    {}", dialog(it)).unwrap();
    }
    for index in (PART - 4..PART + 3).chain(count.max(PART + 3) - 3..count).filter(|index| *index < count) {
        let entry = log.entry(index);
        writeln!(
            table,
            "    {index} in line {}: {} | {} {:?} {:?} {:?}, with {:?}",
            entry.line,
            hex(&log.bytes(&text.as_bytes(), &entry)),
            entry.protocol().key,
            entry.verdict,
            entry.direction,
            entry.role,
            entry.partner()
        )
        .unwrap();
    }
    let each = log.memory() as f64 / (count + log.unread().len()) as f64;
    assert!((1.0..30.0).contains(&each), "{name}: {each} bytes of memory for each line");
    let unread: Vec<u32> = log.unread().iter().map(|(line, _)| line).collect();
    if let [first, second, .., last] = unread[..] {
        writeln!(table, "    unread {first}, {second}, … {last}").unwrap();
    }
}

#[test]
fn logs_that_are_settled_in_parts() {
    const ASKS: &str = "01 03 00 C8 00 03 84 35";
    const ANSWERS: &str = "01 03 06 00 80 42 A4 F1 DE B0 F8";
    let mut table = String::new();
    let log = |count: usize, lines: &str| format!("{lines}\n").repeat(count);
    let exchange = format!("TX: {ASKS}\nRX: {ANSWERS}");
    let unit_2 = "TX: 02 03 00 C8 00 03 84 06";
    told(
        &mut table,
        "each answer twice, without its check",
        &log(5_600, &format!("TX: {ASKS}\nRX: 01 83 02\nRX: 01 83 02")),
    );
    told(
        &mut table,
        "two lines by turns",
        &(format!("COM3 TX: {ASKS}\n")
            + &log(
                4_300,
                &format!("COM1 TX: {ASKS}\nCOM2 TX: {ASKS}\nCOM1 RX: {ANSWERS}\nCOM2 RX: {ANSWERS}"),
            )),
    );
    for before in [1, 2] {
        let name = format!("{before} requests without an answer, then exchanges");
        told(&mut table, &name, &(log(before, unit_2) + &log(8_400, &exchange)));
    }
    // An adapter that hears itself does so to the end, though a few requests at the end came back only once.
    let echoes = log(5_500, &format!("TX: {ASKS}\nRX: {ASKS}\nRX: {ANSWERS}"));
    told(
        &mut table,
        "echoes, and few at the end",
        &(echoes
            + &log(3, &exchange)
            + &format!("TX: {ASKS}\nRX: {ASKS}\nRX: {ANSWERS}\n")
            + &log(3, &exchange)),
    );
    told(
        &mut table,
        "few telegrams among many numbers",
        &log(35, &(exchange.clone() + "\n" + &log(1_000, "x 1234 y"))),
    );
    told(
        &mut table,
        "few telegrams among much prose",
        &log(35, &(exchange.clone() + "\n" + &log(1_000, "nothing new"))),
    );
    told(
        &mut table,
        "a telegram in two lines each",
        &log(8_300, "RX: 01 03 06 00 80\nRX: 42 A4 F1 DE B0 F8\nTX: 01 03 00 C8 00 03 84 35"),
    );
    assert_table("long_logs", &table);
}

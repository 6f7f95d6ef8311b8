//! Logs so long that they are settled in parts: what stands on both sides of where one ends is told as elsewhere.

use std::fmt::Write as _;

use buslens::field::hex;
use buslens::tool::Options;
use buslens::tool::log::{Division, Log, Reading};

use super::assert_table;
use super::found::checked;
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

/// A log with marks, behind which hardly more is known than what its beginning told: all telegrams but those of the
/// usual exchange.
fn divided(table: &mut String, name: &str, text: &str, usual: &[&str]) {
    const DIVISION: Division = Division { beginning: 20_000, step: 2_000 };
    // As one of a large file: bytes are read again from there.
    let log = Log::open(text.as_bytes(), 1 << 40, &Reading::default(), Options::default()).unwrap();
    let mut log = log.divided(DIVISION);
    log.push(text.as_bytes());
    log.finish();
    writeln!(table, "{name}, {:?}: {}", log.divisible_from(), counts(log.statistics())).unwrap();
    for (index, entry) in log.entries().iter().enumerate() {
        let own = hex(&log.bytes(&text.as_bytes(), &entry));
        if usual.contains(&own.as_str()) && entry.partner().is_some_and(|it| it.abs_diff(index) == 1) {
            continue;
        }
        writeln!(
            table,
            "    {index} in line {}: {own} | {} {:?} {:?} {:?}, with {:?}, time {:?}, port {}",
            entry.line,
            entry.protocol().key,
            entry.verdict,
            entry.direction,
            entry.role,
            entry.partner(),
            entry.time(),
            entry.port
        )
        .unwrap();
    }
    let unread: Vec<String> = log.unread().iter().map(|(line, _)| line.to_string()).collect();
    writeln!(table, "    unread {}", unread.join(", ")).unwrap();
}

#[test]
fn logs_with_marks() {
    const ASKS: &str = "01 03 00 C8 00 03 84 35";
    const ANSWERS: &str = "01 03 06 00 80 42 A4 F1 DE B0 F8";
    let usual = [ASKS, ANSWERS];
    let exchanges = |count: usize| format!("COM1 TX: {ASKS}\nCOM1 RX: {ANSWERS}\n").repeat(count);
    let mut table = String::new();
    // So many are the beginning, and so many lie between marks.
    let (beginning, between) = (exchanges(330), exchanges(60));
    let behind = |seen: &str, lines: &[&str]| {
        let lines: String = lines.iter().map(|line| checked(line) + "\n" + &between).collect();
        format!("{}{beginning}{between}{lines}", checked(seen))
    };
    // Copies are known of the beginning: damaged, cut, two in a line, and by unit and function.
    let seen = "TX: 63 06 00 C8 00 03 ~~\nRX: 63 06 00 C8 00 03 ~~\nTX: 11 42 01 02 03 04 05 06 ~~\n\
                TX: 11 42 01 02 03 05 05 06 ~~\nTX: 05 06 00 C8 00 03 ~~\nso 77 88 99 AA it\n";
    for (name, seen) in [("nothing doubtful in the beginning", ""), ("copies of the beginning", seen)] {
        let lines = [
            "RX: 63 06 00 C8 00 03 41 8B",
            "so 63 06 00 C9 00 03 it",
            "so 63 06 00 C9 00 03 12 34 it",
            "so 05 06 00 C9 00 03 it",
            "so 05 06 00 C9 00 03 12 34 it",
            "TX: 63 06 00 C9 00 03 12 34",
            "RX: 11 42 01 02 03 04 05 06",
            "RX: 11 42 01 02 03 04 05 06 11 42 01 02 03 05 05 06 00",
            "RX: 01 03 06 00 80 42 A4 F1",
            "RX: 01 03 06 00 80 42 A4 F1 DE 01 03 06 00 80 42 A4 F1 DE B0 x",
            "RX: 01 03 00 C8 00 03 84 36",
            "so 41 00 23 00 00 00 00 00 it",
            "77 88 99 AA BB CC",
        ];
        divided(&mut table, name, &behind(seen, &lines), &usual);
    }
    // Short frames of M-Bus count up to the next mark only.
    divided(
        &mut table,
        "short frames",
        &behind("", &["so 10 5B 0A 65 16 it\nso 10 01 02 49 4C 16 it", "so 10 01 02 49 4C 16 it"]),
        &usual,
    );
    divided(
        &mut table,
        "short frames in the beginning",
        &behind("so 10 5B 0A 65 16 it\n", &["so 10 01 02 49 4C 16 it"]),
        &usual,
    );
    // A line that falls silent has forgotten what it asked, or began.
    divided(
        &mut table,
        "silence",
        &behind(
            "",
            &[
                "COM2 TX: 02 03 00 C8 00 03 ~~",
                "COM2 RX: 02 83 02 ~~",
                "COM2 TX: 02 03 00 C8 00 03 ~~\nCOM1 TX: 01 03 00 C8 00 03 ~~\nCOM2 RX: 02 83 02 ~~",
                "COM3 RX: 01 03 06 00 80",
                "COM3 RX: 42 A4 F1 DE B0 F8",
                "COM1 TX: 03 03 00 C8 00 03 ~~",
                "COM1 RX: 03 83 02 ~~",
            ],
        ),
        &usual,
    );
    // Pieces on both sides of a mark.
    let halves = "RX: 01 03 06 00 80\nRX: 42 A4 F1 DE B0 F8\nTX: 01 03 00 C8 00 03 84 35\n";
    divided(&mut table, "halves", &(halves.repeat(300) + &halves.repeat(100)), &usual);
    // Without checks nothing is beyond doubt, and a block ends between two that are not.
    let unchecked = "TX: 01 03 00 C8 00 03\nRX: 01 03 06 00 80 42 A4 F1 DE\n";
    let doubtful = "so 05 06 00 C9 00 03 it\nTX: 41 00 23 00 00 00 00 00\n";
    let text = unchecked.repeat(450) + &"nothing is said here\n".repeat(300) + doubtful;
    divided(&mut table, "no checks, then prose", &text, &["01 03 00 C8 00 03", "01 03 06 00 80 42 A4 F1 DE"]);
    // Where all lines are telegrams, so is one between nothing.
    let alone = format!("{ASKS}\n{ANSWERS}\n").repeat(400) + &"\n".repeat(5_000) + "77 88 99 AA BB CC\n";
    divided(&mut table, "one among nothing", &(alone + &"\n".repeat(5_000)), &usual);
    // Times, over midnight and with dates.
    let timed = |n: usize, date: &str| {
        let time = |n: usize| format!("{date}{:02}:{:02}:{:02}", n / 3600 % 24, n / 60 % 60, n % 60);
        format!("{} TX: {ASKS}\n{} RX: {ANSWERS}\n", time(n * 300), time(n * 300 + 1))
    };
    for date in ["", "2026-03-02 "] {
        let text: String = (0..600).map(|n| timed(n, date)).collect();
        let text = format!("{text}nothing at 10:00:00\nTX: 02 03 00 C8 00 03 84 06\n");
        divided(&mut table, &format!("times {date}"), &text, &usual);
    }
    assert_table("logs_with_marks", &table);
}

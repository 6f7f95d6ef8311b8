//! One byte in each line, with its time: pauses tell where telegrams end.

use std::fmt::Write as _;

use buslens::field::Direction;
use buslens::tool::Options;
use buslens::tool::log::{Log, Reading, Role};

use super::generator::{Sent, exchanges};

/// Microseconds between two bytes at 9600 baud, and before an answer.
const BYTE: u64 = 1042;
const PAUSE: u64 = 4500;

/// Each byte of the telegrams with its time.
fn timed(telegrams: &[Vec<u8>]) -> Vec<(u64, u8)> {
    let mut time = 31_179;
    let mut bytes = Vec::new();
    for telegram in telegrams {
        for byte in telegram {
            bytes.push((time, *byte));
            time += BYTE;
        }
        time += PAUSE;
    }
    bytes
}

fn read(text: &str) -> Log {
    Log::read(text.as_bytes(), &Reading::default(), Options::default()).expect("a log")
}

fn found(log: &Log, text: &str) -> Vec<(Vec<u8>, Direction)> {
    let telegrams = log.entries().iter().filter(|entry| entry.role != Role::Discarded);
    telegrams.map(|entry| (log.bytes(&text.as_bytes(), &entry).into_owned(), entry.direction)).collect()
}

/// A heading, and how a line is written.
type Form = (&'static str, fn(u64, u8) -> String);

const FORMS: &[Form] = &[
    ("time_us\tbyte\n", |time, byte| format!("{time}.0\t{byte:02X}")),
    ("Time [s],Value,Parity Error,Framing Error\n", |time, byte| {
        format!("{}.{:06}000000000,0x{byte:02X},,", time / 1_000_000, time % 1_000_000)
    }),
    ("name,type,start_time,duration,data\n", |time, byte| {
        format!("\"Serial\",\"data\",{}.{:06},0.00104,0x{byte:02X}", time / 1_000_000, time % 1_000_000)
    }),
    ("", |time, byte| {
        let (second, micro) = (time / 1_000_000, time % 1_000_000);
        format!("10:{:02}:{:02}.{micro:06} RX {byte:02x}", second / 60, second % 60)
    }),
    ("", |_, byte| format!("{byte:02X}")),
];

#[test]
fn telegrams_are_put_together() {
    let truth: Vec<Sent> = exchanges(11, 400);
    let telegrams: Vec<Vec<u8>> = truth.iter().map(Sent::rtu).collect();
    let truth: Vec<_> = truth.iter().map(|sent| (sent.rtu(), sent.direction)).collect();
    for (heading, form) in FORMS {
        let mut text = String::from(*heading);
        for (time, byte) in timed(&telegrams) {
            writeln!(text, "{}", form(time, byte)).unwrap();
        }
        let log = read(&text);
        assert_eq!(found(&log, &text), truth, "{}", text.lines().nth(3).unwrap_or_default());
        let timed = log.entry(1).time().is_some();
        let expected = 31_179 + telegrams[0].len() as i64 * BYTE as i64 + PAUSE as i64;
        let start = if heading.is_empty() { 36_000_000_000 } else { 0 };
        assert_eq!(log.entry(1).time(), timed.then_some(start + expected));
        let report = log.report(&text.as_bytes(), &[1]);
        let places = &report.telegrams[0].line.places;
        let shown: Vec<u8> = places
            .iter()
            .map(|place| text[place.from..place.to].trim_start_matches("0x"))
            .map(|digits| u8::from_str_radix(digits, 16).expect("two digits"))
            .collect();
        assert_eq!(shown, telegrams[1], "each byte is shown in its line");
    }
}

#[test]
fn the_longer_pause_decides_where_two_lengths_are_right() {
    // A response with four bytes that ends in 00; without that, a request for no registers, as long as
    // its check is concerned.
    let long =
        [Sent { direction: Direction::Response, body: vec![5, 3, 4, 0, 10, 0] }.rtu(), vec![0]].concat();
    let other = Sent { direction: Direction::Response, body: vec![6, 3, 2, 0, 7] }.rtu();
    let read_with = |pause_behind: usize| {
        let mut text = String::from("time_us\tbyte\n");
        let mut time = 0;
        for _ in 0..5 {
            for (at, byte) in long.iter().enumerate() {
                writeln!(text, "{time}.0\t{byte:02X}").unwrap();
                time += BYTE + if at + 1 == pause_behind { PAUSE } else { 0 };
            }
            for byte in &other {
                writeln!(text, "{time}.0\t{byte:02X}").unwrap();
                time += BYTE;
            }
            time += PAUSE;
        }
        let log = read(&text);
        usize::from(log.entry(0).length)
    };
    assert_eq!((read_with(9), read_with(8)), (9, 8));
}

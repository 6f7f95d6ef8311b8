//! `cargo bench --bench logs`: what reading whole logs costs, beside two other crates.
//!
//! A stream of 200,000 mixed telegrams: Buslens finds where each one begins and ends, checks it,
//! meets requests with responses, counts, and keeps an index with all bytes. The other crates are
//! told in advance which telegrams are requests and which responses, and keep nothing. rmodbus is
//! asked for lengths alone, and for lengths with checks, which is the least that splitting needs.

use std::fmt::Write as _;
use std::hint::black_box;

use buslens::field::{Direction, hex};
use buslens::tool::Options;
use buslens::tool::log::{Input, Log, Reading, Role};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use modbus_core::rtu;
use rmodbus::client::ModbusRequest;
use rmodbus::server::ModbusFrame;
use rmodbus::{ErrorKind, ModbusProto, guess_request_frame_len, guess_response_frame_len};

#[path = "../tests/logs/generator.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod generator;

use generator::{Random, Sent, exchange_of};

const TELEGRAMS: usize = 200_000;

/// Functions that all three know.
const FUNCTIONS: &[u8] = &[1, 2, 3, 3, 3, 4, 5, 6, 15, 16];

const MOST_REGISTERS: usize = 16;

fn telegrams() -> Vec<Sent> {
    let mut random = Random(2026);
    (0..TELEGRAMS / 2).flat_map(|_| exchange_of(&mut random, FUNCTIONS, MOST_REGISTERS)).collect()
}

/// Buslens, from the raw bytes to the finished index.
fn ours(stream: &[u8]) -> Log {
    let reading = Reading { input: Input::Binary, ..Reading::default() };
    Log::read(stream, &reading, Options::default()).expect("a stream")
}

/// rmodbus, told that requests and responses take turns; `check` for each telegram found.
fn with_rmodbus(stream: &[u8], mut check: impl FnMut(&[u8], bool)) -> usize {
    let (mut at, mut found) = (0, 0);
    while at < stream.len() {
        let asks = found % 2 == 0;
        let guess = if asks { guess_request_frame_len } else { guess_response_frame_len };
        let length = usize::from(guess(&stream[at..], ModbusProto::Rtu).expect("a telegram"));
        check(&stream[at..at + length], asks);
        (at, found) = (at + length, found + 1);
    }
    found
}

/// Its checks of a request and of a response, as a server and a client make them.
fn check_with_rmodbus(stream: &[u8]) -> usize {
    let mut answer: Vec<u8> = Vec::new();
    with_rmodbus(stream, |telegram, asks| {
        if asks {
            let mut frame = ModbusFrame::new(telegram[0], telegram, ModbusProto::Rtu, &mut answer);
            frame.parse().expect("a right request");
        } else {
            let client = ModbusRequest::new(telegram[0], ModbusProto::Rtu);
            let result = client.parse_ok(telegram);
            assert!(!matches!(result, Err(ErrorKind::FrameCRCError)), "a right response");
        }
    })
}

/// modbus-core, told the same. It takes the byte count of functions 15 and 16 from the wrong place
/// and loses these requests, and with them its turn: whoever is not found is looked for as the other.
fn with_modbus_core(stream: &[u8]) -> usize {
    use modbus_core::DecoderType::{Request, Response};
    let (mut at, mut found, mut asks) = (0, 0, true);
    while at < stream.len() {
        let side = if asks { Request } else { Response };
        if let Ok(Some((_, place))) = rtu::decode(side, &stream[at..]) {
            (at, found) = (at + place.start + place.size, found + 1);
        } else {
            at += 1;
        }
        asks = !asks;
    }
    found
}

fn streams(c: &mut Criterion) {
    let stream: Vec<u8> = telegrams().iter().flat_map(Sent::rtu).collect();
    let log = ours(&stream);
    assert_eq!(log.entries().iter().filter(|entry| entry.role != Role::Discarded).count(), TELEGRAMS);
    assert_eq!(with_rmodbus(&stream, |_, _| ()), TELEGRAMS);
    assert_eq!(check_with_rmodbus(&stream), TELEGRAMS);
    println!("modbus-core finds {} of {TELEGRAMS} telegrams", with_modbus_core(&stream));
    let mut group = c.benchmark_group("a stream of 200,000 telegrams");
    group.sample_size(20).throughput(Throughput::Elements(TELEGRAMS as u64));
    group.bench_function("buslens: split, checked, paired, indexed", |b| b.iter(|| ours(black_box(&stream))));
    group.bench_function("rmodbus: split", |b| {
        b.iter(|| with_rmodbus(black_box(&stream), |telegram, _| _ = black_box(telegram)));
    });
    group.bench_function("rmodbus: split, checked", |b| b.iter(|| check_with_rmodbus(black_box(&stream))));
    group.bench_function("modbus-core: split, checked", |b| b.iter(|| with_modbus_core(black_box(&stream))));
    group.finish();
}

/// How programs write a telegram into their log.
type Layout = (&'static str, fn(&mut String, usize, &Sent));

static LAYOUTS: &[Layout] = &[
    ("a time, a word, bytes", |text, n, sent| {
        line(text, format_args!("{} {}: {}", time(n), side(sent), hex(&sent.rtu())));
    }),
    ("brackets and dots", |text, n, sent| {
        let bytes = joined(&sent.rtu(), ".", |byte| format!("{byte:02X}"));
        line(text, format_args!("[{}][V][modbus:199]: Modbus {}: {bytes}", time(n), side(sent)));
    }),
    ("counters", |text, n, sent| {
        line(text, format_args!("{n:06}-{}:{}", side(sent), hex(&sent.rtu())));
    }),
    ("a byte in brackets each", |text, _, sent| {
        let bytes = sent.rtu();
        let [open, close] = if sent.direction == Direction::Request { ["[", "]"] } else { ["<", ">"] };
        line(
            text,
            format_args!(
                "{open}{}{close}",
                joined(&bytes, &format!("{close}{open}"), |b| format!("{b:02X}"))
            ),
        );
    }),
    ("numbers with a prefix", |text, n, sent| {
        let bytes = joined(&sent.rtu(), " ", |byte| format!("{byte:#x}"));
        line(text, format_args!("2026-03-02 {} DEBUG transaction {}: {bytes}", time(n), side(sent)));
    }),
    ("decimal numbers", |text, _, sent| {
        line(text, format_args!("{}: {}", side(sent), joined(&sent.rtu(), ", ", |byte| byte.to_string())));
    }),
    ("digits without blanks", |text, n, sent| {
        line(
            text,
            format_args!("{} {} {}", time(n), side(sent), joined(&sent.rtu(), "", |b| format!("{b:02x}"))),
        );
    }),
];

fn line(text: &mut String, line: std::fmt::Arguments<'_>) {
    writeln!(text, "{line}").expect("a string takes all");
}

fn side(sent: &Sent) -> &'static str {
    if sent.direction == Direction::Request { "TX" } else { "RX" }
}

/// Of a day, a telegram each 400 ms.
fn time(n: usize) -> String {
    let (second, milli) = (n * 2 / 5, n * 400 % 1000);
    format!("{:02}:{:02}:{:02}.{milli:03}", second / 3600, second / 60 % 60, second % 60)
}

fn joined(bytes: &[u8], between: &str, write: fn(u8) -> String) -> String {
    bytes.iter().map(|byte| write(*byte)).collect::<Vec<_>>().join(between)
}

fn texts(c: &mut Criterion) {
    let read = |text: &[u8]| Log::read(text, &Reading::default(), Options::default()).expect("a log");
    let sent = telegrams();
    let mut group = c.benchmark_group("a log of 200,000 lines");
    group.sample_size(10);
    for (name, write) in LAYOUTS {
        let mut text = String::new();
        sent.iter().enumerate().for_each(|(n, sent)| write(&mut text, n, sent));
        let telegrams = read(text.as_bytes()).entries().iter().filter(|entry| entry.counts()).count();
        assert!(telegrams.abs_diff(TELEGRAMS) * 1000 < TELEGRAMS, "{name}: {telegrams} of {TELEGRAMS}");
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(*name, |b| b.iter(|| read(black_box(text.as_bytes()))));
    }
    group.finish();
}

criterion_group!(benches, streams, texts);
criterion_main!(benches);

//! `cargo bench --bench logs`: what reading whole logs costs, beside another crate, in processor time.
//!
//! A stream of 200,000 mixed telegrams: Buslens finds where each one begins and ends, checks it,
//! meets requests with responses, counts, and keeps an index. rmodbus is told in advance which
//! telegrams are requests and which responses; it is asked for lengths and checks, which is the
//! least that splitting needs, and keeps nothing. Then the text of each program that the tests know.
//!
//! All take turns, and the best round of each counts: what else runs on the machine is the same for all of them.
//! Words behind `--` choose: `stream`, or what stands in the first line of a text.

use std::hint::black_box;
use std::time::Duration;

use buslens::field::Direction;
use buslens::tool::Options;
use buslens::tool::log::{Input, Log, Reading, Role};
use rmodbus::client::ModbusRequest;
use rmodbus::server::ModbusFrame;
use rmodbus::{ErrorKind, ModbusProto, guess_request_frame_len, guess_response_frame_len};

#[path = "../tests/logs/generator.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod generator;
#[path = "../tests/logs/programs.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod programs;
mod time;

use generator::{Random, exchange_of, exchanges};
use programs::{PROGRAMS, Program};
use time::processor_time;

const TELEGRAMS: usize = 200_000;

/// Functions that both know.
const FUNCTIONS: &[u8] = &[1, 2, 3, 3, 3, 4, 5, 6, 15, 16];

const MOST_REGISTERS: usize = 16;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let wants = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word.as_str()));
    if wants("stream") {
        streams();
    }
    texts(wants);
}

fn streams() {
    const ROUNDS: usize = 40;
    let mut random = Random(2026);
    let sent = (0..TELEGRAMS / 2).flat_map(|_| exchange_of(&mut random, FUNCTIONS, MOST_REGISTERS));
    let stream: Vec<u8> = sent.flat_map(|sent| sent.rtu()).collect();
    let found = ours(&stream).entries().iter().filter(|entry| entry.role != Role::Discarded).count();
    assert_eq!([found, with_rmodbus(&stream)], [TELEGRAMS; 2]);
    let [ours, others] = in_turns(
        ROUNDS,
        [&mut || ours(black_box(&stream)).entries().len(), &mut || with_rmodbus(black_box(&stream))],
    );
    let speed = |time: Duration| TELEGRAMS as f64 / 1e6 / time.as_secs_f64();
    println!("stream of {TELEGRAMS} telegrams, {} bytes:", stream.len());
    println!("  buslens, split, checked, paired, indexed: {:.2} million a second", speed(ours));
    println!("  rmodbus, split, checked: {:.2} million a second", speed(others));
    println!("  buslens is {:.2} times as quick", others.as_secs_f64() / ours.as_secs_f64());
}

/// Buslens, from the raw bytes to the finished index.
fn ours(stream: &[u8]) -> Log {
    let reading = Reading { input: Input::Binary, ..Reading::default() };
    Log::read(stream, &reading, Options::default()).expect("a stream")
}

/// rmodbus, told that requests and responses take turns, with its checks of both, as a server and a client make them.
fn with_rmodbus(stream: &[u8]) -> usize {
    let mut answer: Vec<u8> = Vec::new();
    let (mut at, mut found) = (0, 0);
    while at < stream.len() {
        let asks = found % 2 == 0;
        let guess = if asks { guess_request_frame_len } else { guess_response_frame_len };
        let length = usize::from(guess(&stream[at..], ModbusProto::Rtu).expect("a telegram"));
        let telegram = &stream[at..at + length];
        if asks {
            let mut frame = ModbusFrame::new(telegram[0], telegram, ModbusProto::Rtu, &mut answer);
            frame.parse().expect("a right request");
        } else {
            let client = ModbusRequest::new(telegram[0], ModbusProto::Rtu);
            let result = client.parse_ok(telegram);
            assert!(!matches!(result, Err(ErrorKind::FrameCRCError)), "a right response");
        }
        (at, found) = (at + length, found + 1);
    }
    found
}

fn texts(wants: impl Fn(&str) -> bool) {
    const ROUNDS: usize = 5;
    const SHOWN: usize = 80;
    let read = |text: &str| {
        Log::read(text.as_bytes(), &Reading::default(), Options::default()).expect("a log").entries().len()
    };
    let mut each: Vec<f64> = Vec::new();
    for text in PROGRAMS.iter().map(text) {
        let line = text.lines().next().unwrap_or_default();
        if !wants(line) {
            continue;
        }
        let [time] = in_turns(ROUNDS, [&mut || read(black_box(&text))]);
        each.push(time.as_nanos() as f64 / text.len() as f64);
        let beginning: String = line.chars().take(SHOWN).collect();
        println!("{:5.1} ns a byte of text: {beginning}", each[each.len() - 1]);
    }
    each.sort_by(f64::total_cmp);
    if let Some(middle) = each.get(each.len() / 2) {
        let mean = each.iter().sum::<f64>() / each.len() as f64;
        println!("{mean:5.1} in the mean of {} texts, {middle:.1} in the middle", each.len());
    }
}

/// 40,000 telegrams as a program writes them.
fn text(program: &Program) -> String {
    const EXCHANGES: usize = 20_000;
    let mut text = String::new();
    for (n, sent) in exchanges(2026, EXCHANGES).iter().enumerate() {
        let asks = sent.direction == Direction::Request;
        (program.write)(&mut text, &(program.frame)(sent, n), asks, n);
    }
    text
}

/// The time of the processor that each work takes, at its best of some rounds in turns.
fn in_turns<const N: usize>(rounds: usize, mut works: [&mut dyn FnMut() -> usize; N]) -> [Duration; N] {
    let mut best = [Duration::MAX; N];
    for _ in 0..rounds {
        for (best, work) in best.iter_mut().zip(&mut works) {
            let start = processor_time();
            black_box(work());
            *best = (processor_time() - start).min(*best);
        }
    }
    best
}

//! Buslens itself.

use std::hint::black_box;

use buslens::tool::log::{Input, Log, Reading, Role};
use buslens::tool::{Options, Protocol, Verdict, json};

use crate::data::Data;
use crate::{Measured, compare, speed};

pub fn measure(data: &Data) -> Measured {
    let noise = read(&data.noise.0, "modbus-rtu");
    let right = spans(&noise, |verdict| verdict == Verdict::Right);
    let odd = read(&data.odd.0, "modbus-tcp");
    let (odd, _) = compare(&spans(&odd, |_| true), &data.odd.1);
    Measured {
        name: "Buslens (paired and indexed besides)".to_owned(),
        split: Some(speed(|| read(black_box(&data.stream), "modbus-rtu").entries().len())),
        decoded: Some(decoded(data)),
        noise: Some(compare(&right, &data.noise.1)),
        odd: Some(odd),
    }
}

fn read(stream: &[u8], protocol: &str) -> Log {
    let reading = Reading { input: Input::Binary, ..Reading::default() };
    let options = Options { protocol: Protocol::of(protocol), ..Options::default() };
    Log::read(stream, &reading, options).expect("a stream")
}

fn spans(log: &Log, is_right: impl Fn(Verdict) -> bool) -> Vec<(usize, usize)> {
    let entries =
        log.entries().iter().filter(|entry| entry.role != Role::Discarded && is_right(entry.verdict));
    entries.map(|entry| (entry.offset as usize, usize::from(entry.length))).collect()
}

/// Telegrams a second, from an index to JSON with all their fields.
fn decoded(data: &Data) -> f64 {
    const TELEGRAMS: usize = 10_000;
    const AT_ONCE: usize = 1000;
    let log = read(&data.stream, "modbus-rtu");
    let source = data.stream.as_slice();
    let mut text = String::new();
    speed(|| {
        for from in (0..TELEGRAMS).step_by(AT_ONCE) {
            let indices: Vec<usize> = (from..from + AT_ONCE).collect();
            let report = log.report(&source, &indices);
            for place in 0..report.telegrams.len() {
                text.clear();
                json::push_line(&mut text, &report, place, true);
                black_box(&text);
            }
        }
        TELEGRAMS
    })
}

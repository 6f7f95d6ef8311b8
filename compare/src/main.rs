//! Buslens beside other programs that read Modbus: all of them read the same generated data, one after the other on
//! the same machine, and what they do is printed as a table. `cargo xtask compare` starts it.
//!
//! What others are told and Buslens is not: that requests and responses take turns.

mod crates;
mod data;
mod ours;
mod scripts;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use data::Data;

/// What a program does with the data. What it has no way to do is `None`.
#[derive(Debug, Default)]
pub struct Measured {
    pub name: String,
    /// Telegrams a second that are split and checked.
    pub split: Option<f64>,
    /// Telegrams a second that are decoded to JSON, with all their fields.
    pub decoded: Option<f64>,
    /// Of the intact telegrams between noise, how many are found, and how many besides.
    pub noise: Option<(usize, usize)>,
    /// Of the telegrams of a connection with fuzzed, out-of-order and unknown functions, how many are told with their
    /// unit, function and length.
    pub odd: Option<usize>,
}

fn main() {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "target/compare".to_owned());
    let folder = Path::new(&folder);
    let data = Data::new();
    for (name, bytes) in [("stream", &data.stream), ("noise", &data.noise.0), ("odd", &data.odd.0)] {
        fs::create_dir_all(folder)
            .and_then(|()| fs::write(folder.join(format!("{name}.bin")), bytes))
            .expect("data is written");
    }
    // Where telegrams are, for programs that are shown one at a time.
    for (name, spans) in [("noise", &data.noise.1), ("odd", &data.odd.1)] {
        let lines: String = spans.iter().fold(String::new(), |mut lines, (from, length)| {
            _ = writeln!(lines, "{from} {length}");
            lines
        });
        fs::write(folder.join(format!("{name}.txt")), lines).expect("data is written");
    }
    let mut rows = vec![ours::measure(&data), crates::rmodbus(&data), crates::modbus_core(&data)];
    rows.extend(scripts::measure(folder));
    print_table(&rows, &data);
}

fn print_table(rows: &[Measured], data: &Data) {
    println!(
        "| | split and checked, telegrams/s | decoded to JSON with all fields, telegrams/s | found in noise, of {} | invented in noise | odd telegrams told, of {} |",
        grouped(data.noise.1.len()),
        grouped(data.odd.1.len())
    );
    println!("| --- | --- | --- | --- | --- | --- |");
    for row in rows {
        let speed = |speed: Option<f64>| speed.map_or("–".to_owned(), |speed| grouped(speed as usize));
        let count = |count: Option<usize>| count.map_or("–".to_owned(), grouped);
        println!(
            "| {} | {} | {} | {} | {} | {} |",
            row.name,
            speed(row.split),
            speed(row.decoded),
            count(row.noise.map(|(found, _)| found)),
            count(row.noise.map(|(_, invented)| invented)),
            count(row.odd)
        );
    }
}

/// A number with commas.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// How many things a second `work` does, which tells how many it did: the best of some tries.
fn speed(mut work: impl FnMut() -> usize) -> f64 {
    const TRIES: usize = 15;
    let began = Instant::now();
    let tries = (0..TRIES).map(|_| {
        let start = time(began);
        let count = work();
        count as f64 / (time(began) - start).as_secs_f64()
    });
    tries.fold(0.0, f64::max)
}

/// The time of the processor that this thread took, where the system tells it, so that others beside it count for
/// little; else the time since `began`.
fn time(began: Instant) -> Duration {
    let told = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|told| told.split_whitespace().next()?.parse().ok());
    nanoseconds.map_or_else(|| began.elapsed(), Duration::from_nanos)
}

/// Of what was reported (from where on, how long), how much is true, and how much is not.
fn compare(reported: &[(usize, usize)], truth: &[(usize, usize)]) -> (usize, usize) {
    let found = reported.iter().filter(|span| truth.binary_search(span).is_ok()).count();
    (found, reported.len() - found)
}

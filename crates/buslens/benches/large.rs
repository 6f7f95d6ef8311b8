//! `cargo bench --bench large -- 4`: logs of 1, 2 and 4 GB (1 GB at most without a number), read in parts as the page's
//! worker does: when there is something to see, how long all of it takes, both in time of the processor, and what
//! memory it takes at most. Then how much quicker several threads are, each with a slice of a log of at most 1 GB, and
//! whether that gives the same; in turns, in time of the processor: what goes on at once counts as long as the longest.
//!
//! The logs repeat a day of telegrams, which is all that is in memory of them.

use std::fs;
use std::ops::Range;
use std::process::Command;
use std::thread;
use std::time::Duration;

use buslens::field::hex;
use buslens::tool::Options;
use buslens::tool::log::{BEGINNING, Division, Filter, Input, Log, Reading, Slice, Source, Wanted};

#[path = "../tests/logs/generator.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod generator;
mod time;

use generator::{Random, exchange};
use time::processor_time;

/// A day of telegrams, again and again, up to some size.
struct Repeated {
    day: Vec<u8>,
    size: u64,
}

impl Source for Repeated {
    fn read(&self, from: u64, length: usize) -> Vec<u8> {
        let end = (from + length as u64).min(self.size);
        let mut bytes = Vec::with_capacity(length);
        while from + (bytes.len() as u64) < end {
            let at = from + bytes.len() as u64;
            let part = &self.day[(at % self.day.len() as u64) as usize..];
            bytes.extend_from_slice(&part[..part.len().min((end - at) as usize)]);
        }
        bytes
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    if let [what, gigabytes, ..] = words.as_slice() {
        let (day, input) = if what == "stream" { (stream(), Input::Binary) } else { (text(), Input::Auto) };
        // Only whole days, so that no telegram is cut.
        let days = gigabytes.parse::<f64>().expect("a number") * 1e9 / day.len() as f64;
        let size = days.ceil() as u64 * day.len() as u64;
        let file = Repeated { day, size };
        return if words.len() > 2 { compare(what, &file, input) } else { read(what, &file, input) };
    }
    let most = words.first().and_then(|word| word.parse::<f64>().ok()).unwrap_or(1.0);
    for what in ["stream", "text"] {
        // Each in a process of its own, so that the memory is its own.
        let run = |gigabytes: f64, more: &[&str]| {
            let program = std::env::current_exe().expect("this program");
            let ran = Command::new(program).args([what, &gigabytes.to_string()]).args(more).status();
            assert!(ran.is_ok_and(|status| status.success()));
        };
        [most / 4.0, most / 2.0, most].into_iter().for_each(|gigabytes| run(gigabytes, &[]));
        run(most.min(1.0), &["slices"]);
    }
}

/// Reads a log as the page's worker does, and prints what that takes.
fn read(what: &str, file: &Repeated, input: Input) {
    /// As in the worker.
    const FIRST: usize = 1 << 20;
    const PIECE: usize = 4 << 20;
    let before = memory("VmRSS:");
    let began = processor_time();
    let reading = Reading { input, ..Reading::default() };
    let beginning = file.read(0, BEGINNING);
    let mut log = Log::open(&beginning, file.size, &reading, Options::default()).expect("a log");
    let (mut at, mut length, mut known, mut seen) = (0, FIRST, 0, None);
    while at < file.size {
        let part = file.read(at, length);
        assert!(log.push(&part), "there is memory for all of it");
        (at, length) = (at + part.len() as u64, PIECE);
        // Whenever there is twice as much, it is shown.
        if log.entries().len() >= (2 * known).max(1) {
            known = log.entries().len();
            log.look();
            let rows: Vec<u32> = (0..40).collect();
            assert!(!log.overview().headline.is_empty() && log.rows(file, &rows).len() == rows.len());
            seen.get_or_insert_with(|| processor_time() - began);
        }
    }
    log.finish();
    let whole = processor_time() - began;
    let telegrams = log.entries().len();
    // What is said of it then is worked out in silence.
    let silence = processor_time();
    assert!(!log.overview().headline.is_empty());
    log.findings(file);
    log.proposals(file);
    log.seen(file);
    log.lanes(None, 200);
    let silence = processor_time() - silence;
    let peak = memory("VmHWM:").saturating_sub(before);
    let wrong = Filter { wanted: Wanted::Errors, ..Filter::default() };
    let answer = processor_time();
    let found = log.filtered(&wrong, file, file.size).len();
    println!(
        "{what} of {:.2} GB, {:.1} million telegrams: first rows after {:.2} s, all after {:.1} s ({:.0} MB/s), \
         summed up in {:.2} s, {found} wrong ones in {:.2} s, {:.0} MB of memory at most ({:.1} bytes a telegram kept)",
        file.size as f64 / 1e9,
        telegrams as f64 / 1e6,
        seen.unwrap_or(whole).as_secs_f64(),
        whole.as_secs_f64(),
        file.size as f64 / 1e6 / whole.as_secs_f64(),
        silence.as_secs_f64(),
        (processor_time() - answer).as_secs_f64(),
        peak as f64 / 1e6,
        log.memory() as f64 / telegrams as f64,
    );
}

/// Reads a log by one thread and by as many as there are, each with a slice, and prints what that gains.
fn compare(what: &str, file: &Repeated, input: Input) {
    const ROUNDS: usize = 3;
    let threads = thread::available_parallelism().map_or(1, usize::from).min(4);
    let (mut one, mut several) = ([Duration::MAX / 4; 4], [Duration::MAX / 4; 4]);
    let sum = |times: &[Duration; 4]| times.iter().sum::<Duration>().as_secs_f64();
    for _ in 0..ROUNDS {
        let (whole, took) = read_slices(file, input, 1);
        one = if sum(&took) < sum(&one) { took } else { one };
        let (joined, took) = read_slices(file, input, threads);
        several = if sum(&took) < sum(&several) { took } else { several };
        assert!(
            joined.statistics() == whole.statistics() && joined.lines() == whole.lines(),
            "it is the same"
        );
        let same = joined.entries().iter().zip(whole.entries()).all(|(joined, whole)| {
            (joined.offset, joined.partner(), joined.time()) == (whole.offset, whole.partner(), whole.time())
        });
        assert!(same, "its telegrams are the same");
    }
    let [beginning, slices, joining, summing] = several.map(|time| time.as_secs_f64());
    println!(
        "{what} of {:.2} GB by {threads} threads: {:.1} s, {:.2} times as quick as one ({:.1} s): its beginning          {beginning:.2} s, the longest slice {slices:.2} s, joining {joining:.2} s, counting {summing:.2} s",
        file.size as f64 / 1e9,
        sum(&several),
        sum(&one) / sum(&several),
        sum(&one),
    );
}

/// Reads a log in at most so many slices at once; returns how long its beginning takes, the longest slice, what is put
/// together then, and what is counted of all.
fn read_slices(file: &Repeated, input: Input, most: usize) -> (Log, [Duration; 4]) {
    const PIECE: u64 = 4 << 20;
    const LEAST: u64 = 32 << 20;
    let reading = Reading { input, ..Reading::default() };
    let open = || {
        let log = Log::open(&file.read(0, BEGINNING), file.size, &reading, Options::default());
        log.expect("a log").divided(Division::default())
    };
    let push = |log: &mut Log, from: u64, to: u64, then: &mut dyn FnMut(&mut Log)| {
        for at in (from..to).step_by(PIECE as usize) {
            assert!(log.push(&file.read(at, PIECE.min(to - at) as usize)), "there is memory for all of it");
            then(log);
        }
    };
    let began = processor_time();
    let mut first = open();
    while first.divisible_from().is_none() && first.taken() < file.size {
        let part = file.read(first.taken(), 1 << 20);
        first.push(&part);
    }
    let beginning = first.taken();
    let slices = first.slices(file.size, most, LEAST);
    let begun = processor_time();
    let mut longest = Duration::ZERO;
    let mut others: Vec<Slice> = thread::scope(|scope| {
        let read = |slice: &Range<u64>| {
            let Range { start, end } = *slice;
            scope.spawn(move || {
                let (mut log, mut slice) = (open(), Slice::default());
                push(&mut log, 0, beginning, &mut |_| {});
                let at = log.jump(start);
                push(&mut log, at, end, &mut |log| assert!(slice.take(&log.hand_over())));
                assert!(slice.take(&log.hand_over_rest(file.size)));
                (slice, processor_time())
            })
        };
        let others: Vec<_> = slices.iter().skip(1).map(read).collect();
        push(&mut first, beginning, slices.first().map_or(beginning, |slice| slice.end), &mut |_| {});
        longest = processor_time() - begun;
        let others = others.into_iter().map(|other| other.join().expect("it is read"));
        others.map(|(slice, took)| (slice, longest = longest.max(took)).0).collect()
    });
    let read = processor_time();
    while first.taken() < file.size && !first.join(&mut others, file.size) {
        let next = first.next_mark().min(file.size);
        let at = first.taken();
        push(&mut first, at, next, &mut |_| {});
    }
    let joined = processor_time();
    first.finish();
    let took = [begun - began, longest, joined - read, processor_time() - joined];
    (first, took)
}

/// What the system says of the memory of this program, in bytes; 0 where it says nothing.
fn memory(what: &str) -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(what));
    line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok()).unwrap_or(0) << 10
}

fn stream() -> Vec<u8> {
    let mut random = Random(1);
    (0..1_000_000).flat_map(|_| exchange(&mut random)).flat_map(|sent| sent.rtu()).collect()
}

/// An exchange each tenth of a second, for a day.
fn text() -> Vec<u8> {
    let mut random = Random(2);
    let exchanges = (0..864_000_u32).map(|n| (n, exchange(&mut random)));
    let lines = exchanges.flat_map(|(n, sent)| {
        let time = |millis: u32| {
            let seconds = millis / 1000;
            let (hour, minute) = (seconds / 3600, seconds / 60 % 60);
            format!("{hour:02}:{minute:02}:{:02}.{:03}", seconds % 60, millis % 1000)
        };
        let [request, response] = sent.map(|sent| hex(&sent.rtu()));
        let (asked, answered) = (time(n * 100), time(n * 100 + 12));
        format!("{asked} TX: {request}\n{answered} RX: {response}\n").into_bytes()
    });
    lines.collect()
}

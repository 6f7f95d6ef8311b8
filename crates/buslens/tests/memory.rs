//! What logs of any size take: some bytes for each telegram, in proportion to their number, and nothing else.
//!
//! The logs are written while they are read, as long as wanted, so that they take no memory themselves.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use buslens::tool::Options;
use buslens::tool::log::{Bytes, Log, Reading, Source};
use buslens::walk::CRC_16_MODBUS;

/// Counts what is allocated.
struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        MOST.fetch_max(NOW.fetch_add(layout.size(), Relaxed) + layout.size(), Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A log of telegrams that are written when they are read.
struct Written {
    telegrams: usize,
    /// Telegram `n` as the log has it: as many bytes for every one of a kind, requests and responses by turns.
    write: fn(usize) -> Vec<u8>,
}

impl Written {
    fn pair(&self) -> u64 {
        ((self.write)(0).len() + (self.write)(1).len()) as u64
    }

    fn size(&self) -> u64 {
        self.pair() * self.telegrams as u64 / 2
    }
}

impl Source for Written {
    fn read(&self, from: u64, length: usize) -> Vec<u8> {
        let first = (from / self.pair()) as usize * 2;
        let skip = (from % self.pair()) as usize;
        (first..self.telegrams).flat_map(self.write).skip(skip).take(length).collect()
    }
}

/// A poll of ten registers, every tenth of a second, whose values are hardly ever the same.
fn telegram(n: usize) -> Vec<u8> {
    let unit = 1 + (n / 2 % 30) as u8;
    let mut body = vec![unit, 3];
    if n.is_multiple_of(2) {
        body.extend([0, 200, 0, 10]);
    } else {
        body.push(20);
        body.extend((0..20_usize).map(|at| (n.wrapping_mul(0x9E37_79B1) >> at) as u8));
    }
    let check = CRC_16_MODBUS.wire(&body) as u16;
    [body, check.to_be_bytes().to_vec()].concat()
}

fn line(n: usize) -> Vec<u8> {
    let (second, milli) = (n / 20, n % 20 * 50 + 7 * (n % 2));
    let (hour, minute, second) = (second / 3600 % 24, second / 60 % 60, second % 60);
    let sent = if n.is_multiple_of(2) { "TX" } else { "RX" };
    let bytes = buslens::field::hex(&telegram(n));
    format!("{hour:02}:{minute:02}:{second:02}.{milli:03} {sent}: {bytes}\n").into_bytes()
}

/// What a log of so many telegrams takes: in the end, and at most, while it is read.
fn taken(telegrams: usize, write: fn(usize) -> Vec<u8>) -> (usize, usize) {
    const PART: usize = 1 << 16;
    /// A file that is not small: it is read again where bytes are wanted.
    const SIZE: u64 = 1 << 33;
    let file = Written { telegrams, write };
    let mut part = file.read(0, PART);
    let before = NOW.load(Relaxed);
    MOST.store(before, Relaxed);
    let mut log = Log::open(&part, SIZE, &Reading::default(), Options::default()).expect("a log");
    let mut at = 0;
    while !part.is_empty() {
        assert!(log.push(&part));
        at += part.len() as u64;
        part = file.read(at, PART);
    }
    assert_eq!(at, file.size());
    log.finish();
    let (taken, most) = (NOW.load(Relaxed) - before, MOST.load(Relaxed) - before);
    assert_eq!(log.entries().len(), telegrams);
    assert_eq!(log.statistics().pairs, telegrams / 2);
    // Nothing is lost: each is read again as it was.
    let mut bytes = Bytes::new(&log, &file);
    for (n, entry) in log.entries().iter().enumerate().filter(|(n, _)| n.is_multiple_of(97) || *n < 500) {
        assert_eq!(bytes.of(&entry), telegram(n), "telegram {n}");
        assert_eq!(log.entries().get(n), Some(entry));
    }
    (taken, most)
}

/// All in one test: others beside it would allocate, too.
#[test]
fn memory_grows_with_the_telegrams_and_by_little() {
    const TELEGRAMS: usize = 40_000;
    /// What is in hand while a log is read, whatever its size.
    const IN_HAND: usize = 8 << 20;
    for (what, write) in [("stream", telegram as fn(usize) -> Vec<u8>), ("text", line)] {
        let sizes = [1, 2, 4].map(|times| taken(times * TELEGRAMS, write));
        let each = sizes.map(|(taken, most)| [taken, most.saturating_sub(IN_HAND)]);
        for (times, [taken, most]) in [1, 2, 4].into_iter().zip(each) {
            let telegrams = times * TELEGRAMS;
            println!("{what}: {:.1} bytes a telegram of {telegrams}", taken as f64 / telegrams as f64);
            assert!(taken <= 16 * telegrams, "{what}: {taken} bytes for {telegrams} telegrams");
            assert!(most <= 16 * telegrams, "{what}: {most} bytes beside what is in hand, of {telegrams}");
        }
        // Twice the log takes no more than twice as much of what grows: the later steps are as small as the first.
        let steps = [each[1][0] - each[0][0], (each[2][0] - each[1][0]) / 2];
        assert!(steps[1] * 10 <= steps[0] * 11, "{what}: {steps:?} more at each step");
        assert!(steps[1] <= 12 * TELEGRAMS, "{what}: {} bytes more for {TELEGRAMS} telegrams", steps[1]);
    }
}

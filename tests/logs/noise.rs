//! Streams with noise and their truth: what is intact is found, nothing is invented.

use buslens::tool::Options;
use buslens::tool::Verdict;
use buslens::tool::log::{Input, Log, Reading, Role};
use buslens::walk::CRC_16_MODBUS;

use super::generator::{Random, exchange};

/// How many exchanges each stream has.
const EXCHANGES: usize = 12_000;

/// A stream, and where its intact telegrams are.
#[derive(Default)]
struct Stream {
    bytes: Vec<u8>,
    intact: Vec<(usize, usize)>,
}

impl Stream {
    fn intact(&mut self, telegram: &[u8]) {
        self.intact.push((self.bytes.len(), telegram.len()));
        self.bytes.extend_from_slice(telegram);
    }

    fn noise(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// A stretch that holds no intact telegram but may be right by chance.
    fn damaged(&mut self, bytes: &[u8]) {
        self.noise(bytes);
    }
}

/// Puts an exchange into the stream, damaged in some way now and then.
type Noise = fn(&mut Stream, &mut Random, [Vec<u8>; 2]);

static KINDS: &[(&str, Noise)] = &[
    ("none", |stream, _, [request, response]| {
        stream.intact(&request);
        stream.intact(&response);
    }),
    ("garbage between", |stream, random, telegrams| {
        for telegram in telegrams {
            let garbage = random.below(12);
            let count = if random.below(4) == 0 { garbage } else { 0 };
            let garbage = random.bytes(count);
            stream.noise(&garbage);
            stream.intact(&telegram);
        }
    }),
    ("flipped bits", |stream, random, telegrams| {
        for mut telegram in telegrams {
            if random.below(10) == 0 {
                let at = random.below(telegram.len());
                telegram[at] ^= 1 << random.below(8);
                stream.damaged(&telegram);
            } else {
                stream.intact(&telegram);
            }
        }
    }),
    ("dropped bytes", |stream, random, telegrams| {
        for mut telegram in telegrams {
            if random.below(10) == 0 {
                telegram.remove(random.below(telegram.len()));
                stream.damaged(&telegram);
            } else {
                stream.intact(&telegram);
            }
        }
    }),
    ("cut off", |stream, random, telegrams| {
        for telegram in telegrams {
            if random.below(10) == 0 {
                let end = random.below(telegram.len());
                stream.damaged(&telegram[..end]);
            } else {
                stream.intact(&telegram);
            }
        }
    }),
    ("echoes", |stream, _, [request, response]| {
        stream.intact(&request);
        stream.intact(&request);
        stream.intact(&response);
    }),
    ("missing replies", |stream, random, [request, response]| {
        stream.intact(&request);
        if random.below(5) > 0 {
            stream.intact(&response);
        }
    }),
    ("11h and 13h swallowed", |stream, _, telegrams| {
        for telegram in telegrams {
            let kept: Vec<u8> =
                telegram.iter().copied().filter(|byte| !matches!(byte, 0x11 | 0x13)).collect();
            if kept.len() == telegram.len() { stream.intact(&telegram) } else { stream.damaged(&kept) }
        }
    }),
    ("00 and FF of the line's turn", |stream, random, telegrams| {
        for telegram in telegrams {
            stream.intact(&telegram);
            let turn = random.of(&[&[][..], &[0], &[0xFF], &[0, 0], &[0xFE, 0xFF]]);
            stream.noise(turn);
        }
    }),
];

#[test]
fn what_is_intact_is_found_and_nothing_is_invented() {
    let mut failed = Vec::new();
    println!(
        "{:30} {:>9} {:>9} {:>9} {:>9} {:>10}",
        "noise", "intact", "found", "invented", "by chance", "found"
    );
    for (seed, (name, noise)) in KINDS.iter().enumerate() {
        let mut random = Random(seed as u64 + 1);
        let mut stream = Stream::default();
        for _ in 0..EXCHANGES {
            let telegrams = exchange(&mut random).map(|sent| sent.rtu());
            noise(&mut stream, &mut random, telegrams);
        }
        let reading = Reading { input: Input::Binary, ..Reading::default() };
        let log = Log::read(&stream.bytes, &reading, Options::default()).unwrap();
        let right: Vec<(usize, usize)> = log
            .entries()
            .iter()
            .filter(|entry| entry.verdict == Verdict::Right && entry.role != Role::Discarded)
            .map(|entry| (entry.offset as usize, entry.length.into()))
            .collect();
        let found = stream.intact.iter().filter(|place| right.binary_search(place).is_ok()).count();
        let others: Vec<&(usize, usize)> =
            right.iter().filter(|place| stream.intact.binary_search(place).is_err()).collect();
        // A run of bytes that is a whole telegram by chance is one to everybody who listens.
        let chance = others.iter().filter(|(at, length)| by_chance(&stream.bytes[*at..at + length])).count();
        let invented = others.len() - chance;
        let share = found as f64 / stream.intact.len() as f64;
        println!(
            "{name:30} {:>9} {found:>9} {invented:>9} {chance:>9} {:>9.4} %",
            stream.intact.len(),
            share * 100.0
        );
        if share < 0.9995 || invented * 10_000 > stream.intact.len() || chance * 1000 > stream.intact.len() {
            failed.push(*name);
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

/// A telegram with a right check whose length is that of its function.
fn by_chance(bytes: &[u8]) -> bool {
    let (body, check) = bytes.split_at(bytes.len() - 2);
    CRC_16_MODBUS.wire(body) == u64::from(u16::from_be_bytes([check[0], check[1]]))
}

/// Twice as many bytes take about twice as long whatever they are: what is looked at is counted by
/// the telegrams and discarded bytes, which together are all bytes, each once.
#[test]
fn each_byte_is_in_one_telegram_or_discarded() {
    let mut random = Random(77);
    let streams = [
        [1, 3].repeat(1 << 19),
        [3, 0xFA].repeat(1 << 18),
        vec![0; 1 << 19],
        random.bytes(1 << 19),
        [0x68, 0xF9, 0xF9, 0x68].repeat(1 << 16),
        [0, 0, 0, 0, 0, 0xFD, 1, 3].repeat(1 << 15),
    ];
    for stream in streams {
        let reading = Reading { input: Input::Binary, ..Reading::default() };
        let log = Log::read(&stream, &reading, Options::default()).unwrap();
        let mut at = 0;
        for entry in log.entries() {
            assert_eq!(entry.offset as usize, at);
            at += usize::from(entry.length);
        }
        assert_eq!(at, stream.len());
    }
}

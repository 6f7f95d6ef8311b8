//! Streams with noise and their truth: what is intact is found, nothing is invented.

use buslens::tool::Options;
use buslens::tool::Verdict;
use buslens::tool::log::{Input, Log, Reading, Role};
use buslens::walk::CRC_16_MODBUS;

use super::generator::{FUNCTIONS, Random, Sent, exchange_of};

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

    /// Whether the byte at `at` is of no intact telegram.
    fn in_noise(&self, at: usize) -> bool {
        let next = self.intact.partition_point(|(intact, length)| intact + length <= at);
        self.intact.get(next).is_none_or(|(intact, _)| *intact > at)
    }

    /// Bytes that hold no intact telegram, but may be right by chance.
    fn noise(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }
}

/// Puts an exchange into the stream, damaged in some way now and then.
type Noise = fn(&mut Stream, &mut Random, [Vec<u8>; 2]);

/// Damages one telegram in ten.
fn damage(stream: &mut Stream, random: &mut Random, telegrams: [Vec<u8>; 2], how: How) {
    for mut telegram in telegrams {
        if random.below(10) == 0 {
            let whole = telegram.clone();
            how(&mut telegram, random);
            if telegram == whole { stream.intact(&telegram) } else { stream.noise(&telegram) }
        } else {
            stream.intact(&telegram);
        }
    }
}

/// A way to damage a telegram.
type How = fn(&mut Vec<u8>, &mut Random);

const FLIP: How = |telegram, random| {
    let at = random.below(telegram.len());
    telegram[at] ^= 1 << random.below(8);
};

fn drop_byte(telegram: &mut Vec<u8>, random: &mut Random) {
    telegram.remove(random.below(telegram.len()));
}

fn truncate(telegram: &mut Vec<u8>, random: &mut Random) {
    telegram.truncate(random.below(telegram.len()));
}

fn swallow(telegram: &mut Vec<u8>, _: &mut Random) {
    telegram.retain(|byte| !matches!(byte, 0x11 | 0x13));
}

static KINDS: &[(&str, Noise)] = &[
    ("none", |stream, _, [request, response]| {
        stream.intact(&request);
        stream.intact(&response);
    }),
    ("garbage between", |stream, random, telegrams| {
        for telegram in telegrams {
            if random.below(4) == 0 {
                let count = random.below(40);
                let garbage = random.bytes(count);
                stream.noise(&garbage);
            }
            stream.intact(&telegram);
        }
    }),
    ("garbage like telegrams", |stream, random, telegrams| {
        for telegram in telegrams {
            if random.below(4) == 0 {
                // A unit and a function that are there, and a length that reaches far.
                let garbage = [telegram[0], telegram[1], random.of(&[0, 2, 4, 20, 250])];
                stream.noise(&garbage[..1 + random.below(3)]);
            }
            stream.intact(&telegram);
        }
    }),
    ("flipped bits", |stream, random, telegrams| damage(stream, random, telegrams, FLIP)),
    ("dropped bytes", |stream, random, telegrams| damage(stream, random, telegrams, drop_byte)),
    ("truncation", |stream, random, telegrams| damage(stream, random, telegrams, truncate)),
    ("beginnings lost", |stream, random, telegrams| {
        damage(stream, random, telegrams, |telegram, random| {
            telegram.drain(..random.below(telegram.len()));
        });
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
    ("missing requests", |stream, random, [request, response]| {
        if random.below(5) > 0 {
            stream.intact(&request);
        }
        stream.intact(&response);
    }),
    ("11h and 13h swallowed", |stream, random, telegrams| {
        for mut telegram in telegrams {
            let whole = telegram.len();
            swallow(&mut telegram, random);
            if telegram.len() == whole { stream.intact(&telegram) } else { stream.noise(&telegram) }
        }
    }),
    ("00 and FF of the line's turn", |stream, random, telegrams| {
        for telegram in telegrams {
            stream.intact(&telegram);
            let turn = random.of(&[&[][..], &[0], &[0xFF], &[0, 0], &[0xFE, 0xFF], &[0; 5]]);
            stream.noise(turn);
        }
    }),
    ("all of these", |stream, random, [request, response]| {
        let hows: [How; 4] = [FLIP, drop_byte, truncate, swallow];
        for (telegram, times) in [(&request, 1 + random.below(2)), (&response, random.below(5).min(1))] {
            for _ in 0..times {
                if random.below(20) == 0 {
                    let count = random.below(20);
                    let garbage = random.bytes(count);
                    stream.noise(&garbage);
                }
                let mut damaged = telegram.clone();
                if random.below(15) == 0 {
                    random.of(&hows)(&mut damaged, random);
                }
                if damaged == *telegram { stream.intact(telegram) } else { stream.noise(&damaged) }
            }
        }
    }),
];

fn binary() -> Reading {
    Reading { input: Input::Binary, ..Reading::default() }
}

/// The stream of a kind of noise.
fn stream(noise: Noise, seed: u64) -> Stream {
    let mut random = Random(seed);
    let mut stream = Stream::default();
    for n in 0..EXCHANGES {
        let most = if n % 20 == 0 { 60 } else { 6 };
        let telegrams = exchange_of(&mut random, FUNCTIONS, most).map(|sent: Sent| sent.rtu());
        noise(&mut stream, &mut random, telegrams);
    }
    stream
}

#[test]
fn what_is_intact_is_found_and_nothing_is_invented() {
    let mut failed = Vec::new();
    println!(
        "{:30} {:>9} {:>9} {:>9} {:>9} {:>10}",
        "noise", "intact", "found", "invented", "by chance", "found"
    );
    // More streams of each kind, where somebody wants them: SEEDS=20.
    let seeds = std::env::var("SEEDS").map_or(1, |seeds| seeds.parse().expect("a number"));
    for (kind, (name, noise)) in KINDS.iter().enumerate() {
        let (mut intact, mut found, mut chance, mut invented) = (0, 0, 0, 0);
        for seed in 0..seeds {
            let stream = stream(*noise, seed * 1000 + kind as u64 + 1);
            let log = Log::read(&stream.bytes, &binary(), Options::default()).unwrap();
            let right: Vec<(usize, usize)> = log
                .entries()
                .iter()
                .filter(|entry| entry.verdict == Verdict::Right && entry.role != Role::Discarded)
                .map(|entry| (entry.offset as usize, entry.length.into()))
                .collect();
            intact += stream.intact.len();
            found += stream.intact.iter().filter(|place| right.binary_search(place).is_ok()).count();
            for place in right.iter().filter(|place| stream.intact.binary_search(place).is_err()) {
                match by_chance(&stream, *place) {
                    true => chance += 1,
                    false => invented += 1,
                }
            }
        }
        let share = found as f64 / intact as f64;
        println!("{name:30} {intact:>9} {found:>9} {invented:>9} {chance:>9} {:>9.4} %", share * 100.0);
        if share < 0.9995 || invented * 10_000 > intact || chance * 1000 > intact {
            failed.push(*name);
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

/// Whether a right run of bytes that was not sent as a telegram is one all the same to everybody who
/// listens: it begins in noise. Who begins inside an intact telegram, or ends it elsewhere, is wrong.
fn by_chance(stream: &Stream, (at, length): (usize, usize)) -> bool {
    let (body, check) = stream.bytes[at..at + length].split_at(length - 2);
    stream.in_noise(at) && CRC_16_MODBUS.wire(body) == u64::from(u16::from_be_bytes([check[0], check[1]]))
}

/// However the bytes come in, the telegrams are the same.
#[test]
fn pieces_of_any_size_give_the_same_telegrams() {
    for (kind, (name, noise)) in KINDS.iter().enumerate() {
        let Stream { bytes, .. } = stream(*noise, kind as u64 + 50);
        let bytes = &bytes[..20_000];
        let whole = Log::read(bytes, &binary(), Options::default()).unwrap();
        for size in [1, 7, 64, 4096] {
            let mut log = Log::open(bytes, bytes.len() as u64, &binary(), Options::default()).unwrap();
            bytes.chunks(size).for_each(|part| assert!(log.push(part)));
            log.finish();
            let places = |log: &Log| -> Vec<_> {
                log.entries().iter().map(|it| (it.offset, it.length, it.verdict, it.role)).collect()
            };
            assert_eq!(places(&log), places(&whole), "{name} in pieces of {size}");
        }
    }
}

/// The same exchanges over TCP, where nothing is checked: frames with bytes lost or put between.
#[test]
fn frames_of_tcp_are_found_again_after_noise() {
    let mut random = Random(5);
    let mut stream = Stream::default();
    for n in 0..EXCHANGES {
        let telegrams = exchange_of(&mut random, FUNCTIONS, 6);
        for telegram in telegrams.map(|sent: Sent| sent.tcp(n as u16)) {
            match random.below(20) {
                0 => {
                    let count = random.below(30);
                    let garbage = random.bytes(count);
                    stream.noise(&garbage);
                    stream.intact(&telegram);
                }
                1 => stream.noise(&telegram[1 + random.below(telegram.len() - 1)..]),
                _ => stream.intact(&telegram),
            }
        }
    }
    let log = Log::read(&stream.bytes, &binary(), Options::default()).unwrap();
    let found: Vec<(usize, usize)> = log
        .entries()
        .iter()
        .filter(|entry| entry.role != Role::Discarded)
        .map(|entry| (entry.offset as usize, entry.length.into()))
        .collect();
    let intact = stream.intact.iter().filter(|place| found.binary_search(place).is_ok()).count();
    let others = found.iter().filter(|place| stream.intact.binary_search(place).is_err());
    let (chance, invented): (Vec<&(usize, usize)>, Vec<_>) = others.partition(|(at, _)| stream.in_noise(*at));
    let all = stream.intact.len();
    println!("over TCP: {intact} of {all} found, {} invented, {} by chance", invented.len(), chance.len());
    assert!(intact as f64 / all as f64 >= 0.9995);
    assert!(invented.len() * 10_000 <= all && chance.len() * 1000 <= all);
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
        let log = Log::read(&stream, &binary(), Options::default()).unwrap();
        let mut at = 0;
        for entry in log.entries() {
            assert_eq!(entry.offset as usize, at);
            at += usize::from(entry.length);
        }
        assert_eq!(at, stream.len());
    }
}

//! The data: the same in each run.

#[path = "../../crates/buslens/tests/logs/generator.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod generator;

use generator::{Random, Sent, exchange_of};

/// Where telegrams begin, and how long they are.
pub type Spans = Vec<(usize, usize)>;

pub struct Data {
    /// Telegrams of Modbus RTU, one behind the other.
    pub stream: Vec<u8>,
    /// The same with noise between some, and bits turned in others; where the intact ones are.
    pub noise: (Vec<u8>, Spans),
    /// Telegrams of Modbus TCP: answers out of order, functions that nobody knows, and random contents.
    pub odd: (Vec<u8>, Spans),
}

/// Functions that all know.
const FUNCTIONS: &[u8] = &[1, 2, 3, 3, 3, 4, 5, 6, 15, 16];
const MOST_REGISTERS: usize = 16;

impl Data {
    pub fn new() -> Self {
        let stream = telegrams(2026, 200_000);
        Self { stream: stream.iter().flat_map(Sent::rtu).collect(), noise: noise(), odd: odd() }
    }
}

fn telegrams(seed: u64, count: usize) -> Vec<Sent> {
    let mut random = Random(seed);
    (0..count / 2).flat_map(|_| exchange_of(&mut random, FUNCTIONS, MOST_REGISTERS)).collect()
}

fn noise() -> (Vec<u8>, Spans) {
    const TELEGRAMS: usize = 10_000;
    let mut random = Random(7);
    let (mut bytes, mut spans) = (Vec::new(), Vec::new());
    for sent in telegrams(77, TELEGRAMS) {
        if random.below(3) == 0 {
            let count = 1 + random.below(20);
            bytes.extend(random.bytes(count));
        }
        let mut telegram = sent.rtu();
        match random.below(20) {
            0 => {
                let at = random.below(telegram.len());
                telegram[at] ^= 1 << random.below(8);
            }
            _ => spans.push((bytes.len(), telegram.len())),
        }
        bytes.extend(telegram);
    }
    (bytes, spans)
}

fn odd() -> (Vec<u8>, Spans) {
    const EXCHANGES: usize = 2000;
    let mut random = Random(99);
    let (mut bytes, mut spans) = (Vec::new(), Vec::new());
    let mut late: Option<Vec<u8>> = None;
    let mut add = |telegram: Vec<u8>| {
        spans.push((bytes.len(), telegram.len()));
        bytes.extend(telegram);
    };
    for n in 0..EXCHANGES {
        let [mut request, mut response] = exchange_of(&mut random, FUNCTIONS, MOST_REGISTERS);
        match random.below(4) {
            // A function that nobody knows, of any content.
            0 => {
                request.body = [vec![1, 65 + random.below(8) as u8], random.bytes(4)].concat();
                response.body = [request.body[..2].to_vec(), random.bytes(6)].concat();
            }
            // Known functions with any content.
            1 => {
                let count = random.below(12);
                request.body.truncate(2);
                request.body.extend(random.bytes(count));
            }
            _ => {}
        }
        let transaction = n as u16;
        add(request.tcp(transaction));
        match late.take() {
            // The answer before comes behind the next one.
            Some(before) => {
                add(response.tcp(transaction));
                add(before);
            }
            None if random.below(5) == 0 && n + 1 < EXCHANGES => late = Some(response.tcp(transaction)),
            None => add(response.tcp(transaction)),
        }
    }
    (bytes, spans)
}

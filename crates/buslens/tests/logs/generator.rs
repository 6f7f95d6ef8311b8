//! Telegrams to write into logs, the same for the same seed.

use buslens::field::Direction;
use buslens::walk::{CRC_16_MODBUS, LRC};

/// A telegram and who sends it.
#[derive(Clone, Debug, PartialEq)]
pub struct Sent {
    pub direction: Direction,
    /// Unit, function and data, without check or header.
    pub body: Vec<u8>,
}

impl Sent {
    pub fn rtu(&self) -> Vec<u8> {
        let check = CRC_16_MODBUS.wire(&self.body) as u16;
        [self.body.as_slice(), &check.to_be_bytes()].concat()
    }

    pub fn ascii(&self) -> Vec<u8> {
        [self.body.as_slice(), &[LRC.wire(&self.body) as u8]].concat()
    }

    /// In a frame of Modbus TCP with this transaction.
    pub fn tcp(&self, transaction: u16) -> Vec<u8> {
        let head = [transaction, 0, self.body.len() as u16].map(u16::to_be_bytes).concat();
        [head, self.body.clone()].concat()
    }
}

/// Random numbers: splitmix64.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    pub fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    pub fn bytes(&mut self, count: usize) -> Vec<u8> {
        (0..count).map(|_| self.next() as u8).collect()
    }
}

/// The functions of [`exchange`], the usual ones more often.
pub const FUNCTIONS: &[u8] = &[1, 2, 3, 3, 3, 4, 5, 6, 15, 16, 23, 100, 101];

/// A request and its response: reads and writes of registers and coils, KEB's long ones, refusals.
pub fn exchange(random: &mut Random) -> [Sent; 2] {
    exchange_of(random, FUNCTIONS, 5)
}

/// The same with one of these functions and at most so many registers.
pub fn exchange_of(random: &mut Random, functions: &[u8], most: usize) -> [Sent; 2] {
    let unit = random.of(&[1, 2, 5, 17, 247]);
    let function = random.of(functions);
    let start = random.of(&[0_u16, 200, 215, 1240, 3216, 8242, 24320, 773]).to_be_bytes();
    let count = 1 + random.below(most);
    let quantity = (count as u16).to_be_bytes();
    let width = if function >= 100 { 4 } else { 2 };
    let data = values(random, count * width);
    let one = values(random, 2);
    let coils = random.bytes(count.div_ceil(8));
    let head = [unit, function];
    let counted = |data: &[u8]| [&head[..], &[data.len() as u8], data].concat();
    let asks = [&head[..], &start, &quantity].concat();
    let (request, response) = match function {
        1 | 2 => (asks, counted(&coils)),
        3 | 4 | 100 => (asks, counted(&data)),
        5 => {
            let both = [&head[..], &start, &[random.of(&[0, 0xFF]), 0]].concat();
            (both.clone(), both)
        }
        6 => {
            let both = [&head[..], &start, &one].concat();
            (both.clone(), both)
        }
        15 => ([&head[..], &start, &quantity, &[coils.len() as u8], &coils].concat(), asks.clone()),
        23 => {
            let writes =
                [&head[..], &start, &quantity, &start, &quantity, &[data.len() as u8], &data].concat();
            (writes, counted(&data))
        }
        _ => ([&head[..], &start, &quantity, &[data.len() as u8], &data].concat(), asks.clone()),
    };
    let response =
        if random.below(8) == 0 { vec![unit, function | 0x80, random.of(&[1, 2, 3, 4])] } else { response };
    [
        Sent { direction: Direction::Request, body: request },
        Sent { direction: Direction::Response, body: response },
    ]
}

/// Bytes of registers: as devices have them, most are small numbers, and many 0.
fn values(random: &mut Random, count: usize) -> Vec<u8> {
    let most = random.of(&[0, 1, 4, 16]);
    random
        .bytes(count)
        .iter()
        .enumerate()
        .map(|(at, byte)| if at % 4 < most || most > 4 { *byte } else { 0 })
        .collect()
}

/// Some exchanges, one after the other.
pub fn exchanges(seed: u64, count: usize) -> Vec<Sent> {
    let mut random = Random(seed);
    (0..count).flat_map(|_| exchange(&mut random)).collect()
}

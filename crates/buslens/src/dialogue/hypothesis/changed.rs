//! Bytes with other values or in another order.

use super::crc::{before, between, needed, step};
use super::{Cause, Search};

impl Search<'_> {
    /// Digits, bytes and words in the wrong order.
    pub(super) fn exchanged(&mut self) {
        let length = self.bytes.len();
        let body = length - 2;
        for at in 0..body {
            let mut digits = self.bytes.to_vec();
            digits[at] = digits[at].rotate_left(4);
            self.attempt(Cause::DigitsSwapped, at, digits, 2 * body);
            // The last digit of a byte and the first one of the next.
            let mut digits = self.bytes.to_vec();
            let (one, next) = (digits[at], digits[at + 1]);
            digits[at] = one & 0xF0 | next >> 4;
            digits[at + 1] = one << 4 | next & 0x0F;
            self.attempt(Cause::DigitsSwapped, at, digits, 2 * body);
            let mut neighbours = self.bytes.to_vec();
            neighbours.swap(at, at + 1);
            self.attempt(Cause::BytesSwapped, at, neighbours, body);
        }
        // All of it, or the registers: behind function code and address, or behind a byte count.
        for (from, to) in [(0, length), (3, body), (2, body), (7, body)] {
            let mut words = self.bytes.to_vec();
            if let Some(part) = words.get_mut(from..to) {
                part.chunks_exact_mut(2).for_each(|word| word.swap(0, 1));
                self.attempt(Cause::WordsSwapped, from, words, 4);
            }
        }
    }

    /// A digit that was lost in typing: a byte has one left, or all digits behind it moved by one.
    pub(super) fn digit_lost(&mut self) {
        /// Longer ones nobody types.
        const LONGEST: usize = 60;
        let length = self.bytes.len();
        for at in (0..length).filter(|at| self.bytes[*at] < 16) {
            let left = self.bytes[at];
            for digit in 0..16 {
                for byte in [left << 4 | digit, digit << 4 | left] {
                    let mut bytes = self.bytes.to_vec();
                    bytes[at] = byte;
                    self.attempt(Cause::DigitLost, at, bytes, 31 * length);
                }
            }
        }
        if length > LONGEST {
            return;
        }
        // The last digit is left over, and so unknown as well.
        let digits: Vec<u8> = self.bytes.iter().flat_map(|byte| [byte >> 4, byte & 15]).collect();
        for at in 0..=digits.len() {
            for lost in 0..16 {
                let front = digits[..at].iter().copied().chain([lost]);
                let all: Vec<u8> = front.chain(digits[at..].iter().copied()).collect();
                let whole = all.chunks_exact(2).map(|pair| pair[0] << 4 | pair[1]);
                let start: Vec<u8> = whole.collect();
                let state = start.iter().fold(0xFFFF, |crc, byte| step(crc, *byte));
                // One digit is left; with the right last one, the check comes out right.
                let high = all.last().copied().unwrap_or_default() << 4;
                if let Some(last) = between(state, 0).filter(|byte| byte & 0xF0 == high) {
                    self.attempt(
                        Cause::DigitLost,
                        at / 2,
                        [start.as_slice(), &[last]].concat(),
                        512 * length,
                    );
                }
            }
        }
    }

    /// One byte with another value. It is not searched by trial: what has to stand before a byte and
    /// behind it tells the byte.
    pub(super) fn changed(&mut self) {
        let length = self.bytes.len();
        let (before, needed) = (before(self.bytes), needed(self.bytes));
        for at in 0..length - 2 {
            let Some(byte) = between(before[at], needed[at + 1]) else { continue };
            let error = byte ^ self.bytes[at];
            if error == 0 {
                continue;
            }
            let mut bytes = self.bytes.to_vec();
            bytes[at] = byte;
            let (cause, tries) = match error.count_ones() {
                1 => (Cause::BitFlipped, 8 * length),
                _ => (Cause::ByteChanged, 255 * length),
            };
            self.add(cause, at, bytes, Some(tries));
        }
    }
}

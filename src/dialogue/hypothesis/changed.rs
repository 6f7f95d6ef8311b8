//! Bytes with other values or in another order.

use super::crc::{before, between, needed};
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
            if at + 1 < body {
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

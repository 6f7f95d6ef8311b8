//! Checks of one byte, a sum: of Modbus ASCII and PROFIBUS. One in 256 telegrams fits by chance, so that
//! little can be told from the check alone.

use super::{Cause, Search};
use crate::frame::{Protocol, Verdict, profibus_fdl};

impl Search<'_> {
    /// What makes the check of a telegram of `protocol` right.
    pub(super) fn sum(&mut self, protocol: &'static Protocol) {
        /// Longer telegrams fit by chance anyhow.
        const LONGEST: usize = 120;
        let length = self.bytes.len();
        if length < 3 {
            return;
        }
        let right = |bytes: &[u8]| (protocol.verdict)(bytes) == Verdict::Right;
        // The last byte of Modbus ASCII, the one before the end of PROFIBUS.
        for place in [length - 1, length - 2] {
            let mut bytes = self.bytes.to_vec();
            if let Some(value) = (0..=255).find(|value| {
                bytes[place] = *value;
                right(&bytes)
            }) {
                bytes[place] = value;
                self.add(Cause::CheckWrong, place, bytes, None);
                break;
            }
        }
        if length > LONGEST {
            return;
        }
        for at in 0..length {
            for bit in 0..8 {
                let mut bytes = self.bytes.to_vec();
                bytes[at] ^= 1 << bit;
                if right(&bytes) {
                    self.add(Cause::BitFlipped, at, bytes, Some(8 * length));
                }
            }
            let mut digits = self.bytes.to_vec();
            digits[at] = digits[at].rotate_left(4);
            if right(&digits) {
                self.add(Cause::DigitsSwapped, at, digits, Some(length));
            }
            let without = [&self.bytes[..at], &self.bytes[at + 1..]].concat();
            if right(&without) {
                let doubled = self.bytes.get(at + 1) == Some(&self.bytes[at]);
                let cause = if doubled { Cause::ByteDoubled } else { Cause::ByteExtra };
                self.add(cause, at, without, Some(length));
            }
        }
        let check = if protocol.is(&profibus_fdl::PROTOCOL) { length - 2 } else { length - 1 };
        self.missing_of_sum(check, right);
    }

    /// A byte that was lost before `check`. Some byte always fits at each place: only a length or a byte count can
    /// tell that one is missing, and where.
    fn missing_of_sum(&mut self, check: usize, right: impl Fn(&[u8]) -> bool) {
        let bytes = self.bytes;
        let with = |at: usize, byte: u8| [&bytes[..at], &[byte], &bytes[at..]].concat();
        let Some(byte) = (0..=255).find(|byte| right(&with(check, *byte))) else { return };
        for at in 1..=check {
            let whole = with(at, byte);
            // Beside its like, it is the same wherever it was.
            if bytes[at - 1] != byte && right(&whole) {
                self.add(Cause::ByteMissing, at, whole, Some(self.checks * bytes.len()));
            }
        }
    }
}

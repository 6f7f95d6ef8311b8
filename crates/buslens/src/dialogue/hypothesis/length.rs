//! Bytes that are too much or missing.

use super::crc::{before, between, needed, step};
use super::{Cause, Search};

/// The bytes of software flow control: XON and XOFF.
const FLOW: [u8; 2] = [0x11, 0x13];

impl Search<'_> {
    /// Bytes that are too much: inside, in front, behind.
    pub(super) fn removed(&mut self) {
        let length = self.bytes.len();
        let (before, needed) = (before(self.bytes), needed(self.bytes));
        for (count, cause) in [(1, Cause::ByteExtra), (2, Cause::RegisterExtra)] {
            for at in 0..=length - count {
                if before[at] == needed[at + count] {
                    let without = [&self.bytes[..at], &self.bytes[at + count..]].concat();
                    let doubled = count == 1 && self.bytes.get(at + 1) == Some(&self.bytes[at]);
                    self.attempt(if doubled { Cause::ByteDoubled } else { cause }, at, without, length);
                }
            }
        }
        let turn =
            |bytes: &[u8]| bytes.len() <= 3 && bytes.iter().all(|byte| matches!(byte, 0 | 0xFE | 0xFF));
        for (end, state) in before.iter().enumerate().take(length).skip(4) {
            if *state == 0 {
                let (kept, rest) = self.bytes.split_at(end);
                let (cause, tries) =
                    if turn(rest) { (Cause::LineTurn, 6) } else { (Cause::TrailingBytes, length) };
                self.add(cause, end, kept.to_vec(), Some(tries));
            }
        }
        for (from, state) in needed.iter().enumerate().take(length - 3).skip(1) {
            if *state == 0xFFFF {
                let (rest, kept) = self.bytes.split_at(from);
                let (cause, tries) =
                    if turn(rest) { (Cause::LineTurn, 6) } else { (Cause::LeadingBytes, length) };
                self.add(cause, from, kept.to_vec(), Some(tries));
            }
        }
    }

    /// Bytes that are missing: one of any value, or a register of a common one.
    pub(super) fn missing(&mut self) {
        let length = self.bytes.len();
        let (before, needed) = (before(self.bytes), needed(self.bytes));
        let with = |at: usize, bytes: &[u8]| [&self.bytes[..at], bytes, &self.bytes[at..]].concat();
        let mut found = Vec::new();
        for at in 0..=length {
            if let Some(byte) = between(before[at], needed[at]) {
                found.push((Cause::ByteMissing, at, with(at, &[byte]), 256 * length));
            }
            for register in [[0, 0], [0, 0x80]] {
                let state = register.iter().fold(before[at], |crc, byte| step(crc, *byte));
                if state == needed[at] {
                    found.push((Cause::RegisterMissing, at, with(at, &register), 2 * length));
                }
            }
        }
        for (cause, at, bytes, tries) in found {
            self.add(cause, at, bytes, Some(tries));
        }
    }

    /// Bytes 11h or 13h that were swallowed: up to three of them.
    pub(super) fn flow_control(&mut self) {
        /// More places would take too long, and would fit by chance.
        const MOST: [usize; 3] = [300, 120, 24];
        // A byte of flow control that is there was not swallowed.
        if self.bytes.iter().any(|byte| FLOW.contains(byte)) {
            return;
        }
        let (before, needed) = (before(self.bytes), needed(self.bytes));
        let mut found = Vec::new();
        for count in 1..=MOST.len() {
            if self.bytes.len() <= MOST[count - 1] {
                let ways = 2 * (self.bytes.len() + 1).pow(count as u32);
                let mut places = Vec::new();
                insert(self.bytes, &needed, (0, before[0]), count, &mut places, &mut |places| {
                    found.push((places.to_vec(), ways));
                });
            }
        }
        for (places, ways) in found {
            let mut bytes = self.bytes.to_vec();
            for (at, byte) in places.iter().rev() {
                bytes.insert(*at, *byte);
            }
            self.add(Cause::FlowControl, places[0].0, bytes, Some(ways));
        }
    }
}

/// Takes places with the bytes to put there.
type Found<'a> = &'a mut dyn FnMut(&[(usize, u8)]);

/// Tries to put `count` bytes of flow control into `bytes` from a place on, where the CRC has a
/// value; `found` gets the places and bytes that make the check right.
fn insert(
    bytes: &[u8],
    needed: &[u16],
    (from, mut crc): (usize, u16),
    count: usize,
    places: &mut Vec<(usize, u8)>,
    found: Found<'_>,
) {
    for at in from..=bytes.len() {
        for byte in FLOW {
            let state = step(crc, byte);
            places.push((at, byte));
            if count == 1 {
                if state == needed[at] {
                    found(places);
                }
            } else {
                insert(bytes, needed, (at, state), count - 1, places, found);
            }
            places.pop();
        }
        if let Some(byte) = bytes.get(at) {
            crc = step(crc, *byte);
        }
    }
}

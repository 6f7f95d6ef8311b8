//! The check itself.

use super::{Cause, Search};
use crate::walk::CRC_16_MODBUS;

/// A CRC of 16 bits: polynomial and start, and whether it goes from the lowest bit on.
struct Kind {
    name: &'static str,
    polynomial: u16,
    start: u16,
    reflected: bool,
    inverted: bool,
}

/// The CRCs that are taken for that of Modbus, by their names in the catalogue of CRCs.
const KINDS: [Kind; 8] = [
    Kind { name: "CRC-16/ARC (start 0000h)", polynomial: 0x8005, start: 0, reflected: true, inverted: false },
    Kind {
        name: "CRC-16/USB (inverted)",
        polynomial: 0x8005,
        start: 0xFFFF,
        reflected: true,
        inverted: true,
    },
    Kind {
        name: "CRC-16/CMS (not reflected)",
        polynomial: 0x8005,
        start: 0xFFFF,
        reflected: false,
        inverted: false,
    },
    Kind { name: "CRC-16/XMODEM", polynomial: 0x1021, start: 0, reflected: false, inverted: false },
    Kind { name: "CRC-16/CCITT-FALSE", polynomial: 0x1021, start: 0xFFFF, reflected: false, inverted: false },
    Kind { name: "CRC-16/KERMIT", polynomial: 0x1021, start: 0, reflected: true, inverted: false },
    Kind { name: "CRC-16/X-25", polynomial: 0x1021, start: 0xFFFF, reflected: true, inverted: true },
    Kind { name: "CRC-16/DNP", polynomial: 0x3D65, start: 0, reflected: true, inverted: true },
];

impl Kind {
    fn of(&self, bytes: &[u8]) -> u16 {
        let crc = bytes.iter().fold(self.start, |crc, byte| {
            if self.reflected {
                let polynomial = self.polynomial.reverse_bits();
                (0..8).fold(crc ^ u16::from(*byte), |crc, _| {
                    if crc & 1 == 1 { crc >> 1 ^ polynomial } else { crc >> 1 }
                })
            } else {
                (0..8).fold(crc ^ u16::from(*byte) << 8, |crc, _| {
                    if crc >> 15 == 1 { crc << 1 ^ self.polynomial } else { crc << 1 }
                })
            }
        });
        if self.inverted { !crc } else { crc }
    }
}

impl Search<'_> {
    /// What happens to the check.
    pub(super) fn check(&mut self) {
        let place = self.bytes.len() - 2;
        let (body, check) = self.bytes.split_at(place);
        let found = [check[0], check[1]];
        let with_check = |body: &[u8]| {
            let check = CRC_16_MODBUS.wire(body) as u16;
            [body, &check.to_be_bytes()].concat()
        };
        let right = with_check(body);
        let swapped = [body, &[found[1], found[0]]].concat();
        self.attempt(Cause::CheckSwapped, place, swapped, 1);
        let inner = CRC_16_MODBUS.wire(&body[1..]) as u16;
        if inner.to_be_bytes() == found || inner.to_le_bytes() == found {
            self.add(Cause::CheckWithoutAddress, place, right.clone(), Some(2));
        }
        for kind in &KINDS {
            let other = kind.of(body);
            if other.to_be_bytes() == found || other.to_le_bytes() == found {
                self.add(Cause::CheckOfOtherKind(kind.name), place, right.clone(), Some(2 * KINDS.len()));
            }
        }
        let others = self.context.others;
        if others.iter().any(|other| other.len() > 4 && *other != self.bytes && other.ends_with(&found)) {
            self.add(Cause::CheckCopied, place, right.clone(), Some(others.len()));
        }
        let [high, low] = [right[place] ^ found[0], right[place + 1] ^ found[1]];
        let difference = u16::from_be_bytes([high, low]);
        let one_digit = (0..4).any(|digit| difference & !(0xF << (4 * digit)) == 0);
        match (one_digit, difference.count_ones()) {
            (_, 1) => self.add(
                Cause::BitFlipped,
                if high != 0 { place } else { place + 1 },
                right,
                Some(8 * self.bytes.len()),
            ),
            (true, _) => self.add(Cause::CheckDigit, place, right, Some(4 * 15)),
            (false, _) => self.add(Cause::CheckWrong, place, right, None),
        }
        self.add(Cause::CheckMissing, self.bytes.len(), with_check(self.bytes), None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_check_values_of_the_catalogue() {
        let values = [0xBB3D, 0xB4C8, 0xAEE7, 0x31C3, 0x29B1, 0x2189, 0x906E, 0xEA82];
        for (kind, value) in KINDS.iter().zip(values) {
            assert_eq!(kind.of(b"123456789"), value, "{}", kind.name);
        }
    }
}

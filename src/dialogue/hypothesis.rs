use crate::field::{Message, hex, hex_value};
use crate::message;
use crate::walk::CRC_16_MODBUS;

/// What may have happened to a Modbus RTU telegram whose check does not match.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hypothesis {
    pub cause: Cause,
    /// The first byte that is not as it should be.
    pub place: usize,
    /// The telegram as it would be.
    pub bytes: Vec<u8>,
    /// How many telegrams were tried in search of this one; `None` where one always fits.
    pub tries: Option<usize>,
}

/// What can happen to a telegram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    CheckSwapped,
    /// The check differs in one hex digit.
    CheckDigit,
    CheckWrong,
    CheckMissing,
    BitFlipped,
    DigitsSwapped,
    BytesSwapped,
    ByteChanged,
    ByteDoubled,
    ByteExtra,
    RegisterExtra,
    ByteMissing,
    RegisterMissing,
    TrailingBytes,
}

impl Cause {
    /// The stable word of exports.
    pub const fn key(self) -> &'static str {
        match self {
            Self::CheckSwapped => "check-swapped",
            Self::CheckDigit => "check-digit",
            Self::CheckWrong => "check-wrong",
            Self::CheckMissing => "check-missing",
            Self::BitFlipped => "bit-flipped",
            Self::DigitsSwapped => "digits-swapped",
            Self::BytesSwapped => "bytes-swapped",
            Self::ByteChanged => "byte-changed",
            Self::ByteDoubled => "byte-doubled",
            Self::ByteExtra => "byte-extra",
            Self::RegisterExtra => "register-extra",
            Self::ByteMissing => "byte-missing",
            Self::RegisterMissing => "register-missing",
            Self::TrailingBytes => "trailing-bytes",
        }
    }
}

impl Hypothesis {
    /// How likely such a telegram is found although nothing of the kind happened: "1 in 29".
    pub fn odds(&self) -> Message {
        match self.tries {
            Some(tries) if tries < CHECKS => message!("1 in {n}", n = CHECKS / tries.max(1)),
            _ => message!("always"),
        }
    }

    /// The cause in a sentence; `found` is the telegram as it came.
    pub fn text(&self, found: &[u8]) -> Message {
        let at = self.place;
        let byte = |bytes: &[u8]| bytes.get(at).map_or(String::new(), |byte| hex_value((*byte).into(), 1));
        let (was, is) = (byte(found), byte(&self.bytes));
        match self.cause {
            Cause::CheckSwapped => message!("the two bytes of the check are swapped"),
            Cause::CheckDigit => {
                message!("one digit of the check is wrong: it would be {check}", check = self.check())
            }
            Cause::CheckWrong => {
                message!("the check is wrong: for these bytes it would be {check}", check = self.check())
            }
            Cause::CheckMissing => {
                message!("the check is missing: it would be {check}", check = self.check())
            }
            Cause::BitFlipped => {
                message!("a bit of byte {at} is flipped: {was} for {is}", at = at, was = was, is = is)
            }
            Cause::DigitsSwapped => {
                message!("the digits of byte {at} are swapped: {was} for {is}", at = at, was = was, is = is)
            }
            Cause::BytesSwapped => message!("bytes {at} and {next} are swapped", at = at, next = at + 1),
            Cause::ByteChanged => {
                message!("byte {at} is changed: {was} for {is}", at = at, was = was, is = is)
            }
            Cause::ByteDoubled => message!("byte {at} ({was}) is there twice", at = at, was = was),
            Cause::ByteExtra => message!("byte {at} ({was}) is too much", at = at, was = was),
            Cause::RegisterExtra => message!("bytes {at} and {next} are too much", at = at, next = at + 1),
            Cause::ByteMissing => message!("a byte {is} is missing before byte {at}", is = is, at = at),
            Cause::RegisterMissing => message!(
                "two bytes are missing before byte {at}; any two fit the check, {bytes} would make sense",
                at = at,
                bytes = hex(self.bytes.get(at..at + 2).unwrap_or_default())
            ),
            Cause::TrailingBytes => message!("the bytes from byte {at} on do not belong to it", at = at),
        }
    }

    fn check(&self) -> String {
        hex(self.bytes.split_at(self.bytes.len().saturating_sub(2)).1)
    }
}

/// How many checks there are.
const CHECKS: usize = 0x1_0000;

/// Telegrams longer than a frame can be are not looked at.
const LONGEST: usize = 300;

/// Everything that makes the check right, in no order. `bytes` is a frame with its check.
///
/// A changed or missing byte is not searched by trial: the check is linear, so that the difference
/// tells which byte at which place explains it.
pub fn hypotheses(bytes: &[u8]) -> Vec<Hypothesis> {
    let mut search = Search { found: Vec::new(), bytes };
    if (4..=LONGEST).contains(&bytes.len()) {
        search.check();
        search.exchanged();
        search.changed();
        search.removed();
        search.missing();
    }
    search.found
}

struct Search<'a> {
    bytes: &'a [u8],
    found: Vec<Hypothesis>,
}

impl Search<'_> {
    fn add(&mut self, cause: Cause, place: usize, bytes: Vec<u8>, tries: Option<usize>) {
        if bytes != self.bytes && !self.found.iter().any(|known| known.bytes == bytes && known.tries <= tries)
        {
            self.found.push(Hypothesis { cause, place, bytes, tries });
        }
    }

    /// Adds `bytes` if their check is right.
    fn attempt(&mut self, cause: Cause, place: usize, bytes: Vec<u8>, tries: usize) {
        if bytes.len() >= 4 && residue(&bytes) == 0 {
            self.add(cause, place, bytes, Some(tries));
        }
    }

    /// The check itself.
    fn check(&mut self) {
        let body = self.bytes.len() - 2;
        let with_check = |body: &[u8]| {
            let check = CRC_16_MODBUS.wire(body) as u16;
            [body, &check.to_be_bytes()].concat()
        };
        let swapped = [&self.bytes[..body], &[self.bytes[body + 1], self.bytes[body]]].concat();
        self.attempt(Cause::CheckSwapped, body, swapped, 1);
        let right = with_check(&self.bytes[..body]);
        let difference =
            (body..body + 2).fold(0_u16, |all, at| all << 8 | u16::from(right[at] ^ self.bytes[at]));
        let one_digit = (0..4).any(|digit| difference & !(0xF << (4 * digit)) == 0);
        match one_digit {
            true => self.add(Cause::CheckDigit, body, right, Some(4 * 15)),
            false => self.add(Cause::CheckWrong, body, right, None),
        }
        self.add(Cause::CheckMissing, self.bytes.len(), with_check(self.bytes), None);
    }

    /// Digits and bytes in the wrong order.
    fn exchanged(&mut self) {
        let body = self.bytes.len() - 2;
        for at in 0..body {
            let mut digits = self.bytes.to_vec();
            digits[at] = digits[at].rotate_left(4);
            self.attempt(Cause::DigitsSwapped, at, digits, body);
            let mut neighbours = self.bytes.to_vec();
            neighbours.swap(at, at + 1);
            if at + 1 < body {
                self.attempt(Cause::BytesSwapped, at, neighbours, body);
            }
        }
    }

    /// One byte with another value.
    fn changed(&mut self) {
        let length = self.bytes.len();
        let residue = residue(self.bytes);
        let mut effects: Vec<u16> = (0..=255).map(|byte| step(0, byte)).collect();
        for at in (0..length).rev() {
            for (error, effect) in effects.iter().enumerate() {
                if error > 0 && *effect == residue && at < length - 2 {
                    let mut bytes = self.bytes.to_vec();
                    bytes[at] ^= error as u8;
                    let (cause, tries) = match error.count_ones() {
                        1 => (Cause::BitFlipped, 8 * length),
                        _ => (Cause::ByteChanged, 255 * length),
                    };
                    self.add(cause, at, bytes, Some(tries));
                }
            }
            effects.iter_mut().for_each(|effect| *effect = step(*effect, 0));
        }
    }

    /// Bytes that are too much.
    fn removed(&mut self) {
        let length = self.bytes.len();
        for (count, cause) in [(1, Cause::ByteExtra), (2, Cause::RegisterExtra)] {
            for at in 0..=length - count {
                let without = [&self.bytes[..at], &self.bytes[at + count..]].concat();
                let doubled = count == 1 && self.bytes.get(at + 1) == Some(&self.bytes[at]);
                self.attempt(if doubled { Cause::ByteDoubled } else { cause }, at, without, length);
            }
        }
        for end in 4..length - 2 {
            self.attempt(Cause::TrailingBytes, end, self.bytes[..end].to_vec(), length);
        }
    }

    /// Bytes that are missing: one of any value, or a register of a common one.
    fn missing(&mut self) {
        let length = self.bytes.len();
        let mut effects: Vec<u16> = (0..=255).map(|byte| step(0, byte)).collect();
        for at in (0..length - 1).rev() {
            // What stands behind the place moves the effect on by as many bytes.
            if at == length - 2 {
                effects.iter_mut().for_each(|effect| *effect = step(step(*effect, 0), 0));
            } else {
                effects.iter_mut().for_each(|effect| *effect = step(*effect, 0));
            }
            let with = |value: &[u8]| [&self.bytes[..at], value, &self.bytes[at..]].concat();
            let residue = residue(&with(&[0]));
            let values: Vec<u8> =
                (0..=255_u8).filter(|byte| effects[usize::from(*byte)] == residue).collect();
            let registers = [[0, 0], [0, 0x80]].map(|register| with(&register));
            for value in values {
                let bytes = with(&[value]);
                self.add(Cause::ByteMissing, at, bytes, Some(256 * length));
            }
            for bytes in registers {
                self.attempt(Cause::RegisterMissing, at, bytes, 2 * length);
            }
        }
    }
}

/// The CRC over a whole frame, which is 0 where its check is right.
fn residue(bytes: &[u8]) -> u16 {
    // 16 bits wide, so it fits.
    (CRC_16_MODBUS.compute)(bytes) as u16
}

/// One byte of CRC-16/MODBUS.
fn step(crc: u16, byte: u8) -> u16 {
    (0..8).fold(crc ^ u16::from(byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(hex: &str) -> Vec<u8> {
        hex.split(' ').map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
    }

    fn causes(found: &str, right: &str) -> Vec<Cause> {
        let right = bytes(right);
        let all = hypotheses(&bytes(found));
        assert!(all.iter().all(|one| residue(&one.bytes) == 0));
        all.into_iter().filter(|one| one.bytes == right).map(|one| one.cause).collect()
    }

    #[test]
    fn each_cause_is_found() {
        const RIGHT: &str = "01 03 00 C8 00 03 84 35";
        for (found, cause) in [
            ("01 03 00 C8 00 03 35 84", Cause::CheckSwapped),
            ("01 03 00 C8 00 03 84 36", Cause::CheckDigit),
            ("01 03 00 C8 00 03 12 34", Cause::CheckWrong),
            ("01 03 00 C8 00 03", Cause::CheckMissing),
            ("01 03 00 C8 00 02 84 35", Cause::BitFlipped),
            ("01 03 00 8C 00 03 84 35", Cause::DigitsSwapped),
            ("01 03 C8 00 00 03 84 35", Cause::BytesSwapped),
            ("01 03 00 C8 00 7E 84 35", Cause::ByteChanged),
            ("01 03 03 00 C8 00 03 84 35", Cause::ByteDoubled),
            ("01 03 00 C8 55 00 03 84 35", Cause::ByteExtra),
            ("01 03 00 C8 55 AA 00 03 84 35", Cause::RegisterExtra),
            ("01 03 C8 00 03 84 35", Cause::ByteMissing),
            ("01 03 00 C8 00 03 84 35 11 22 33", Cause::TrailingBytes),
        ] {
            assert!(causes(found, RIGHT).contains(&cause), "{found}: {:?}", causes(found, RIGHT));
        }
        let status_missing = "01 03 0A 40 19 33 33 39 80 00 00 C5 32";
        let right = "01 03 0A 00 80 40 19 33 33 39 80 00 00 C5 32";
        assert!(causes(status_missing, right).contains(&Cause::RegisterMissing));
    }

    #[test]
    fn odds_are_said_in_words() {
        let one = |tries| Hypothesis { cause: Cause::ByteChanged, place: 0, bytes: Vec::new(), tries };
        assert_eq!(one(Some(255 * 9)).odds().to_string(), "1 in 28");
        assert_eq!(one(Some(100_000)).odds().to_string(), "always");
        assert_eq!(one(None).odds().to_string(), "always");
    }
}

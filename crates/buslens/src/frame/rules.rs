//! The length rules of all functions, for streams: the usual kinds of rules are numbers here, so that
//! no branch depends on which function comes next.

use crate::field::Direction;
use crate::modbus::{Dialect, EXCEPTION, LONGEST_PDU, Length, Pdu};

/// How long the PDUs of a function are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules {
    pub request: Rule,
    pub response: Rule,
    /// How long the response to a request is.
    answer: Answer,
}

/// How long a PDU is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rule {
    /// So many bytes, and as many as the byte at `at` says, if `counts` is not 0.
    base: u8,
    at: u8,
    counts: u8,
    /// The bits that are 0 in numbers of whole units.
    part: u8,
    /// The rule, if it is none of the usual kinds.
    unusual: Option<&'static Length>,
}

/// How long a response is, by its request.
#[derive(Clone, Copy, Debug)]
struct Answer {
    known: bool,
    /// So many bytes, and `bits` for each item that is asked for.
    base: u8,
    bits: u8,
}

impl Rules {
    /// The rules of `function`, if it is known.
    pub fn of(function: u8, dialect: &'static Dialect) -> Option<Self> {
        let [request, response] = [Direction::Request, Direction::Response]
            .map(|direction| Pdu::kind(function, direction, dialect));
        let known = request.function == function && response.function == function && function > 0;
        known.then(|| Self {
            request: Rule::of(&request.length),
            response: Rule::of(&response.length),
            answer: Answer::of(request.length, response.length),
        })
    }

    /// How many bytes the PDU of the response to `request` has, if that follows from it.
    #[inline]
    pub fn answer_length(&self, request: &[u8]) -> Option<usize> {
        let Answer { known, base, bits } = self.answer;
        let quantity = match request {
            [_, _, _, high, low, ..] => usize::from(u16::from_be_bytes([*high, *low])),
            _ if bits == 0 => 0,
            _ => return None,
        };
        known.then(|| usize::from(base) + (quantity * usize::from(bits)).div_ceil(8))
    }

    /// Whether the response to a request can hold what is asked for, and there is something.
    pub fn can_be_answered(&self, request: &[u8]) -> bool {
        let length = self.answer_length(request).filter(|_| self.answer.bits > 0);
        length.is_none_or(|length| (3..=LONGEST_PDU).contains(&length))
    }
}

impl Rule {
    fn of(length: &'static Length) -> Self {
        let rule = |base: usize, at: usize, counts: u8, part: usize| Self {
            base: base as u8,
            at: at as u8,
            counts,
            part: part as u8,
            unusual: None,
        };
        match *length {
            Length::Fixed(base) => rule(base, 0, 0, 0),
            Length::Counted { at, unit } if unit.is_power_of_two() => rule(at + 1, at, 0xFF, unit - 1),
            _ => Self { unusual: Some(length), ..rule(0, 0, 0, 0) },
        }
    }

    /// See [`Length::of`].
    #[inline]
    pub fn length(&self, pdu: &[u8]) -> Option<usize> {
        if let Some(length) = self.unusual {
            return length.of(pdu);
        }
        pdu.get(usize::from(self.at)).map(|count| usize::from(self.base) + usize::from(count & self.counts))
    }

    /// Whether bytes behind `pdu` could tell the length that those of `pdu` do not.
    #[cold]
    pub fn can_be_told(&self, pdu: &[u8]) -> bool {
        self.unusual.is_none_or(|length| length.can_be_told(pdu))
    }

    /// See [`Length::fits`].
    #[inline]
    pub fn fits(&self, pdu: &[u8]) -> bool {
        if let Some(length) = self.unusual {
            return length.fits(pdu);
        }
        let Some(count) = pdu.get(usize::from(self.at)) else { return false };
        let count = count & self.counts;
        (pdu.len() == usize::from(self.base) + usize::from(count))
            & (count & self.part == 0)
            & ((count > 0) | (self.counts == 0))
    }
}

impl Answer {
    fn of(request: Length, response: Length) -> Self {
        let known = |base: usize, bits: usize| Self { known: true, base: base as u8, bits: bits as u8 };
        match (request, response) {
            (_, Length::Fixed(length)) => known(length, 0),
            // All functions that read so many items have their number in the same place. Items of one
            // byte are eight switches.
            (Length::Fixed(5) | Length::Counted { at: 9, .. }, Length::Counted { at: 1, unit }) => {
                known(2, if unit == 1 { 1 } else { 8 * unit })
            }
            _ => Self { known: false, base: 0, bits: 0 },
        }
    }
}

/// The rules of all function codes.
pub(super) fn all(dialect: &'static Dialect) -> Vec<Option<Rules>> {
    (0..EXCEPTION).map(|function| Rules::of(function, dialect)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_say_the_same_as_the_rules() {
        let mut bytes = [0_u8; 40];
        for seed in 0..4000_u32 {
            for (at, byte) in bytes.iter_mut().enumerate() {
                let mixed = (seed * 40 + at as u32).wrapping_mul(2_654_435_761) >> 17;
                *byte = if mixed & 0x100 == 0 { mixed as u8 & 15 } else { mixed as u8 };
            }
            let pdu = &bytes[..1 + seed as usize % 40];
            for length in &[
                Length::Fixed(5),
                Length::Counted { at: 1, unit: 1 },
                Length::Counted { at: 5, unit: 4 },
                Length::Counted { at: 1, unit: 7 },
                Length::CountedByTwo { at: 1, unit: 2 },
            ] {
                let rule = Rule::of(length);
                assert_eq!(rule.length(pdu), length.of(pdu), "{length:?} of {pdu:?}");
                assert_eq!(rule.fits(pdu), length.fits(pdu), "{length:?} of {pdu:?}");
            }
        }
    }
}

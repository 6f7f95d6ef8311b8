//! Finding telegrams in bytes that nothing parts.
//!
//! Where a telegram can begin, its length rule and its check have to agree. Both a request and a
//! response of a function can: a CRC stays right when zeros follow, so that a telegram may begin with
//! another one. The request that still waits decides then, and without one a request is expected.
//!
//! Looking at one place costs no more than the longest telegram has bytes, so that all of it takes
//! linear time, and nothing is allocated.

use super::modbus_serial::BROADCAST;
use super::profibus_fdl::{Fdl, SC, SD4};
use super::rules::{self, Rule, Rules};
use super::{Protocol, modbus_rtu, modbus_tcp, profibus_fdl};
use crate::field::Span;
use crate::modbus::{Dialect, EXCEPTION};
use crate::walk::crc_residue;

/// What begins at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begins {
    /// A telegram of so many bytes, with a right check.
    Telegram(usize),
    /// Perhaps a telegram, of which bytes are to come.
    More,
    Nothing,
}

/// The request that waits for its response.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Waiting {
    pub unit: u8,
    pub function: u8,
    /// How many bytes the response must have, if the request tells it.
    pub length: Option<u16>,
}

impl Waiting {
    /// What is waited for behind a telegram of a serial line, or one like it, of which its `function` and [`told`] say
    /// this.
    ///
    /// [`told`]: Splitter::told
    #[inline]
    pub fn behind(before: Option<&Self>, unit: u8, function: u8, told: Told) -> Option<Self> {
        let function = function & !EXCEPTION;
        let Told { known, sides: [asks, answers], answer } = told;
        // Of a function that is not known, nothing tells whether it asks.
        if !known && !asks && !answers {
            return Some(Self { unit, function, length: None });
        }
        let awaited = before.is_some_and(|it| (it.unit, it.function) == (unit, function));
        let length = answer.map(|length| (length + AROUND) as u16);
        (asks && !(answers && awaited)).then_some(Self { unit, function, length })
    }
}

/// What a PDU says.
#[derive(Clone, Copy, Debug, Default)]
pub struct Told {
    /// See [`Splitter::knows`].
    pub known: bool,
    /// See [`Splitter::sides`].
    pub sides: [bool; 2],
    /// See [`Splitter::answer_length`].
    pub answer: Option<usize>,
}

/// A frame of a stream, and what it says.
#[derive(Clone, Copy, Debug)]
pub struct Framed {
    pub length: u16,
    pub unit: u8,
    pub function: u8,
    /// See [`Splitter::sides`].
    pub sides: [bool; 2],
}

/// What each function's telegrams are long.
#[derive(Debug)]
pub struct Splitter {
    /// By function code; `None` for codes that are not known.
    rules: Vec<Option<Rules>>,
}

/// What is known where a telegram may begin.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// What comes from there on.
    pub bytes: &'a [u8],
    /// Nothing comes behind `bytes`.
    pub last: bool,
    /// A telegram ends just before it, or a pause.
    pub in_step: bool,
    pub waiting: Option<&'a Waiting>,
}

/// Whether the protocol's telegrams can be found in a stream.
pub fn can_split(protocol: &Protocol) -> bool {
    [&modbus_rtu::PROTOCOL, &modbus_tcp::PROTOCOL, &profibus_fdl::PROTOCOL]
        .into_iter()
        .any(|known| known.is(protocol))
}

impl Splitter {
    pub fn new(dialect: &'static Dialect) -> Self {
        Self { rules: rules::all(dialect) }
    }

    /// What of `protocol` begins at `place`.
    #[inline]
    pub fn begins(&self, protocol: &'static Protocol, place: Place<'_>) -> Begins {
        if protocol.is(&modbus_rtu::PROTOCOL) {
            self.rtu(place)
        } else if protocol.is(&modbus_tcp::PROTOCOL) {
            self.tcp(place)
        } else if protocol.is(&profibus_fdl::PROTOCOL) {
            fdl(place)
        } else {
            Begins::Nothing
        }
    }

    /// How many of `bytes` are telegrams of `protocol`, by themselves.
    pub fn covered(&self, protocol: &'static Protocol, bytes: &[u8]) -> usize {
        let (mut at, mut covered, mut in_step) = (0, 0, true);
        while at < bytes.len() {
            let place = Place { bytes: &bytes[at..], last: true, in_step, waiting: None };
            match self.begins(protocol, place) {
                Begins::Telegram(length) => (at, covered, in_step) = (at + length, covered + length, true),
                _ => (at, in_step) = (at + 1, false),
            }
        }
        covered
    }

    /// Whether `function`, without the bit of an exception, is known.
    pub fn knows(&self, function: u8) -> bool {
        self.rule(function & !EXCEPTION).is_some()
    }

    /// Whether a PDU has the length of a request, and that of a response.
    #[inline]
    pub fn sides(&self, pdu: &[u8]) -> [bool; 2] {
        match pdu.first() {
            Some(function) if function & EXCEPTION != 0 => [false, pdu.len() == 2],
            Some(function) => match self.rule(*function) {
                Some(rules) => [rules.request.fits(pdu), rules.response.fits(pdu)],
                None => [false, false],
            },
            None => [false, false],
        }
    }

    /// How many bytes the PDU of the response to a request has, if that follows from it.
    #[inline]
    pub fn answer_length(&self, request: &[u8]) -> Option<usize> {
        self.rule(*request.first()?)?.answer_length(request)
    }

    /// How many bytes the RTU frame would have that begins with `bytes`: as request, as response.
    pub fn rtu_lengths(&self, bytes: &[u8]) -> [Option<usize>; 2] {
        let Some(function) = bytes.get(1) else { return [None, None] };
        if function & EXCEPTION != 0 {
            return [None, Some(2 + AROUND)];
        }
        let whole = |rule: &Rule| rule.length(&bytes[1..]).map(|length| length + AROUND);
        self.rule(*function).map_or([None, None], |rules| [whole(&rules.request), whole(&rules.response)])
    }

    /// Whether an RTU frame that begins so may be longer than `bytes`.
    pub fn is_beginning(&self, bytes: &[u8]) -> bool {
        let whole = self.rtu_lengths(bytes);
        let known = bytes.get(1).is_some_and(|function| self.knows(*function));
        let told = |length: usize| length > bytes.len();
        let untold = || match self.rule(bytes[1]) {
            Some(rules) => [&rules.request, &rules.response]
                .into_iter()
                .zip(whole)
                .any(|(rule, length)| length.is_none() && is_to_be_told(rule, bytes)),
            None => false,
        };
        known
            && bytes.len() < modbus_rtu::RTU.longest()
            && (whole.into_iter().flatten().any(told) || untold())
    }

    /// The other length with which an RTU frame that is right with `length` is right, too.
    #[cold]
    pub fn other_length(&self, bytes: &[u8], length: usize) -> Option<usize> {
        let Rules { request, response, .. } = self.rule(*bytes.get(1)?)?;
        [request, response].into_iter().find_map(|rule| {
            let other = rule.length(&bytes[1..])? + AROUND;
            let differs = other != length;
            (differs && right(bytes, Some(other), Some(rule), Begins::Nothing) == Begins::Telegram(other))
                .then_some(other)
        })
    }

    /// What a PDU says.
    #[inline]
    pub fn told(&self, pdu: &[u8]) -> Told {
        let Some(function) = pdu.first().copied() else { return Told::default() };
        match self.rule(function & !EXCEPTION) {
            rules if function & EXCEPTION != 0 => {
                Told { known: rules.is_some(), sides: [false, pdu.len() == 2], answer: None }
            }
            Some(rules) => Told {
                known: true,
                sides: [rules.request.fits(pdu), rules.response.fits(pdu)],
                answer: rules.answer_length(pdu),
            },
            None => Told::default(),
        }
    }

    /// Finds the RTU frames that follow each other from the beginning of `bytes` on, as [`begins`](Self::begins) does
    /// one by one; returns how many bytes they have. `waiting` is what is waited for, before them and behind.
    pub fn run(
        &self,
        bytes: &[u8],
        last: bool,
        waiting: &mut Option<Waiting>,
        found: &mut Vec<Framed>,
    ) -> usize {
        let (mut at, mut awaited) = (0, *waiting);
        loop {
            let place = Place { bytes: &bytes[at..], last, in_step: true, waiting: awaited.as_ref() };
            let Begins::Telegram(length) = self.rtu(place) else { break };
            let telegram = &bytes[at..at + length];
            let (unit, function) = (telegram[0], telegram[1]);
            let told = self.told(&telegram[1..length - 2]);
            awaited = Waiting::behind(awaited.as_ref(), unit, function, told);
            found.push(Framed { length: length as u16, unit, function, sides: told.sides });
            at += length;
        }
        *waiting = awaited;
        at
    }

    #[inline]
    fn rule(&self, function: u8) -> Option<&Rules> {
        self.rules.get(usize::from(function))?.as_ref()
    }

    #[inline]
    fn rtu(&self, place: Place<'_>) -> Begins {
        /// Addresses above are reserved.
        const HIGHEST_UNIT: u8 = 247;
        let Place { bytes, last, waiting, .. } = place;
        let more = if last { Begins::Nothing } else { Begins::More };
        let [unit, function, ..] = *bytes else { return more };
        if unit > HIGHEST_UNIT {
            return Begins::Nothing;
        }
        let awaited = waiting.filter(|it| it.unit == unit && it.function == function & !EXCEPTION);
        let Some(rules) = self.rule(function & !EXCEPTION) else { return Begins::Nothing };
        if function & EXCEPTION != 0 {
            return match unit {
                BROADCAST if awaited.is_none() => Begins::Nothing,
                _ => right(bytes, Some(2 + AROUND), None, more),
            };
        }
        let Rules { request, response, .. } = rules;
        let pdu = &bytes[1..];
        let whole = |rule: &Rule| rule.length(pdu).map(|length| length + AROUND);
        let (asks, answers) = (whole(request), whole(response).filter(|_| unit != BROADCAST));
        if awaited.is_some() && answers.is_none() && !last && is_to_be_told(response, bytes) {
            return more;
        }
        // No telegram is longer than the one that is awaited, and none has another length.
        let answers_first = awaited.is_some_and(|awaited| {
            answers.is_some_and(|it| awaited.length.is_none_or(|length| usize::from(length) == it))
        });
        let (asked, answered) = ((asks, request), (answers, response));
        let [first, other] = if answers_first { [answered, asked] } else { [asked, answered] };
        let begins = right(bytes, first.0, Some(first.1), more);
        let doubtful = match begins {
            Begins::Nothing => true,
            // Nobody asks for what no response can hold, if it can be a response itself.
            Begins::Telegram(_) => !answers_first && asks != answers && !rules.can_be_answered(pdu),
            Begins::More => false,
        };
        if doubtful { otherwise(bytes, other, more, begins) } else { begins }
    }

    #[inline]
    fn tcp(&self, place: Place<'_>) -> Begins {
        let Place { bytes, last, .. } = place;
        let more = if last { Begins::Nothing } else { Begins::More };
        let zeros = bytes.iter().skip(2).take(2).all(|byte| *byte == 0);
        let long = bytes.get(4).is_none_or(|high| *high <= 1);
        if !zeros || !long {
            return Begins::Nothing;
        }
        let [_, _, _, _, high, low, _, function, ..] = *bytes else { return more };
        let length = 6 + usize::from(u16::from_be_bytes([high, low]));
        // There is no function 0, but a device may answer so to a request with a number.
        let none = function & !EXCEPTION == 0 && bytes[..2] == [0, 0];
        if length <= modbus_tcp::HEADER || length > modbus_tcp::LONGEST || none {
            return Begins::Nothing;
        }
        let known = self.knows(function);
        if !known && !place.in_step {
            return Begins::Nothing;
        }
        if bytes.len() < length {
            return more;
        }
        // The header tells that it is a telegram, whatever its function; but then it ends where the bytes do, or
        // another header follows.
        if !known {
            let next = &bytes[length..];
            let next_is_zero = next.iter().skip(2).take(2).all(|byte| *byte == 0);
            return match next_is_zero {
                true if last || next.len() >= 4 => Begins::Telegram(length),
                true => more,
                false => Begins::Nothing,
            };
        }
        let fits = self.sides(&bytes[modbus_tcp::HEADER..length]) != [false, false];
        if fits || place.in_step { Begins::Telegram(length) } else { Begins::Nothing }
    }
}

/// A PROFIBUS frame. Token and acknowledgement have no check: they count only in step.
fn fdl(place: Place<'_>) -> Begins {
    let Place { bytes, last, in_step, .. } = place;
    let more = if last { Begins::Nothing } else { Begins::More };
    match (Fdl::length(bytes), bytes.first()) {
        (None, None) => more,
        (None, Some(&profibus_fdl::SD2)) if bytes.len() < 4 => more,
        (None, _) => Begins::Nothing,
        (Some(length), Some(&(SC | SD4))) => match in_step {
            true if length <= bytes.len() => Begins::Telegram(length),
            true => more,
            false => Begins::Nothing,
        },
        (Some(length), _) if length > bytes.len() => more,
        (Some(length), _) if Fdl::check_matches(Span::new(0, length).of(bytes)) => Begins::Telegram(length),
        _ => Begins::Nothing,
    }
}

/// Unit and check of an RTU frame.
const AROUND: usize = modbus_rtu::RTU.around();

/// Whether the length of the frame that begins with `bytes` may be told by what follows them.
#[cold]
fn is_to_be_told(rule: &Rule, bytes: &[u8]) -> bool {
    bytes.len() < modbus_rtu::RTU.longest() && rule.can_be_told(&bytes[1..])
}

/// What begins with `bytes` by the length and the rule of the other side, if that is anything.
#[cold]
fn otherwise(bytes: &[u8], (length, rule): (Option<usize>, &Rule), more: Begins, begins: Begins) -> Begins {
    match right(bytes, length, Some(rule), more) {
        Begins::Nothing => begins,
        other => other,
    }
}

/// Whether a frame of `length` begins `bytes` whose PDU is of the length `rule` and whose check is
/// right.
#[inline]
fn right(bytes: &[u8], length: Option<usize>, rule: Option<&Rule>, more: Begins) -> Begins {
    let Some(length) = length else {
        return if rule.is_some_and(|rule| is_to_be_told(rule, bytes)) { more } else { Begins::Nothing };
    };
    if length > modbus_rtu::RTU.longest() || length < modbus_rtu::RTU.shortest() {
        return Begins::Nothing;
    }
    if bytes.len() < length {
        return more;
    }
    let frame = &bytes[..length];
    if rule.is_some_and(|rule| !rule.fits(&frame[1..length - 2])) || crc_residue(frame) != 0 {
        return Begins::Nothing;
    }
    Begins::Telegram(length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modbus::STANDARD;

    const REQUEST: &[u8] = &[1, 3, 0, 200, 0, 3, 0x84, 0x35];

    fn begins(bytes: &[u8], waiting: Option<Waiting>) -> Begins {
        let place = Place { bytes, last: true, in_step: true, waiting: waiting.as_ref() };
        Splitter::new(&STANDARD).begins(&modbus_rtu::PROTOCOL, place)
    }

    #[test]
    fn a_telegram_ends_where_rule_and_check_agree() {
        assert_eq!(begins(REQUEST, None), Begins::Telegram(8));
        assert_eq!(begins(&[REQUEST, REQUEST].concat(), None), Begins::Telegram(8));
        assert_eq!(begins(&REQUEST[1..], None), Begins::Nothing);
        let more = Place { bytes: &REQUEST[..6], last: false, in_step: true, waiting: None };
        assert_eq!(Splitter::new(&STANDARD).begins(&modbus_rtu::PROTOCOL, more), Begins::More);
    }

    #[test]
    fn the_request_that_waits_decides_between_a_telegram_and_its_beginning() {
        // A request from 02xxh on that ends in 00: as a response of two bytes, it is right one byte
        // earlier.
        let found = (0x0100..0xF700_u16).find_map(|n| {
            let [unit, high] = n.to_be_bytes();
            let short = with_check(&[unit, 3, 2, high, 0]);
            // As a request, it is for so many registers.
            (1..=125).contains(&short[5]).then(|| [short, vec![0]].concat())
        });
        let both = found.expect("a CRC stays right when a zero follows");
        assert_eq!(begins(&both, None), Begins::Telegram(8), "a request is expected");
        let waiting = Waiting { unit: both[0], function: 3, length: Some(7) };
        assert_eq!(begins(&both, Some(waiting)), Begins::Telegram(7));
        let longer = Waiting { length: Some(9), ..waiting };
        assert_eq!(begins(&both, Some(longer)), Begins::Telegram(8), "the response is of another length");
    }

    fn with_check(body: &[u8]) -> Vec<u8> {
        [body, &(crate::walk::CRC_16_MODBUS.wire(body) as u16).to_be_bytes()].concat()
    }

    #[test]
    fn a_response_as_long_as_a_request_would_be_is_found() {
        // As a request it would write 0 registers, which none does.
        let response = with_check(&[5, 23, 8, 1, 2, 3, 4, 5, 6, 7, 0]);
        assert_eq!(begins(&response, None), Begins::Telegram(13));
    }

    #[test]
    fn a_request_for_more_than_a_response_can_hold_is_rather_a_response() {
        // A CRC stays right when 00 follows: a response with four bytes ends in 00, and as a request it
        // would end before that.
        let both = |quantity: u8| [with_check(&[5, 3, 4, 0, quantity, 10]), vec![0]].concat();
        assert_eq!(begins(&both(200), None), Begins::Telegram(9));
        assert_eq!(begins(&both(0), None), Begins::Telegram(8), "a request is expected");
        let waiting = Waiting { unit: 5, function: 3, length: Some(9) };
        assert_eq!(begins(&both(0), Some(waiting)), Begins::Telegram(9));
    }

    #[test]
    fn the_length_of_a_response_follows_from_its_request() {
        let splitter = Splitter::new(&STANDARD);
        assert_eq!(splitter.answer_length(&[3, 0, 200, 0, 3]), Some(8));
        assert_eq!(splitter.answer_length(&[1, 0, 200, 0, 9]), Some(4));
        assert_eq!(splitter.answer_length(&[100, 0, 200, 0, 3]), Some(14));
        assert_eq!(splitter.answer_length(&[16, 0, 200, 0, 1, 2, 0, 0]), Some(5));
        assert_eq!(splitter.answer_length(&[17]), None);
    }
}

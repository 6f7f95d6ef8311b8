//! How much speaks for a telegram, in bits.
//!
//! Nothing is a telegram because it consists of bytes: dates, addresses and words of hex letters do, too. A
//! right check over a known function proves one by itself. What has no such proof is *weighed*: one bit for each
//! halving of the chance that other bytes would look so. Its own bytes count ([`reading`]), how it stands in
//! the text ([`place`]), what else stands in the same place ([`company`]), and the conversation around it. It
//! is a telegram where the sum reaches [`threshold`], which grows with how much there is to be found by
//! chance: pieces without a proof, and where a column of numbers was searched, the places in it.
//!
//! | what | bits |
//! | --- | --- |
//! | a CRC is right | 16, with a known function and its length: proof |
//! | header of Modbus TCP: protocol 0 and the length of what follows | 32: proof |
//! | PROFIBUS: delimiters and sum are right | 24 and more: proof |
//! | one of the usual functions; another that is known | 5; 2 |
//! | unit 1 to 32; above 247 | 3; −8 |
//! | a number of registers or switches that can be; that cannot | 9 or 5; −6 |
//! | a byte count that counts what follows; with its number of registers | 8; 16 |
//! | an LRC is right | 8 |
//! | a header of Modbus TCP whose length is nearly right; behind zeros | 20; 12 |
//! | the check is there and wrong, but where no check of the text was computed; the end is missing | −5; −3 |
//! | bare in its line; said who sends it; a label before it | 4; 4; 2 |
//! | in brackets of its own; marked as bytes; a row of a dump; words of the trade | 3; 2; 3; 3 |
//! | a number beside it says its length, or its check is named behind it: `[CRC]` | 6 |
//! | commas between numbers of one digit; one decimal number; a phone number | −8 |
//! | called left over or thrown away | −6 |
//! | it is of an array of a program, whose brackets, marks and size say nothing | −2 |
//! | its numbers have two bytes and a mark each, as registers and addresses are written | −8 |
//! | telegrams stand in the same place of other lines; what stands there is none | up to 8; −4, and −8 where most are none |
//! | the same unit and function were seen; only telegrams of another kind were | 4; −8 |
//! | it answers a request, or is answered | 12 |
//! | the same telegram was seen, with its check | 16 |

use crate::field::Facts;
use crate::frame::split::{Splitter, Waiting};
use crate::frame::{
    Protocol, Verdict, modbus_ascii, modbus_pdu, modbus_rtu, modbus_tcp, modbus_unchecked, profibus_fdl,
};
use crate::modbus::EXCEPTION;
use crate::walk::{CRC_16_MODBUS, crc_residue};

/// What bytes without a proof could be.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    pub protocol: &'static Protocol,
    pub verdict: Verdict,
    /// Its bytes begin here: what is before them is none of its own.
    pub from: usize,
    pub bits: i32,
    /// Bytes are missing at its end.
    pub cut: bool,
    /// Its bits count on the request before it.
    pub awaited: bool,
}

/// Its place: it answers a request, or is answered.
pub const CONVERSATION: i32 = 12;

/// The same telegram was seen with its check.
pub const SAME: i32 = 16;

/// The same unit and function were seen.
pub const SEEN: i32 = 4;

/// The text has telegrams, but of another kind.
pub const OTHER_KIND: i32 = -8;

/// Its check is wrong: of a hundred telegrams one is, of other bytes all are.
const WRONG: i32 = -5;

/// The checks of a text were not computed: that one is wrong says nothing.
pub const MISPRINTED: i32 = -WRONG;

/// Its end is missing.
const CUT: i32 = -3;

/// How many bits it takes where so many pieces have no proof: among more, more is found by chance.
pub fn threshold(pieces: usize) -> i32 {
    12 + (1 + pieces).ilog2() as i32
}

/// What the text says, in bits.
pub fn place(facts: &Facts) -> i32 {
    let of = |fact: bool, bits: i32| if fact { bits } else { 0 };
    if facts.array {
        return of(facts.said, 4) + of(facts.of_telegrams, 3) + of(facts.words, -8) - 2;
    }
    of(facts.bare, 4)
        + of(facts.said, 4)
        + of(facts.labelled && !facts.said, 2)
        + of(facts.wrapped, 3)
        + of(facts.marked, 2)
        + of(facts.dumped, 3)
        + of(facts.of_telegrams, 3)
        + of(facts.counted || facts.check_named, 6)
        + of(facts.digits, -8)
        + of(facts.of_leftovers, -6)
        + of(facts.words, -8)
}

/// What others say that stand in the same way in their lines: of so many pieces some were proven, and some
/// look like telegrams.
pub fn company(pieces: usize, proven: usize, alike: usize) -> i32 {
    /// Few that are alike say little: each other.
    const MOST: i32 = 8;
    let good = proven + alike;
    match pieces {
        3.. if good * 3 < pieces => -8,
        3.. if good * 2 <= pieces => -4,
        _ => (3 * proven as i32 + 2 * alike.saturating_sub(1) as i32).min(MOST),
    }
}

/// What speaks for a telegram that is proven, where it was looked for in many places.
pub fn proof(protocol: &Protocol, telegram: &[u8], splitter: &Splitter) -> i32 {
    const CRC: i32 = 16;
    const HEADER: i32 = 32;
    const FRAME: i32 = 24;
    /// Its length is not that of its function.
    const ODD: i32 = -6;
    match telegram {
        _ if protocol.is(&modbus_tcp::PROTOCOL) => HEADER,
        _ if protocol.is(&profibus_fdl::PROTOCOL) => FRAME,
        [first, pdu @ .., _, _] => CRC + unit(*first) + structure(pdu, splitter).unwrap_or(ODD),
        _ => 0,
    }
}

/// What bytes are most likely, if they are a telegram whose check is wrong, missing, or was never printed.
pub fn reading(bytes: &[u8], splitter: &Splitter, waiting: Option<Waiting>) -> Option<Reading> {
    let readings = [
        damaged(bytes, splitter),
        of_another_length(bytes, splitter),
        awaited(bytes, splitter, waiting),
        unchecked(bytes, splitter),
        of_ascii(bytes, splitter),
        pdu(bytes, splitter),
        cut(bytes, splitter, waiting),
        over_tcp(bytes, splitter),
        over_profibus(bytes),
    ];
    readings.into_iter().flatten().reduce(|best, other| if other.bits > best.bits { other } else { best })
}

/// Characters behind a colon whose LRC is wrong.
pub fn ascii(bytes: &[u8], splitter: &Splitter) -> Option<Reading> {
    /// The colon, and digits only behind it.
    const COLON: i32 = 10;
    let pdu = modbus_ascii::ASCII.pdu_bytes(bytes);
    let fits = structure(pdu, splitter).or_else(|| splitter.knows(*bytes.get(1)?).then_some(0));
    let bits = COLON + unit(*bytes.first()?) + fits? + WRONG;
    Some(whole(&modbus_ascii::PROTOCOL, Verdict::Wrong, bits))
}

/// Bytes that are the characters of a frame of Modbus ASCII, whatever it holds.
pub fn characters(bytes: &[u8]) -> Reading {
    /// A colon and hex digits only.
    const CHARACTERS: i32 = 10;
    whole(&modbus_ascii::PROTOCOL, verdict(&modbus_ascii::PROTOCOL, bytes), CHARACTERS)
}

/// All bytes are one telegram.
fn whole(protocol: &'static Protocol, verdict: Verdict, bits: i32) -> Reading {
    Reading { protocol, verdict, from: 0, bits, cut: false, awaited: false }
}

fn damaged(bytes: &[u8], splitter: &Splitter) -> Option<Reading> {
    let pdu = modbus_rtu::RTU.pdu_bytes(bytes);
    // What damaged it may be in its numbers.
    let bits = unit(*bytes.first()?) + function(*pdu.first()?) + numbers(pdu, splitter)?.max(0) + WRONG;
    Some(whole(&modbus_rtu::PROTOCOL, verdict(&modbus_rtu::PROTOCOL, bytes), bits))
}

/// A request to write whose check is wrong: its numbers of registers and of bytes tell it among other bytes.
pub fn counted_write(bytes: &[u8], splitter: &Splitter) -> Option<Reading> {
    matches!(modbus_rtu::RTU.pdu_bytes(bytes), [15 | 16 | 101, ..]).then_some(())?;
    damaged(bytes, splitter).filter(|reading| reading.bits >= CONVERSATION)
}

/// Bytes with a right check whose length is not that of their function.
fn of_another_length(bytes: &[u8], splitter: &Splitter) -> Option<Reading> {
    let [first, code, _, _, ..] = *bytes else { return None };
    let checked = verdict(&modbus_rtu::PROTOCOL, bytes) == Verdict::Right && splitter.knows(code);
    checked.then(|| whole(&modbus_rtu::PROTOCOL, Verdict::Right, unit(first) + function(code)))
}

/// A response that is awaited, whatever is wrong with it: unit and function are those of the request.
fn awaited(bytes: &[u8], splitter: &Splitter, waiting: Option<Waiting>) -> Option<Reading> {
    let waiting = waiting?;
    let longest = waiting.length.map_or(modbus_rtu::RTU.longest(), |length| usize::from(length) + 4);
    let begins =
        matches!(bytes, [unit, code, ..] if *unit == waiting.unit && code & !EXCEPTION == waiting.function);
    let bits = CONVERSATION + function(waiting.function) + WRONG;
    let fits = begins && (modbus_rtu::RTU.shortest()..=longest).contains(&bytes.len());
    // All of it is there but a check.
    let reading = match splitter.sides(bytes.get(1..)?) {
        [false, false] => whole(&modbus_rtu::PROTOCOL, verdict(&modbus_rtu::PROTOCOL, bytes), bits),
        _ => without_check(0, bits, false),
    };
    fits.then_some(Reading { awaited: true, ..reading })
}

/// What its check says of bytes that are read as of `protocol`.
fn verdict(protocol: &Protocol, bytes: &[u8]) -> Verdict {
    (protocol.verdict)(bytes)
}

fn unchecked(bytes: &[u8], splitter: &Splitter) -> Option<Reading> {
    let (first, pdu) = bytes.split_first()?;
    // Nobody reads from all units.
    if *first == 0 && matches!(pdu.first(), Some(1..=4 | 100)) {
        return None;
    }
    let bits = unit(*first) + structure(pdu, splitter)?;
    Some(without_check(0, bits, false))
}

fn without_check(from: usize, bits: i32, cut: bool) -> Reading {
    Reading { from, cut, ..whole(&modbus_unchecked::PROTOCOL, Verdict::NoCheck, bits) }
}

/// The bytes that a frame of Modbus ASCII stands for, with a right LRC.
fn of_ascii(bytes: &[u8], splitter: &Splitter) -> Option<Reading> {
    const LRC: i32 = 8;
    let checked = modbus_ascii::ASCII.verdict(bytes) == Verdict::Right;
    // One of 256 numbers has a right LRC: what is in it must be able to be, too.
    let can_be = |bits: &i32| checked && *bits > 0;
    let inside = structure(modbus_ascii::ASCII.pdu_bytes(bytes), splitter).filter(can_be)?;
    let bits = unit(*bytes.first()?) + inside + LRC;
    Some(whole(&modbus_ascii::PROTOCOL, Verdict::Right, bits))
}

fn pdu(bytes: &[u8], splitter: &Splitter) -> Option<Reading> {
    /// Two bytes are no PDU that could be told.
    const SHORTEST: usize = 5;
    // Units 1 and 2 write a register more often than 48 switches are printed without their unit.
    if matches!(bytes, [1 | 2, 6, ..]) && damaged(bytes, splitter).is_some() {
        return None;
    }
    let bits = structure(bytes, splitter).filter(|_| bytes.len() >= SHORTEST)?;
    // Whatever could be a PDU is more likely one with its unit.
    Some(whole(&modbus_pdu::PROTOCOL, Verdict::NoCheck, bits - 1))
}

/// A telegram whose end is missing: the request that waits tells it, or its byte count.
fn cut(bytes: &[u8], splitter: &Splitter, waiting: Option<Waiting>) -> Option<Reading> {
    /// What may come before it: the line was not silent when it was switched.
    const STRAY: usize = 2;
    if let Some(waiting) = waiting {
        let awaited = |from: &usize| {
            let own = &bytes[*from..];
            let length = waiting.length.map_or(usize::MAX, usize::from);
            let begins = own.starts_with(&[waiting.unit, waiting.function]);
            let fits = splitter.rtu_lengths(own)[1].is_none_or(|own| own == length);
            begins && fits && own.len() < length && is_cut(own, length - own.len(), *from > 0)
        };
        if let Some(from) = (0..=STRAY.min(bytes.len().saturating_sub(2))).find(awaited) {
            let bits = CONVERSATION + function(waiting.function);
            return Some(Reading { awaited: true, ..without_check(from, bits, true) });
        }
    }
    let [first, code, count, ..] = *bytes else { return None };
    let [request, response] = splitter.rtu_lengths(bytes);
    if let ([_, 15 | 16 | 101, _, _, high, low, count, ..], Some(request)) = (bytes, request) {
        let (quantity, width) =
            (u32::from(u16::from_be_bytes([*high, *low])), if code == 101 { 4 } else { 2 });
        let counts = u32::from(*count) == if code == 15 { quantity.div_ceil(8) } else { quantity * width };
        let missing = request.checked_sub(bytes.len()).filter(|_| counts)?;
        let bits = unit(first) + function(code) + 8 + CUT;
        return is_cut(bytes, missing, false).then(|| without_check(0, bits, true));
    }
    // Its check has begun.
    if let (Some(1), [_, asked @ .., _]) = (request.and_then(|length| length.checked_sub(bytes.len())), bytes)
        && is_cut(bytes, 1, false)
    {
        let bits = unit(first) + structure(asked, splitter)? + 8 + CUT;
        return Some(without_check(0, bits, true));
    }
    // Nobody answers from the address of all.
    if first == 0 {
        return None;
    }
    let even = count % 2 == 0 || matches!(code, 1 | 2);
    let missing = response?.checked_sub(bytes.len())?;
    if code & EXCEPTION != 0 || !even || count == 0 || !matches!(code, 1..=4 | 23 | 100) {
        return None;
    }
    let check = if missing == 1 { 8 } else { 0 };
    // Of registers the count is even; of switches any will do.
    let counted = if matches!(code, 1 | 2) { -2 } else { 1 };
    is_cut(bytes, missing, false)
        .then(|| without_check(0, unit(first) + function(code) + counted + check + CUT, true))
}

/// Whether so many bytes are missing at the end of a telegram, and not somewhere within it: where most of the
/// check is there, it tells; so does a byte too many in front, which pushed the last one out.
fn is_cut(bytes: &[u8], missing: usize, stray: bool) -> bool {
    stray || missing > 2 || (missing == 1 && begins_check(bytes))
}

/// Whether the last byte is the first one of the check of those before it, and not the second one of a check.
pub fn begins_check(bytes: &[u8]) -> bool {
    let [covered @ .., last] = bytes else { return false };
    CRC_16_MODBUS.wire(covered) >> 8 == u64::from(*last) && crc_residue(bytes) != 0
}

/// A frame of Modbus TCP whose length is wrong.
fn over_tcp(bytes: &[u8], splitter: &Splitter) -> Option<Reading> {
    /// Nothing but its function says that it is one.
    const UNTOLD: i32 = -4;
    let pdu = bytes.get(modbus_tcp::HEADER..)?;
    let [high, low, 0, 0, 0 | 1, _, ..] = *bytes else { return None };
    // Zeros are not rare, but those behind a number are.
    let header = if (high, low) == (0, 0) { 4 } else { 12 };
    let length = usize::from(u16::from_be_bytes([bytes[4], bytes[5]]));
    // Nearly right: a slip, or bytes that are missing.
    let near = length.abs_diff(bytes.len() - 6) <= 4 && pdu.len() > 1;
    let cut = length > bytes.len() - 6;
    let untold = match *pdu.first()? {
        known if splitter.knows(known) => Some(UNTOLD),
        1..EXCEPTION if (high, low) != (0, 0) => Some(2 * UNTOLD),
        _ => None,
    };
    let inside = structure(pdu, splitter).or(untold.filter(|_| cut))?;
    let bits = header + if near { 8 } else { 0 } + inside + CUT;
    let reading = whole(&modbus_tcp::PROTOCOL, Verdict::NoCheck, bits);
    (length > 2 && (near || cut)).then_some(Reading { cut, ..reading })
}

/// A frame of PROFIBUS whose sum is wrong or whose end is missing.
fn over_profibus(bytes: &[u8]) -> Option<Reading> {
    use profibus_fdl::{Fdl, PROTOCOL, SD2};
    let reading = |bits, verdict, cut| Some(Reading { cut, ..whole(&PROTOCOL, verdict, bits) });
    let ends = bytes.last() == Some(&profibus_fdl::END);
    match (bytes, Fdl::length(bytes)) {
        // M-Bus begins its frames in the same way, but has other codes where a control byte is.
        ([SD2, a, b, SD2, _, _, control, ..], Some(length))
            if a == b && length > bytes.len() && !ends && Fdl::is_control(*control) =>
        {
            let checked = verdict(&PROTOCOL, bytes) == Verdict::Right;
            reading(16 + CUT, if checked { Verdict::Right } else { Verdict::Unchecked }, true)
        }
        ([SD2, a, b, SD2, ..], Some(length)) if a == b && length == bytes.len() => {
            reading(24 + WRONG, verdict(&PROTOCOL, bytes), false)
        }
        ([SD2, _, _, SD2, ..], _) if ends => reading(20 + WRONG, verdict(&PROTOCOL, bytes), false),
        ([profibus_fdl::SC], _) => reading(8, Verdict::NoCheck, false),
        ([profibus_fdl::SD1, ..], Some(length)) if length == bytes.len() && ends => {
            reading(8 + WRONG, verdict(&PROTOCOL, bytes), false)
        }
        _ => None,
    }
}

fn unit(unit: u8) -> i32 {
    match unit {
        1..=32 => 3,
        0..=247 => 0,
        248.. => -8,
    }
}

fn function(function: u8) -> i32 {
    match function & !EXCEPTION {
        1..=6 | 15 | 16 => 5,
        _ => 2,
    }
}

/// How much a PDU looks like one: its function is known, its length fits, its numbers can be.
pub fn structure(pdu: &[u8], splitter: &Splitter) -> Option<i32> {
    Some(function(*pdu.first()?) + numbers(pdu, splitter)?)
}

/// How much the numbers of a PDU look so; `None` where its length does not fit.
fn numbers(pdu: &[u8], splitter: &Splitter) -> Option<i32> {
    const UNLIKELY: i32 = -6;
    /// The highest sub-function of function 8.
    ///
    /// Source: Modbus application protocol V1.1b3, section 6.8.
    const LAST_DIAGNOSIS: u32 = 20;
    let code = *pdu.first()?;
    let [asks, answers] = splitter.sides(pdu);
    if !asks && !answers {
        return None;
    }
    let number =
        |at: usize| pdu.get(at..at + 2).map_or(0, |word| u32::from(u16::from_be_bytes([word[0], word[1]])));
    let can_be = |most: u32, bits: i32| {
        let quantity = number(3);
        if (1..=most).contains(&quantity) && number(1) + quantity <= 1 << 16 { bits } else { UNLIKELY }
    };
    let (registers, switches) = (9, 5);
    let of_request = match code {
        1 | 2 => can_be(2000, switches),
        3 | 4 => can_be(125, registers),
        100 => can_be(62, registers),
        5 => {
            if matches!(pdu.get(3..5), Some([0 | 0xFF, 0])) {
                15
            } else {
                UNLIKELY
            }
        }
        // Of a diagnosis, the sub-function says what it is.
        8 if number(1) > LAST_DIAGNOSIS => UNLIKELY,
        15 if u32::from(pdu.get(5).copied().unwrap_or_default()) == number(3).div_ceil(8) => 16,
        16 if u32::from(pdu.get(5).copied().unwrap_or_default()) == 2 * number(3) => 16,
        101 if u32::from(pdu.get(5).copied().unwrap_or_default()) == 4 * number(3) => 16,
        15 | 16 | 101 => UNLIKELY,
        _ => 0,
    };
    let of_response = match code {
        1..=4 | 23 | 100 => 8,
        15 => can_be(1968, switches),
        16 => can_be(123, registers),
        101 => can_be(62, registers),
        code if code & EXCEPTION != 0 => {
            if matches!(pdu.get(1), Some(1..=6 | 8 | 10 | 11 | 64..=67)) {
                4
            } else {
                UNLIKELY
            }
        }
        _ => of_request,
    };
    let fitting = [(asks, of_request), (answers, of_response)].into_iter().filter(|(fits, _)| *fits);
    fitting.map(|(_, bits)| bits).max()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modbus::STANDARD;

    /// What bytes are most likely, with nothing before them.
    fn read(bytes: &[u8]) -> Option<(&'static str, Verdict, i32, bool)> {
        let splitter = Splitter::new(&STANDARD);
        let reading = reading(bytes, &splitter, None)?;
        Some((reading.protocol.key, reading.verdict, reading.bits, reading.cut))
    }

    #[test]
    fn bits() {
        let unchecked = modbus_unchecked::PROTOCOL.key;
        let rtu = modbus_rtu::PROTOCOL.key;
        for (bytes, told) in [
            // A unit, a function, and a number of registers that can be.
            (&[1, 3, 0, 0xC8, 0, 3][..], Some((unchecked, Verdict::NoCheck, 3 + 5 + 9, false))),
            (&[1, 3, 0, 0xC8, 0, 3, 0, 0], Some((rtu, Verdict::Wrong, 3 + 5 + 9 - 5, false))),
            (&[1, 3, 2, 0, 5, 0, 0], Some((rtu, Verdict::Wrong, 3 + 5 + 8 - 5, false))),
            // One that cannot: only what damaged it says nothing.
            (&[1, 3, 0, 0xC8, 9, 3], Some((unchecked, Verdict::NoCheck, 3 + 5 - 6, false))),
            (&[1, 3, 0, 0xC8, 9, 3, 0, 0], Some((rtu, Verdict::Wrong, 3 + 5 - 5, false))),
            // A PDU alone.
            (&[3, 0, 0xC8, 0, 3], Some((modbus_pdu::PROTOCOL.key, Verdict::NoCheck, 5 + 9 - 1, false))),
            // A response without its end.
            (&[1, 3, 6, 0, 5, 0], Some((unchecked, Verdict::NoCheck, 3 + 5 + 1 - 3, true))),
            (&[0xE5], Some((profibus_fdl::PROTOCOL.key, Verdict::NoCheck, 8, false))),
            (&[], None),
        ] {
            assert_eq!(read(bytes), told, "{bytes:02X?}");
        }
    }

    #[test]
    fn proofs() {
        let splitter = Splitter::new(&STANDARD);
        let proof = |protocol, bytes: &[u8]| proof(protocol, bytes, &splitter);
        assert_eq!(proof(&modbus_rtu::PROTOCOL, &[1, 3, 0, 0xC8, 0, 3, 0x84, 0x35]), 16 + 3 + 5 + 9);
        assert_eq!(proof(&modbus_rtu::PROTOCOL, &[1, 3, 0, 0, 0]), 16 + 3 - 6);
        assert_eq!(proof(&modbus_tcp::PROTOCOL, &[0, 1, 0, 0, 0, 6, 1, 3, 0, 0xC8, 0, 3]), 32);
        assert_eq!(proof(&profibus_fdl::PROTOCOL, &[0x10, 2, 1, 0x49, 0x4C, 0x16]), 24);
        assert_eq!(proof(&modbus_rtu::PROTOCOL, &[1, 3]), 0);
    }

    #[test]
    fn more_is_found_by_chance_among_more() {
        assert_eq!([0, 1, 2, 3, 7, 1000].map(threshold), [12, 13, 13, 14, 15, 21]);
    }

    #[test]
    fn what_others_say() {
        for ((pieces, proven, alike), bits) in [
            ((1, 0, 1), 0),
            ((2, 0, 2), 2),
            ((2, 1, 0), 3),
            ((2, 1, 1), 3),
            ((5, 5, 0), 8),
            ((5, 1, 1), -4),
            ((6, 1, 1), -4),
            ((7, 1, 1), -8),
            ((3, 0, 0), -8),
            ((2, 0, 0), 0),
        ] {
            assert_eq!(company(pieces, proven, alike), bits, "{pieces} {proven} {alike}");
        }
    }
}

//! Possible causes to a telegram whose check does not match.
//!
//! Every usual cause is tried; what makes the check right is a [`Hypothesis`]. On how many tries that is
//! found tells how likely it is to be found by chance, so that nobody takes a guess for the truth.
//!
//! | file | what is tried |
//! | --- | --- |
//! | `check` | the check itself: swapped, missing, of another kind, copied |
//! | `changed` | bits, bytes, digits and words changed or exchanged |
//! | `length` | bytes lost, doubled, left over; swallowed by flow control |
//! | `frame` | two telegrams in one, an echo, another protocol |
//! | `sum` | the same for checks of one byte, which tell far less |

mod cause;
mod changed;
mod check;
mod crc;
mod frame;
mod length;
mod sum;

pub use cause::Cause;

use crate::field::{Argument, Message, Span, hex, hex_value};
use crate::frame::{Protocol, modbus_ascii, modbus_rtu, profibus_fdl};
use crate::message;

/// Possible causes to a telegram.
#[derive(Clone, Debug)]
pub struct Hypothesis {
    pub cause: Cause,
    /// The first byte that is not as it should be.
    pub place: usize,
    /// The telegram as it would be.
    pub bytes: Vec<u8>,
    /// How many telegrams were tried in search of this one; `None` where one always fits.
    pub tries: Option<usize>,
    /// What it would be of, if that is another protocol.
    pub protocol: Option<&'static Protocol>,
    /// How many values the check has.
    checks: usize,
}

/// What is known around a telegram.
#[derive(Clone, Copy, Debug, Default)]
pub struct Context<'a> {
    /// The request before it.
    pub request: Option<&'a [u8]>,
    /// Other telegrams of the same log.
    pub others: &'a [&'a [u8]],
    /// The text that it was written in lacks a digit somewhere.
    pub digit_lost: bool,
}

/// How many checks there are.
const CHECKS: usize = 0x1_0000;

/// Telegrams longer than a frame can be are not looked at.
const LONGEST: usize = 300;

/// Everything that makes the check of `bytes` right, in no order. `bytes` is a frame of `protocol`
/// with its check; empty for protocols without one.
pub fn hypotheses(bytes: &[u8], protocol: &'static Protocol, context: Context<'_>) -> Vec<Hypothesis> {
    let mut search = Search { found: Vec::new(), bytes, context, checks: CHECKS };
    if protocol.is(&modbus_rtu::PROTOCOL) {
        if (4..=LONGEST).contains(&bytes.len()) {
            search.check();
            search.exchanged();
            if context.digit_lost {
                search.digit_lost();
            }
            search.changed();
            search.removed();
            search.missing();
            search.flow_control();
            search.frames();
        }
    } else if [&modbus_ascii::PROTOCOL, &profibus_fdl::PROTOCOL].into_iter().any(|it| it.is(protocol)) {
        search.checks = 0x100;
        search.sum(protocol);
    }
    search.found
}

/// How many changes of one byte make the check of a telegram of `length` bytes right by chance.
pub fn chance_of_change(length: usize) -> f64 {
    255.0 * length as f64 / CHECKS as f64
}

struct Search<'a> {
    bytes: &'a [u8],
    context: Context<'a>,
    found: Vec<Hypothesis>,
    checks: usize,
}

impl Search<'_> {
    fn add(&mut self, cause: Cause, place: usize, bytes: Vec<u8>, tries: Option<usize>) {
        let weight = |cause: Cause, tries: Option<usize>| bits(cause, tries);
        let same = |known: &&mut Hypothesis| known.bytes == bytes && known.protocol.is_none();
        if bytes == self.bytes {
            return;
        }
        match self.found.iter_mut().find(same) {
            // The same telegram, explained by what happens more often.
            Some(known) if weight(known.cause, known.tries) > weight(cause, tries) => {
                (known.cause, known.place, known.tries) = (cause, place, tries);
            }
            Some(_) => {}
            None => {
                let checks = self.checks;
                self.found.push(Hypothesis { cause, place, bytes, tries, protocol: None, checks });
            }
        }
    }

    /// Adds `bytes` if their check is right.
    fn attempt(&mut self, cause: Cause, place: usize, bytes: Vec<u8>, tries: usize) {
        if bytes.len() >= 4 && crc::residue(&bytes) == 0 {
            self.add(cause, place, bytes, Some(tries));
        }
    }
}

/// How unlikely a cause is together with the many ways in which it could have come: in halvings.
fn bits(cause: Cause, tries: Option<usize>) -> u32 {
    cause.rarity() + tries.unwrap_or(CHECKS).max(1).ilog2()
}

impl Hypothesis {
    /// What is known and not searched for: `bytes` are what `found` should be.
    pub fn known(cause: Cause, found: &[u8], bytes: Vec<u8>) -> Self {
        let place = found.iter().zip(&bytes).take_while(|(found, right)| found == right).count();
        Self { cause, place, bytes, tries: Some(1), protocol: None, checks: CHECKS }
    }

    /// How unlikely it is, in halvings: rare causes and those with many ways to come are.
    pub fn bits(&self) -> u32 {
        bits(self.cause, self.tries)
    }

    /// How likely such a telegram is found although nothing of the kind happened: "1 in 29".
    pub fn odds(&self) -> Message {
        match self.tries {
            Some(tries) if tries < self.checks => {
                message!("1 in {n}", n = (self.checks / tries.max(1)).max(2))
            }
            _ => message!("always"),
        }
    }

    /// What is different: the bytes of `found` that are not in it, and its bytes that are not in
    /// `found`.
    pub fn difference(&self, found: &[u8]) -> (Vec<Span>, Vec<Span>) {
        let (own, other) = (self.bytes.as_slice(), found);
        if own.len() == other.len() {
            let changed = |at: &usize| own[*at] != other[*at];
            let spans: Vec<Span> = (0..own.len()).filter(changed).map(|at| Span::new(at, at + 1)).collect();
            return (spans.clone(), spans);
        }
        let front = own.iter().zip(other).take_while(|(a, b)| a == b).count();
        let rest = own.len().min(other.len()) - front;
        let back = own.iter().rev().zip(other.iter().rev()).take(rest).take_while(|(a, b)| a == b).count();
        let spans = |length: usize| {
            let span = Span::new(front, length - back);
            if span.is_empty() { Vec::new() } else { vec![span] }
        };
        (spans(other.len()), spans(own.len()))
    }

    /// The cause in a sentence; `found` is the telegram as it came.
    pub fn text(&self, found: &[u8]) -> Message {
        let at = self.place;
        let byte = |bytes: &[u8]| match bytes.get(at) {
            Some(byte) => Argument::Hex(hex_value((*byte).into(), 1)),
            None => Argument::Term(""),
        };
        let (was, is) = (byte(found), byte(&self.bytes));
        match self.cause {
            Cause::CheckSwapped => message!("the two bytes of the checksum are swapped"),
            Cause::CheckDigit => {
                message!(
                    "one digit of the checksum is wrong: it should be {check}",
                    check = self.check_text()
                )
            }
            Cause::CheckWrong => {
                message!(
                    "the bytes are right and only the checksum is wrong: it should be {check}",
                    check = self.check_text()
                )
            }
            Cause::CheckMissing => {
                message!("the checksum is missing: it should be {check}", check = self.check_text())
            }
            Cause::CheckWithoutAddress => message!(
                "the checksum leaves out the address; over all bytes it should be {check}",
                check = self.check_text()
            ),
            Cause::CheckOfOtherKind(kind) => message!(
                "the checksum is of another kind, {kind}; for Modbus RTU it should be {check}",
                kind = kind.to_owned(),
                check = self.check_text()
            ),
            Cause::CheckCopied => message!(
                "the checksum is that of another telegram: it was copied, and should be {check}",
                check = self.check_text()
            ),
            Cause::BitFlipped => {
                message!("a bit of byte {at} is flipped: {was} for {is}", at = at, was = was, is = is)
            }
            Cause::DigitsSwapped if found.get(at + 1) != self.bytes.get(at + 1) => {
                message!("digits of bytes {at} and {next} are swapped", at = at, next = at + 1)
            }
            Cause::DigitsSwapped => {
                message!("the digits of byte {at} are swapped: {was} for {is}", at = at, was = was, is = is)
            }
            Cause::DigitLost => message!("a digit of byte {at} is lost: it would be {is}", at = at, is = is),
            Cause::BytesSwapped => message!("bytes {at} and {next} are swapped", at = at, next = at + 1),
            Cause::WordsSwapped => {
                message!("the two bytes of each word are swapped, from byte {at} on", at = at)
            }
            Cause::ByteChanged => {
                message!("byte {at} is changed: {was} for {is}", at = at, was = was, is = is)
            }
            Cause::ByteDoubled => message!("byte {at} ({was}) is there twice", at = at, was = was),
            Cause::ByteExtra => message!("byte {at} ({was}) is too much", at = at, was = was),
            Cause::RegisterExtra => message!("bytes {at} and {next} are too much", at = at, next = at + 1),
            Cause::ByteMissing => message!("a byte {is} is missing before byte {at}", is = is, at = at),
            Cause::RegisterMissing => message!(
                "two bytes are missing before byte {at}; any two fit the checksum, {bytes} would make sense",
                at = at,
                bytes = hex(self.bytes.get(at..at + 2).unwrap_or_default())
            ),
            Cause::FlowControl => message!(
                "{n} swallowed, the first before byte {at}: 11h and 13h stop and start the flow (XON/XOFF) on some converters",
                n = Message::bytes(self.bytes.len().saturating_sub(found.len())),
                at = at
            ),
            Cause::LineTurn => {
                message!(
                    "00 or FF from the line changing direction was taken as part of it, at byte {at}",
                    at = at
                )
            }
            Cause::LeadingBytes => {
                message!("it begins at byte {at}: those before do not belong to it", at = at)
            }
            Cause::TrailingBytes => message!("the bytes from byte {at} on do not belong to it", at = at),
            Cause::Joined => message!("another telegram follows in it, from byte {at} on", at = at),
            Cause::EchoInFront => {
                message!(
                    "its own request is in front of it (an echo of RS-485): it begins at byte {at}",
                    at = at
                )
            }
            Cause::Cut => {
                message!("its end is missing: it would have {n}", n = Message::bytes(self.bytes.len()))
            }
            Cause::Misprint { section, slips } => message!(
                "the manual prints it so in section {section}, with slips: {slips}",
                section = section.to_owned(),
                slips = Argument::Term(slips)
            ),
            Cause::OtherProtocol => message!(
                "it is of {protocol}",
                protocol = self.protocol.map_or("another protocol", |protocol| protocol.label).to_owned()
            ),
        }
    }

    fn check_text(&self) -> String {
        let width = if self.checks == CHECKS { 2 } else { 1 };
        hex(self.bytes.split_at(self.bytes.len().saturating_sub(width)).1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bytes(hex: &str) -> Vec<u8> {
        hex.split(' ').map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
    }

    fn causes(found: &str, right: &str, context: Context<'_>) -> Vec<Cause> {
        let right = bytes(right);
        let all = hypotheses(&bytes(found), &modbus_rtu::PROTOCOL, context);
        assert!(all.iter().all(|one| one.protocol.is_some() || crc::residue(&one.bytes) == 0));
        all.into_iter().filter(|one| one.bytes == right).map(|one| one.cause).collect()
    }

    #[test]
    fn how_often_chance_finds_one() {
        let found = bytes("01 03 00 C8 00 03 84 36");
        let odds = |tries| {
            let known = Hypothesis::known(Cause::CheckWrong, &found, found.clone());
            Hypothesis { tries, checks: 256, ..known }.odds().to_string()
        };
        for (tries, said) in
            [(0, "1 in 256"), (1, "1 in 256"), (9, "1 in 28"), (129, "1 in 2"), (255, "1 in 2")]
        {
            assert_eq!(odds(Some(tries)), said, "{tries}");
        }
        assert_eq!([Some(256), None].map(odds), ["always"; 2]);
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
            ("33 22 01 03 00 C8 00 03 84 35", Cause::LeadingBytes),
            ("01 03 00 C8 00 03 84 35 FF", Cause::LineTurn),
            ("00 01 03 00 C8 00 03 84 35", Cause::LineTurn),
            ("03 01 C8 00 03 00 35 84", Cause::WordsSwapped),
        ] {
            let causes = causes(found, RIGHT, Context::default());
            assert!(causes.contains(&cause), "{found}: {causes:?}");
        }
        let status_missing = "01 03 0A 40 19 33 33 39 80 00 00 C5 32";
        let right = "01 03 0A 00 80 40 19 33 33 39 80 00 00 C5 32";
        assert!(causes(status_missing, right, Context::default()).contains(&Cause::RegisterMissing));
    }

    #[test]
    fn what_is_around_a_telegram_explains_it() {
        let request = bytes("01 03 00 C8 00 01 05 F4");
        let response = "01 03 02 00 07 F9 86";
        let context = Context { request: Some(&request), ..Context::default() };
        let both = format!("01 03 00 C8 00 01 05 F4 {response}");
        assert!(causes(&both, response, context).contains(&Cause::EchoInFront));
        let other = bytes("05 06 00 01 00 02 58 4F");
        let others = [other.as_slice()];
        let copied =
            causes("01 03 02 00 07 58 4F", response, Context { others: &others, ..Context::default() });
        assert!(copied.contains(&Cause::CheckCopied), "{copied:?}");
    }

    #[test]
    fn a_lost_digit_is_found_again() {
        const RIGHT: &str = "01 03 00 C8 00 03 84 35";
        let context = Context { digit_lost: true, ..Context::default() };
        // 01 03 00 C 00 03 84 35, and 010300800038435: from there on, digits are in other bytes.
        for found in ["01 03 00 0C 00 03 84 35", "01 03 00 80 00 38 43"] {
            assert!(causes(found, RIGHT, context).contains(&Cause::DigitLost), "{found}");
        }
    }

    #[test]
    fn swallowed_bytes_are_found() {
        // 11h twice and 13h.
        let right = "11 03 04 13 00 11 05 57 3C";
        let body = bytes(right);
        let check = crate::walk::CRC_16_MODBUS.wire(&body[..7]) as u16;
        let right = [&body[..7], &check.to_be_bytes()].concat();
        let kept: Vec<u8> = right.iter().copied().filter(|byte| !matches!(byte, 0x11 | 0x13)).collect();
        let found = hypotheses(&kept, &modbus_rtu::PROTOCOL, Context::default());
        assert!(found.iter().any(|one| one.cause == Cause::FlowControl && one.bytes == right));
    }

    #[test]
    fn a_sum_tells_a_lost_byte() {
        for (right, protocol) in [
            ("11 03 00 6B 00 03 7E", &modbus_ascii::PROTOCOL),
            ("10 02 01 49 4C 16", &profibus_fdl::PROTOCOL),
            ("68 08 08 68 01 02 08 12 34 56 78 9A B9 16", &profibus_fdl::PROTOCOL),
        ] {
            let right = bytes(right);
            let first = if protocol.is(&profibus_fdl::PROTOCOL) && right[0] == 0x68 { 4 } else { 1 };
            for at in first..right.len() - 2 {
                let mut found = right.clone();
                found.remove(at);
                // A zero more or less changes no sum.
                if right[at] == 0 {
                    continue;
                }
                let all = hypotheses(&found, protocol, Context::default());
                let one = all.iter().find(|one| one.bytes == right);
                assert_eq!(one.map(|one| one.cause), Some(Cause::ByteMissing), "{at} of {right:02X?}");
            }
        }
    }

    #[test]
    fn odds_are_said_in_words() {
        let one = |tries| Hypothesis {
            cause: Cause::ByteChanged,
            place: 0,
            bytes: Vec::new(),
            tries,
            protocol: None,
            checks: CHECKS,
        };
        assert_eq!(one(Some(255 * 9)).odds().to_string(), "1 in 28");
        assert_eq!(one(Some(60_000)).odds().to_string(), "1 in 2");
        assert_eq!(one(Some(100_000)).odds().to_string(), "always");
        assert_eq!(one(None).odds().to_string(), "always");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

        #[test]
        fn what_is_found_is_right(bytes in proptest::collection::vec(any::<u8>(), 0..320), request in proptest::collection::vec(any::<u8>(), 0..20)) {
            for protocol in crate::frame::PROTOCOLS {
                let context = Context { request: Some(&request), others: &[&request], digit_lost: true };
                for one in hypotheses(&bytes, protocol, context) {
                    let _ = (one.text(&bytes), one.difference(&bytes), one.odds());
                    let of = one.protocol.unwrap_or(protocol);
                    let verdict = (of.verdict)(&one.bytes);
                    prop_assert!(one.cause == Cause::Cut || matches!(verdict, crate::frame::Verdict::Right | crate::frame::Verdict::NoCheck), "{:?}", one);
                }
            }
        }
    }
}

//! Faults put into telegrams on purpose, for others to find: of the kinds that the library looks for, and by their
//! names. Only what the library itself finds is a question.

use buslens::field::{Direction, Span, hex};
use buslens::tool::steps::CHECKS;
use buslens::tool::{Options, Profile, Protocol, Report, Verdict, decode};

use crate::practice::bytes_said;
use crate::random::Random;
use crate::task::{Choice, Expected, Given, Task, Telegram};

/// Something that happens to a telegram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    CheckSwapped,
    BitFlipped,
    ByteChanged,
    DigitsSwapped,
    BytesSwapped,
    ByteDoubled,
    ByteExtra,
    ByteMissing,
    FlowControl,
    CheckMissing,
    LineTurn,
    TrailingBytes,
    WrongByte,
}

/// What a fault does to the length: those with the same effect cannot stand side by side as choices, since what says
/// less of the same is right, too.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Effect {
    Check,
    Changed,
    Longer,
    Shorter,
}

/// The stable word of links, which is that of the library's cause; how a choice names it; what it does.
const FAULTS: [(Fault, &str, &str, Effect); 13] = [
    (Fault::CheckSwapped, "check-swapped", "The two bytes of the CRC are swapped", Effect::Check),
    (Fault::BitFlipped, "bit-flipped", "A single bit is flipped", Effect::Changed),
    (Fault::ByteChanged, "byte-changed", "A byte is another one", Effect::Changed),
    (Fault::DigitsSwapped, "digits-swapped", "The two digits of a byte are swapped", Effect::Changed),
    (Fault::BytesSwapped, "bytes-swapped", "Two neighbouring bytes are swapped", Effect::Check),
    (Fault::ByteDoubled, "byte-doubled", "A byte is there twice", Effect::Longer),
    (Fault::ByteExtra, "byte-extra", "A byte is too much", Effect::Longer),
    (Fault::ByteMissing, "byte-missing", "A byte is missing", Effect::Shorter),
    (Fault::FlowControl, "flow-control", "A converter swallowed 11h or 13h", Effect::Shorter),
    (Fault::CheckMissing, "check-missing", "The checksum is missing", Effect::Shorter),
    (Fault::LineTurn, "line-turn", "00 or FF from the line changing direction is beside it", Effect::Longer),
    (Fault::TrailingBytes, "trailing-bytes", "Bytes that are not of it follow", Effect::Longer),
    (Fault::WrongByte, "wrong-byte", "A byte says something else; the checksum is valid", Effect::Changed),
];

/// So many of the first ones are offered as choices: what links of version 1 ask never changes.
const OFFERED: usize = 9;

impl Fault {
    pub const ALL: [Self; FAULTS.len()] = {
        let mut all = [Self::CheckSwapped; FAULTS.len()];
        let mut at = 0;
        while at < all.len() {
            all[at] = FAULTS[at].0;
            at += 1;
        }
        all
    };

    pub const fn key(self) -> &'static str {
        FAULTS[self as usize].1
    }

    pub const fn label(self) -> &'static str {
        FAULTS[self as usize].2
    }

    const fn effect(self) -> Effect {
        FAULTS[self as usize].3
    }

    pub fn of(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|fault| fault.key() == key)
    }

    /// The telegram with this fault, and where it is; `None` where it cannot have it, or nobody could find it:
    /// only what the library explains first is a question.
    pub fn inject(self, telegram: &Telegram, random: &mut Random) -> Option<(Vec<u8>, Span)> {
        /// A place by chance may be one where the damage fits something else, too.
        const TRIES: usize = 20;
        (0..TRIES).find_map(|_| {
            let (bytes, at) = self.damage(telegram, random)?;
            let at = at.min(bytes.len().saturating_sub(1));
            (bytes != telegram.bytes && found(telegram, &bytes) == Some(self.key()))
                .then_some((bytes, Span::new(at, at + 1)))
        })
    }

    /// Damages bytes somewhere.
    fn damage(self, telegram: &Telegram, random: &mut Random) -> Option<(Vec<u8>, usize)> {
        let bytes = &telegram.bytes;
        let mut damaged = bytes.clone();
        let check = telegram.check();
        let body = check.map_or(bytes.len(), |check| check.covered.to);
        if body < 2 {
            return None;
        }
        let width = check.map_or(0, |check| check.width);
        let at = random.below(body);
        let at = match self {
            Self::CheckSwapped if width == 2 => {
                damaged.swap(body, body + 1);
                body
            }
            Self::CheckMissing if width == 2 => {
                damaged.truncate(body);
                body
            }
            Self::CheckSwapped | Self::CheckMissing => return None,
            Self::BitFlipped => {
                damaged[at] ^= 1 << random.below(8);
                at
            }
            Self::ByteChanged => {
                damaged[at] ^= random.between(1, 255) as u8;
                at
            }
            Self::DigitsSwapped => {
                damaged[at] = damaged[at].rotate_left(4);
                at
            }
            Self::BytesSwapped => {
                let at = random.below(body - 1);
                damaged.swap(at, at + 1);
                at
            }
            Self::ByteDoubled => {
                damaged.insert(at, damaged[at]);
                at
            }
            Self::ByteExtra => {
                damaged.insert(at + 1, random.between(1, 254) as u8);
                at + 1
            }
            Self::ByteMissing => {
                damaged.remove(at);
                at
            }
            Self::FlowControl => {
                let at = bytes.iter().position(|byte| matches!(byte, 0x11 | 0x13))?;
                damaged.retain(|byte| !matches!(byte, 0x11 | 0x13));
                at
            }
            Self::LineTurn if at.is_multiple_of(2) => {
                damaged.insert(0, 0);
                0
            }
            Self::LineTurn => {
                damaged.push(0xFF);
                bytes.len()
            }
            Self::TrailingBytes => {
                damaged.extend((0..3).map(|_| random.between(1, 254) as u8));
                bytes.len()
            }
            Self::WrongByte => {
                damaged[at] ^= 1 << random.below(8);
                if let Some(check) = check {
                    let kind = CHECKS.iter().find(|kind| kind.kind == check.kind)?;
                    let wire = kind.wire(check.covered.of(&damaged)).to_be_bytes();
                    damaged[body..body + width].copy_from_slice(&wire[8 - width..]);
                }
                at
            }
        };
        Some((damaged, at))
    }
}

/// What the library finds in a damaged telegram: the cause that it thinks of first, or what is wrong with bytes whose
/// checksum is valid or which have none. `None` where it finds nothing, or something else than what happened.
fn found(telegram: &Telegram, damaged: &[u8]) -> Option<&'static str> {
    let right = &telegram.bytes;
    let lines: Vec<String> = telegram.request.iter().map(|it| hex(it)).chain([hex(damaged)]).collect();
    let options = Options { protocol: Some(telegram.protocol), ..telegram.options.clone() };
    let report = decode(&lines.join("\n"), options);
    let last = report.telegrams.len().checked_sub(1)?;
    (report.telegrams[last].line.bytes == damaged).then_some(())?;
    match report.telegrams[last].verdict {
        Verdict::Wrong => {
            let all = report.explanations(last);
            let first = all.first()?;
            let cause = first.hypothesis.cause.key();
            // A sum leaves open where it happened.
            let open = telegram.check().is_some_and(|check| check.width == 1);
            let fits = all.iter().take(if open { all.len() } else { 1 }).any(|one| {
                let hypothesis = &one.hypothesis;
                (hypothesis.bytes == *right) & (hypothesis.cause.key() == cause)
                    && one.problems == first.problems
            });
            fits.then_some(cause)
        }
        Verdict::Unchecked => None,
        Verdict::Right | Verdict::NoCheck => {
            let fault = change(right, damaged)?;
            let mistaken = telegram.with(damaged.to_vec());
            let seen = has_problems(&report, last);
            let tells = fault == Fault::WrongByte && mistaken.said() != telegram.said();
            (seen || tells).then_some(fault.key())
        }
    }
}

fn has_problems(report: &Report, index: usize) -> bool {
    report.detail(index).is_some_and(|detail| !detail.problems().is_empty())
}

/// What was done to bytes, where it is one thing: a checksum, which follows from them, aside.
fn change(right: &[u8], damaged: &[u8]) -> Option<Fault> {
    let front = right.iter().zip(damaged).take_while(|(right, damaged)| right == damaged).count();
    let (one, other) = (right.get(front..)?, damaged.get(front..)?);
    Some(match damaged.len() as isize - right.len() as isize {
        0 if !one.is_empty() => Fault::WrongByte,
        -1 if one[1..] == *other => Fault::ByteMissing,
        1 if other[1..] == *one && front > 0 && damaged[front - 1] == other[0] => Fault::ByteDoubled,
        1 if other[1..] == *one => Fault::ByteExtra,
        _ => return None,
    })
}

/// A task: what happened to this telegram? `None` where the fault cannot be in it. With the same random numbers
/// it is the same task.
pub fn task(telegram: &Telegram, fault: Fault, random: &mut Random) -> Option<Task> {
    let (bytes, at) = fault.inject(telegram, random)?;
    asked(telegram, bytes, fault, at.from, random)
}

/// The task that a telegram makes with what came instead of it. The message says why there is none.
pub fn hidden(telegram: &Telegram, came: Vec<u8>) -> Result<Task, String> {
    if came == telegram.bytes {
        return Err("What came is what it should be: there is nothing to find.".to_owned());
    }
    let key = found(telegram, &came);
    let Some(fault) = key.and_then(Fault::of) else {
        return Err("Buslens itself would not find what happened to it: hide another fault.".to_owned());
    };
    let at = telegram.bytes.iter().zip(&came).take_while(|(right, came)| right == came).count();
    let words: Vec<u64> = came.iter().map(|byte| u64::from(*byte)).collect();
    asked(telegram, came, fault, at, &mut Random::of(&words))
        .ok_or_else(|| "There is nothing to ask.".to_owned())
}

fn asked(telegram: &Telegram, came: Vec<u8>, fault: Fault, at: usize, random: &mut Random) -> Option<Task> {
    let damaged = telegram.with(came);
    let given = telegram.request.iter().map(|request| {
        let direction = Direction::Request;
        Given::Telegram(Telegram { direction, request: None, ..telegram.with(request.clone()) })
    });
    let said = small(&telegram.said());
    let working = vec![
        format!("It should be: {}.", telegram.hex()),
        format!("Here it is: {}.", damaged.hex()),
        format!("{}, at byte {at}.", fault.label()),
    ];
    let given = given.chain([Given::Telegram(damaged.clone())]).collect();
    if fault == Fault::WrongByte {
        let field = telegram.field_at(at);
        let label = field.as_ref().map_or_else(String::new, |field| small(&field.label().to_string()));
        let span = field.map_or(Span::new(at, at + 1), |field| field.span);
        return Some(Task {
            question: format!("This was to be: {said}. One byte says something else. Which one?"),
            given,
            hints: vec![
                "Read it field by field, and compare each with that sentence.".to_owned(),
                "What counts or repeats something has to agree with what it counts or repeats.".to_owned(),
                format!("It is in the {label}: {}.", bytes_said(span)),
            ],
            working,
            expected: Expected::Byte {
                telegram: damaged,
                right: telegram.clone(),
                at: Span::new(at, at + 1),
            },
        });
    }
    let crc = telegram.check().is_some_and(|check| check.width == 2);
    let fits = |other: &Fault| {
        let apart = other.effect() == Effect::Check || other.effect() != fault.effect();
        *other != fault && apart && (crc || *other != Fault::CheckSwapped)
    };
    let others: Vec<Fault> = Fault::ALL.into_iter().take(OFFERED).filter(fits).collect();
    let mut all = random.some_of(&others, 3);
    all.push(fault);
    random.shuffle(&mut all);
    let right = all.iter().position(|one| *one == fault)?;
    let remark = |one: &Fault| match (one, one.effect()) {
        (Fault::CheckSwapped, _) => {
            "Work out the CRC of the bytes before it: its bytes would only change places."
        }
        (_, Effect::Shorter) => "Count the bytes: are there too few?",
        (_, Effect::Longer) => "Count the bytes: are there too many?",
        _ => "The length is as it should be; compare byte by byte with what was meant.",
    };
    Some(Task {
        question: format!("This was to be: {said}. It came damaged. What happened to it?"),
        given,
        hints: vec![
            "Count the bytes first: are there as many as there should be?".to_owned(),
            "What a telegram of this kind has to hold, and in which order, says where to look.".to_owned(),
            format!("The first byte that is off is byte {at}."),
        ],
        working,
        expected: Expected::Choice {
            choices: all.iter().map(|one| Choice::new(one.label(), remark(one))).collect(),
            right,
        },
    })
}

/// A telegram that somebody pastes, for a fault to be put into: the last one of the text, with the request that it
/// answers. The message says why there is none.
pub fn telegram(
    text: &str,
    protocol: Option<&'static Protocol>,
    device: Option<&'static Profile>,
) -> Result<Telegram, &'static str> {
    let report = decode(text, Options { protocol, device, ..Options::default() });
    let last = report.telegrams.last().ok_or("Paste a telegram in hex, such as 01 03 00 C8 00 03 84 35.")?;
    if !matches!(last.verdict, Verdict::Right | Verdict::NoCheck) {
        return Err(
            "Its checksum is wrong already: paste a telegram that is right, so that there is one fault to find.",
        );
    }
    let mut telegram = Telegram::new(last.line.bytes.clone(), last.guess.direction, last.choice.protocol);
    telegram.request = last.answers.map(|request| report.telegrams[request].line.bytes.clone());
    telegram.options.device = device;
    Ok(telegram)
}

fn small(text: &str) -> String {
    let mut rest = text.trim_end_matches('.').chars();
    rest.next()
        .map_or(String::new(), |first| std::iter::once(first.to_ascii_lowercase()).chain(rest).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const REQUEST: &str = "01 03 00 C8 00 03 84 35";

    fn pair() -> Telegram {
        // The response with a byte 11h, and the CRC that belongs to it.
        let body = [0x01, 0x03, 0x06, 0x00, 0x80, 0x42, 0xA4, 0x11, 0xDE];
        let check = buslens::tool::steps::CHECKS[0].wire(&body) as u16;
        let text = format!("{REQUEST}\n{} {}", hex(&body), hex(&check.to_be_bytes()));
        telegram(&text, None, None).unwrap()
    }

    #[test]
    fn the_same_numbers_give_the_same_task() {
        let made = |seed| task(&pair(), Fault::BitFlipped, &mut Random::of(&[seed])).unwrap();
        assert_eq!(format!("{:?}", made(1).working), format!("{:?}", made(1).working));
        assert!((2..9).any(|seed| made(seed).working != made(1).working));
    }

    #[test]
    fn what_is_no_telegram_is_refused() {
        assert!(telegram("", None, None).is_err());
        assert!(telegram("hello", None, None).is_err());
        assert!(telegram("01 03 00 C8 00 03 84 36", None, None).is_err());
        assert!(
            telegram("01 03 00 C8 00 03 84 35", None, None).is_ok_and(|telegram| telegram.request.is_none())
        );
    }
}

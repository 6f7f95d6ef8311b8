//! Faults put into telegrams on purpose, for others to find: of the kinds that the library looks for where a
//! checksum is wrong, and by their names.

use buslens::field::{Span, hex};
use buslens::tool::{Options, Protocol, decode};

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
}

impl Fault {
    pub const ALL: [Self; 9] = [
        Self::CheckSwapped,
        Self::BitFlipped,
        Self::ByteChanged,
        Self::DigitsSwapped,
        Self::BytesSwapped,
        Self::ByteDoubled,
        Self::ByteExtra,
        Self::ByteMissing,
        Self::FlowControl,
    ];

    /// The stable word of links, which is that of the library's cause.
    pub const fn key(self) -> &'static str {
        match self {
            Self::CheckSwapped => "check-swapped",
            Self::BitFlipped => "bit-flipped",
            Self::ByteChanged => "byte-changed",
            Self::DigitsSwapped => "digits-swapped",
            Self::BytesSwapped => "bytes-swapped",
            Self::ByteDoubled => "byte-doubled",
            Self::ByteExtra => "byte-extra",
            Self::ByteMissing => "byte-missing",
            Self::FlowControl => "flow-control",
        }
    }

    pub fn of(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|fault| fault.key() == key)
    }

    pub const fn label(self) -> &'static str {
        match self {
            Self::CheckSwapped => "The two bytes of the CRC are swapped",
            Self::BitFlipped => "A single bit is flipped",
            Self::ByteChanged => "A byte is another one",
            Self::DigitsSwapped => "The two digits of a byte are swapped",
            Self::BytesSwapped => "Two neighbouring bytes are swapped",
            Self::ByteDoubled => "A byte is there twice",
            Self::ByteExtra => "A byte is too much",
            Self::ByteMissing => "A byte is missing",
            Self::FlowControl => "A converter swallowed 11h or 13h",
        }
    }

    /// The telegram with this fault, and where it is; `None` where it cannot have it, or nobody could find it:
    /// only what the library explains first is a question.
    pub fn inject(self, telegram: &Telegram, random: &mut Random) -> Option<(Vec<u8>, Span)> {
        /// A place by chance may be one where the damage fits something else, too.
        const TRIES: usize = 20;
        (0..TRIES).find_map(|_| {
            let (bytes, at) = self.damage(&telegram.bytes, random)?;
            let at = at.min(bytes.len().saturating_sub(1));
            (bytes != telegram.bytes && found(telegram, &bytes) == Some(self.key()))
                .then_some((bytes, Span::new(at, at + 1)))
        })
    }

    /// Damages bytes somewhere.
    fn damage(self, bytes: &[u8], random: &mut Random) -> Option<(Vec<u8>, usize)> {
        let mut damaged = bytes.to_vec();
        let body = bytes.len().checked_sub(2).filter(|body| *body > 1)?;
        let at = random.below(body);
        let at = match self {
            Self::CheckSwapped => {
                damaged.swap(body, body + 1);
                body
            }
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
        };
        Some((damaged, at))
    }
}

/// The cause that the library thinks of first.
fn found(telegram: &Telegram, damaged: &[u8]) -> Option<&'static str> {
    let lines: Vec<String> = telegram.request.iter().map(|it| hex(it)).chain([hex(damaged)]).collect();
    let options = Options { protocol: Some(telegram.protocol), ..telegram.options.clone() };
    let report = decode(&lines.join("\n"), options);
    let last = report.telegrams.len().checked_sub(1)?;
    (report.telegrams[last].line.bytes == damaged).then_some(())?;
    let first = report.explanations(last).into_iter().next()?;
    (first.hypothesis.bytes == telegram.bytes).then(|| first.hypothesis.cause.key())
}

/// A task: what happened to this telegram? `None` where the fault cannot be in it. With the same random numbers
/// it is the same task.
pub fn task(telegram: &Telegram, fault: Fault, random: &mut Random) -> Option<Task> {
    let (bytes, at) = fault.inject(telegram, random)?;
    let others: Vec<Fault> = Fault::ALL.into_iter().filter(|other| fits(*other, fault)).collect();
    let mut all = random.some_of(&others, 3);
    all.push(fault);
    random.shuffle(&mut all);
    let right = all.iter().position(|one| *one == fault)?;
    let remark = |one: &Fault| match one {
        Fault::CheckSwapped => "Work out the CRC of the bytes before it: its bytes would only change places.",
        Fault::ByteMissing | Fault::FlowControl => "Count the bytes: are there too few?",
        Fault::ByteDoubled | Fault::ByteExtra => "Count the bytes: are there too many?",
        _ => "The length is as it should be; compare byte by byte with what was meant.",
    };
    let damaged = telegram.with(bytes);
    Some(Task {
        question: format!(
            "This was to be: {}. It came damaged. What happened to it?",
            small(&telegram.said())
        ),
        given: telegram
            .request
            .iter()
            .map(|request| {
                let direction = buslens::field::Direction::Request;
                Given::Telegram(Telegram { direction, request: None, ..telegram.with(request.clone()) })
            })
            .chain([Given::Telegram(damaged.clone())])
            .collect(),
        hints: vec![
            "Count the bytes first: are there as many as there should be?".to_owned(),
            "What a telegram of this kind has to hold, and in which order, says where to look.".to_owned(),
            format!("The first byte that is off is byte {}.", at.from),
        ],
        working: vec![
            format!("It should be: {}.", telegram.hex()),
            format!("Here it is: {}.", damaged.hex()),
            format!("{}, at byte {}.", fault.label(), at.from),
        ],
        expected: Expected::Choice {
            choices: all.iter().map(|one| Choice::new(one.label(), remark(one))).collect(),
            right,
        },
    })
}

/// Whether `other` can stand beside `fault` as a wrong choice: what says less of the same is right, too.
fn fits(other: Fault, fault: Fault) -> bool {
    let changed = [Fault::BitFlipped, Fault::ByteChanged, Fault::DigitsSwapped];
    let longer = [Fault::ByteDoubled, Fault::ByteExtra];
    let shorter = [Fault::ByteMissing, Fault::FlowControl];
    let alike = [&changed[..], &longer, &shorter]
        .into_iter()
        .any(|group| group.contains(&fault) && group.contains(&other));
    other != fault && !alike
}

/// A telegram that somebody pastes, for a fault to be put into: the last one of the text, with the request that it
/// answers. The message says why there is none.
pub fn telegram(
    text: &str,
    device: Option<&'static buslens::tool::Profile>,
) -> Result<Telegram, &'static str> {
    let rtu = Protocol::of("modbus-rtu");
    let report = decode(text, Options { protocol: rtu, device, ..Options::default() });
    let last = report.telegrams.last().ok_or("Paste a telegram of Modbus RTU, in hex, with its CRC.")?;
    if last.verdict != buslens::tool::Verdict::Right {
        return Err(
            "Its CRC is wrong already: paste a telegram that is right, so that there is one fault to find.",
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
    use crate::{Answer, grade};

    const REQUEST: &str = "01 03 00 C8 00 03 84 35";

    fn pair() -> Telegram {
        // The response with a byte 11h, and the CRC that belongs to it.
        let body = [0x01, 0x03, 0x06, 0x00, 0x80, 0x42, 0xA4, 0x11, 0xDE];
        let check = buslens::tool::steps::CHECKS[0].wire(&body) as u16;
        let text = format!("{REQUEST}\n{} {}", hex(&body), hex(&check.to_be_bytes()));
        telegram(&text, None).unwrap()
    }

    #[test]
    fn each_fault_is_found_and_is_a_task() {
        let telegram = pair();
        assert!(telegram.request.is_some());
        for fault in Fault::ALL {
            let made = (0..8).find_map(|seed| task(&telegram, fault, &mut Random::of(&[seed])));
            let task = made.unwrap_or_else(|| panic!("{fault:?} cannot be put into it"));
            let Expected::Choice { choices, right } = &task.expected else { panic!() };
            assert_eq!((choices.len(), choices[*right].text.as_str()), (4, fault.label()));
            for at in 0..4 {
                assert_eq!(grade(&task, &Answer::Choice(at)).is_right(), at == *right);
            }
        }
    }

    #[test]
    fn the_same_numbers_give_the_same_task() {
        let made = |seed| task(&pair(), Fault::BitFlipped, &mut Random::of(&[seed])).unwrap();
        assert_eq!(format!("{:?}", made(1).working), format!("{:?}", made(1).working));
        assert!((2..9).any(|seed| made(seed).working != made(1).working));
    }

    #[test]
    fn what_is_no_telegram_is_refused() {
        assert!(telegram("", None).is_err());
        assert!(telegram("hello", None).is_err());
        assert!(telegram("01 03 00 C8 00 03 84 36", None).is_err());
        assert!(telegram("01 03 00 C8 00 03 84 35", None).is_ok_and(|telegram| telegram.request.is_none()));
    }
}

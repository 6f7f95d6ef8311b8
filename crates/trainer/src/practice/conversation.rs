//! What is wrong with a conversation, and who did not answer.

use buslens::field::{Format, Order, Role, hex};

use super::make::{confirmed, quarters, rejected, rtu, short, values, word, write};
use super::{Slot, Slots};
use crate::random::Random;
use crate::task::{Choice, Expected, Given, Number, Task, Telegram};

pub const SLOTS: Slots = [LEVEL_1, LEVEL_2, LEVEL_3];
pub const SILENCE: Slots = [SILENCE_1, SILENCE_2, SILENCE_3];

/// What can be wrong with a conversation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Trouble {
    Nothing,
    Unanswered,
    Rejected,
    Damaged,
    CheckSwapped,
    Echo,
    ByteLost,
    OtherUnit,
    ByteCount,
    FlowControl,
    WordOrder,
    Late,
    OtherRegisters,
    Retry,
}

impl Trouble {
    pub(crate) const ALL: [Self; 14] = [
        Self::Nothing,
        Self::Unanswered,
        Self::Rejected,
        Self::Damaged,
        Self::CheckSwapped,
        Self::Echo,
        Self::ByteLost,
        Self::OtherUnit,
        Self::ByteCount,
        Self::FlowControl,
        Self::WordOrder,
        Self::Late,
        Self::OtherRegisters,
        Self::Retry,
    ];

    /// The rule that tells it, whatever log it is in.
    pub(crate) const fn rule(self) -> &'static str {
        told(self)[1]
    }

    /// How a choice names it.
    pub(crate) const fn text(self) -> &'static str {
        match self {
            Self::Nothing => "Nothing: each request has its response",
            Self::Unanswered => "A request stays unanswered",
            Self::Rejected => "The unit rejects a request",
            Self::Damaged => "A byte was changed on the line: the CRC is wrong",
            Self::CheckSwapped => "The two bytes of the CRC are in the wrong order",
            Self::Echo => "The client hears itself: an echo of RS-485",
            Self::ByteLost => "A byte of a response was lost",
            Self::OtherUnit => "Another unit answers than was asked",
            Self::ByteCount => "The byte count says more than follows, although the CRC is valid",
            Self::FlowControl => "A converter swallows the bytes 11h and 13h (XON/XOFF)",
            Self::WordOrder => "The two words of a float come in the other order than was agreed",
            Self::Late => "A response comes so late that the client asks again",
            Self::OtherRegisters => "The response has more registers than were asked for",
            Self::Retry => "A request is repeated, since nobody answered the first time",
        }
    }

    /// What there is to say to who chose it wrongly.
    pub(crate) const fn remark(self) -> &'static str {
        match self {
            Self::Nothing => "Go through it pair by pair: something is not as it should be.",
            Self::Unanswered => "Look again: behind every request comes something of the same unit.",
            Self::Rejected => "A rejection has 80h added to the function code. There is none here.",
            Self::Damaged => {
                "That would show as a single changed byte. Compare what is there with what should be."
            }
            Self::CheckSwapped => "Work out the CRC of one telegram: is it the other way round? It is not.",
            Self::Echo => "An echo would be the request once more, byte for byte, before the response.",
            Self::ByteLost => "Count the bytes behind the byte count: are there too few?",
            Self::OtherUnit => "Compare the first byte of each response with that of its request.",
            Self::ByteCount => "The byte count and the bytes that follow: do they agree?",
            Self::FlowControl => "Then bytes 11h and 13h would be missing, and only those.",
            Self::WordOrder => "Put the two words of the value the other way round: does it make sense then?",
            Self::Late => "Compare the times: how long does the response take?",
            Self::OtherRegisters => {
                "Compare the quantity that is asked with the byte count: two bytes a register."
            }
            Self::Retry => "Then the same request would stand there twice.",
        }
    }
}

const LEVEL_1: [Slot; 5] = [
    |random| {
        let others = [Trouble::Nothing, Trouble::Rejected, Trouble::Damaged];
        conversation(random, Trouble::Unanswered, &others, |log, random, at| {
            log.exchange(random, at != 1);
        })
    },
    |random| {
        let others = [Trouble::Nothing, Trouble::Unanswered, Trouble::Damaged];
        conversation(random, Trouble::Rejected, &others, |log, random, at| {
            if at == 1 {
                let request = log.request(random);
                log.send(&request);
                let code = random.one_of(&[1, 2, 3]);
                log.answer(&rejected(&request, code).bytes, 12);
            } else {
                log.exchange(random, true);
            }
        })
    },
    |random| {
        let others = [Trouble::Nothing, Trouble::Unanswered, Trouble::Rejected];
        conversation(random, Trouble::Damaged, &others, |log, random, at| {
            let (request, mut answer) = log.pair(random);
            if at == 1 {
                answer[4] ^= 1 << random.below(8);
            }
            log.send(&request);
            log.answer(&answer, 12);
        })
    },
    |random| {
        let others = [Trouble::Unanswered, Trouble::Rejected, Trouble::Damaged];
        conversation(random, Trouble::Nothing, &others, |log, random, _| log.exchange(random, true))
    },
    |random| {
        let others = [Trouble::Nothing, Trouble::Unanswered, Trouble::Rejected];
        conversation(random, Trouble::CheckSwapped, &others, |log, random, _| {
            let (request, mut answer) = log.pair(random);
            let end = answer.len();
            answer.swap(end - 1, end - 2);
            log.send(&request);
            log.answer(&answer, 12);
        })
    },
];

const LEVEL_2: [Slot; 5] = [
    |random| {
        let others = [Trouble::Retry, Trouble::Nothing, Trouble::OtherUnit];
        conversation(random, Trouble::Echo, &others, |log, random, _| {
            let (request, answer) = log.pair(random);
            log.send(&request);
            log.answer(&request.bytes, 1);
            log.answer(&answer, 12);
        })
    },
    |random| {
        let others = [Trouble::ByteCount, Trouble::OtherRegisters, Trouble::Damaged];
        conversation(random, Trouble::ByteLost, &others, |log, random, at| {
            let (request, mut answer) = log.pair(random);
            if at == 1 {
                answer.remove(4);
            }
            log.send(&request);
            log.answer(&answer, 12);
        })
    },
    |random| {
        let others = [Trouble::Unanswered, Trouble::Damaged, Trouble::Echo];
        conversation(random, Trouble::OtherUnit, &others, |log, random, at| {
            let (request, mut answer) = log.pair(random);
            if at == 1 {
                answer.truncate(answer.len() - 2);
                answer[0] = 1 + (answer[0] - 1 + random.between(1, 29) as u8) % 31;
                answer = rtu(&answer);
            }
            log.send(&request);
            log.answer(&answer, 12);
        })
    },
    |random| {
        let others = [Trouble::ByteLost, Trouble::Damaged, Trouble::Nothing];
        conversation(random, Trouble::ByteCount, &others, |log, random, at| {
            let (request, mut answer) = log.pair(random);
            if at == 1 {
                answer.truncate(answer.len() - 2);
                answer[2] += 2;
                answer = rtu(&answer);
            }
            log.send(&request);
            log.answer(&answer, 12);
        })
    },
    |random| {
        let others = [Trouble::Echo, Trouble::Nothing, Trouble::OtherUnit];
        conversation(random, Trouble::Retry, &others, |log, random, at| {
            let (request, answer) = log.pair(random);
            if at == 1 {
                log.send(&request);
                log.pass(1000);
            }
            log.send(&request);
            log.answer(&answer, 12);
        })
    },
];

const LEVEL_3: [Slot; 5] = [
    |random| {
        let others = [Trouble::OtherRegisters, Trouble::ByteCount, Trouble::Damaged];
        conversation(random, Trouble::FlowControl, &others, |log, random, at| {
            let request = short(log.unit, 3, log.address, 2);
            let swallowed = [0x11, 0x13][at % 2];
            let data = [word(random).to_be_bytes(), [random.between(0x20, 0x60) as u8, swallowed]].concat();
            let answer: Vec<u8> = values(&request, &data).bytes;
            let kept = |at: &usize| !matches!(answer[*at], 0x11 | 0x13) || *at < 3;
            let answer: Vec<u8> = (0..answer.len()).filter(kept).map(|at| answer[at]).collect();
            log.send(&request);
            log.answer(&answer, 12);
        })
    },
    |random| {
        let others = [Trouble::Nothing, Trouble::Damaged, Trouble::ByteCount];
        let mut task = conversation(random, Trouble::WordOrder, &others, |log, random, _| {
            let request = short(log.unit, 3, log.address, 2);
            let raw = quarters(random).to_bits();
            log.send(&request);
            log.answer(&values(&request, &Order::LowWordFirst.bytes(raw.into(), 4)).bytes, 12);
        });
        task.question =
            "The two registers are to hold a float between 0 and 600, the high word first. What is wrong?"
                .to_owned();
        task
    },
    |random| {
        let others = [Trouble::Unanswered, Trouble::Echo, Trouble::Damaged];
        conversation(random, Trouble::Late, &others, |log, random, at| {
            let (request, answer) = log.pair(random);
            log.send(&request);
            if at == 1 {
                log.pass(1000);
                log.send(&request);
                log.answer(&answer, 350);
                log.answer(&answer, 12);
            } else {
                log.answer(&answer, 12);
            }
        })
    },
    |random| {
        let others = [Trouble::ByteCount, Trouble::ByteLost, Trouble::Nothing];
        conversation(random, Trouble::OtherRegisters, &others, |log, random, at| {
            let (request, answer) = log.pair(random);
            log.send(&request);
            if at == 1 {
                let data = [&answer[3..answer.len() - 2], &word(random).to_be_bytes()[..]].concat();
                log.answer(&values(&request, &data).bytes, 12);
            } else {
                log.answer(&answer, 12);
            }
        })
    },
    |random| {
        let others = [Trouble::Nothing, Trouble::OtherUnit, Trouble::Damaged];
        conversation(random, Trouble::Unanswered, &others, |log, random, at| {
            let data = [word(random).to_be_bytes(), word(random).to_be_bytes()].concat();
            let request = write(log.unit, log.address, &data);
            log.send(&request);
            if at != 2 {
                log.answer(&confirmed(&request).bytes, 12);
            }
        })
    },
];

const SILENCE_1: [Slot; 5] = [two_units, two_units, two_units, two_units, two_units];

const SILENCE_2: [Slot; 5] = [three_units, three_units, three_units, three_units, three_units];

const SILENCE_3: [Slot; 5] = [many_units, many_units, many_units, many_units, many_units];

/// Lines of a log, as they are written.
struct Log {
    lines: Vec<String>,
    /// Milliseconds since midnight.
    time: usize,
    unit: u8,
    address: u16,
}

impl Log {
    fn new(random: &mut Random) -> Self {
        let time = random.between(8 * 3_600_000, 17 * 3_600_000);
        let address = u16::from_be_bytes([random.between(1, 4) as u8, random.between(0x20, 0x60) as u8]);
        // Units 11h and 13h would be swallowed themselves.
        let unit = random.between(2, 15) as u8;
        Self { lines: Vec::new(), time, unit, address }
    }

    fn line(&mut self, arrow: &str, bytes: &[u8]) {
        let (hours, minutes) = (self.time / 3_600_000, self.time / 60_000 % 60);
        let (seconds, thousandths) = (self.time / 1000 % 60, self.time % 1000);
        self.lines
            .push(format!("{hours:02}:{minutes:02}:{seconds:02}.{thousandths:03} {arrow} {}", hex(bytes)));
    }

    fn send(&mut self, request: &Telegram) {
        self.line("TX", &request.bytes);
        self.time += request.bytes.len();
    }

    fn answer(&mut self, bytes: &[u8], after: usize) {
        self.time += after;
        self.line("RX", bytes);
        self.time += 90;
    }

    fn pass(&mut self, milliseconds: usize) {
        self.time += milliseconds;
    }

    fn request(&self, random: &mut Random) -> Telegram {
        short(self.unit, 3, self.address + random.below(0x60) as u16, 2)
    }

    /// A request for two registers, and its answer.
    fn pair(&self, random: &mut Random) -> (Telegram, Vec<u8>) {
        let request = self.request(random);
        let data = [word(random).to_be_bytes(), word(random).to_be_bytes()].concat();
        let answer = values(&request, &data).bytes;
        (request, answer)
    }

    fn exchange(&mut self, random: &mut Random, answered: bool) {
        let (request, answer) = self.pair(random);
        self.send(&request);
        match answered {
            true => self.answer(&answer, 12),
            false => self.pass(1000),
        }
    }
}

/// How many exchanges a conversation has.
const EXCHANGES: usize = 3;

/// A conversation in which `write` writes exchange after exchange.
fn conversation(
    random: &mut Random,
    trouble: Trouble,
    others: &[Trouble; 3],
    write: fn(&mut Log, &mut Random, usize),
) -> Task {
    let mut log = Log::new(random);
    (0..EXCHANGES).for_each(|at| write(&mut log, random, at));
    let mut all = [&others[..], &[trouble]].concat();
    random.shuffle(&mut all);
    let right = all.iter().position(|one| *one == trouble).unwrap_or_default();
    let choices = all.iter().map(|one| Choice::new(one.text(), one.remark())).collect();
    let [place, rule, last, why] = told(trouble);
    Task {
        question: "TX is what the client sends, RX what it hears. What is wrong here?".to_owned(),
        hints: [place, rule, last].map(str::to_owned).to_vec(),
        working: vec![
            "Pair each request with what follows it: same unit, same function, a byte count that fits."
                .to_owned(),
            why.to_owned(),
            format!("So: {}.", super::make::small(trouble.text())),
        ],
        given: vec![Given::Text(log.lines.join("\n"))],
        expected: Expected::Choice { choices, right },
    }
}

/// Three hints, and what shows the fault.
const fn told(trouble: Trouble) -> [&'static str; 4] {
    const PAIRS: &str = "Go through it line by line: which response belongs to which request?";
    match trouble {
        Trouble::Nothing => [
            PAIRS,
            "A healthy response has the unit and the function of its request, and twice as many bytes as registers were asked for.",
            "Is there anything at all that does not fit?",
            "Every request is followed by a response of the same unit and function, with four bytes for two registers.",
        ],
        Trouble::Unanswered => [
            PAIRS,
            "Behind each TX there should be one RX of the same unit.",
            "Look for two TX, one after the other, or a TX at the end.",
            "One request is followed by no response.",
        ],
        Trouble::Rejected => [
            PAIRS,
            "Compare the second byte of each response with that of its request.",
            "03h + 80h = 83h: one response begins so.",
            "One response has function 83h: an exception, with a code behind it.",
        ],
        Trouble::Damaged => [
            PAIRS,
            "All responses have the right length and begin as they should. So what is left to be wrong?",
            "The CRC of the second response does not fit its bytes: paste it into Read to see that.",
            "The second response is complete, and its CRC is not that of its bytes: one bit is another.",
        ],
        Trouble::CheckSwapped => [
            "Look at the last two bytes of each line.",
            "The CRC goes low byte first. In the requests it does.",
            "Swap the last two bytes of a response: then its CRC is valid.",
            "The responses are right but for their CRC, whose bytes are the other way round.",
        ],
        Trouble::Echo => [
            "Compare each TX with the line behind it.",
            "On RS-485 with two wires everybody hears everything, also himself.",
            "The first RX behind each TX is the request itself, one millisecond later.",
            "Each request comes back byte for byte before its response.",
        ],
        Trouble::ByteLost => [
            "Count the bytes of each response.",
            "Unit, function, byte count, then as many bytes as it says, then two of CRC.",
            "The second response has 8 bytes where the others have 9.",
            "The second response says 4 bytes, and 3 are there before the CRC.",
        ],
        Trouble::OtherUnit => [
            "Compare the first bytes.",
            "Who is asked should be who answers.",
            "Look at the first byte of the second response.",
            "The second response begins with another unit, and its CRC is valid: two units have been mixed up.",
        ],
        Trouble::ByteCount => [
            "Count the bytes of each response.",
            "The third byte says how many bytes follow before the CRC.",
            "Look at the third byte of the second response: 06, and 4 follow.",
            "The second response says 6 bytes and has 4; its CRC is valid, so the device itself sends it so.",
        ],
        Trouble::FlowControl => [
            "Count the bytes of each response.",
            "Which bytes are missing? Two values never appear in any response.",
            "Bytes 11h and 13h stop and start the flow on some converters (XON/XOFF).",
            "Each response is a byte short, and what would make its CRC valid is a byte 11h or 13h.",
        ],
        Trouble::WordOrder => [
            "Take the four bytes of a response as a float.",
            "A float of usual size begins with 41, 42, 43 or 44.",
            "The second word of each response begins so, not the first.",
            "With the two words the other way round, each response is a float between 0 and 600.",
        ],
        Trouble::Late => [
            "Look at the times.",
            "How long after a request does its response come?",
            "The second request is repeated after a second; then two responses come.",
            "The response to the first try comes when the client has asked again, and then a second one.",
        ],
        Trouble::OtherRegisters => [
            "Compare what is asked with what comes.",
            "A quantity of 2 makes 4 bytes.",
            "The second response has a byte count of 6.",
            "Two registers were asked for, and the second response has three; its CRC is valid.",
        ],
        Trouble::Retry => [
            PAIRS,
            "Is there a request twice?",
            "The second request stands there twice, a second apart.",
            "Nobody answered the second request; a second later the client asked the same again.",
        ],
    }
}

/// Units that are asked in turn, two of them.
fn two_units(random: &mut Random) -> Task {
    polled(random, 2, |_, _, _| {})
}

/// Three, one of which rejects: that is an answer, too.
fn three_units(random: &mut Random) -> Task {
    polled(random, 3, |log, random, units| {
        let request = short(units[0], 3, log.address, 2);
        log.send(&request);
        let code = random.one_of(&[2, 3]);
        log.answer(&rejected(&request, code).bytes, 12);
    })
}

/// Four, with a broadcast that nobody answers, and a retry that somebody does.
fn many_units(random: &mut Random) -> Task {
    polled(random, 4, |log, random, units| {
        log.send(&write(0, log.address, &word(random).to_be_bytes()));
        log.pass(200);
        let request = short(units[0], 3, log.address, 2);
        log.send(&request);
        log.pass(1000);
        log.send(&request);
        let data = [word(random).to_be_bytes(), word(random).to_be_bytes()].concat();
        log.answer(&values(&request, &data).bytes, 12);
    })
}

/// So many units are asked in turn; one of them, not the first, stays silent. `between` is put behind the
/// first round.
fn polled(random: &mut Random, count: usize, between: fn(&mut Log, &mut Random, &[u8])) -> Task {
    const ROUNDS: usize = 2;
    let mut log = Log::new(random);
    // Two hex digits, so that reading them as decimal ones shows.
    let units = random.some_of(&[0x10, 0x12, 0x14, 0x15, 0x16, 0x18, 0x19, 0x21, 0x23, 0x25], count);
    let silent = units[random.between(1, count - 1)];
    for round in 0..ROUNDS {
        for unit in &units {
            let request = short(*unit, 3, log.address + random.below(0x60) as u16, 1);
            log.send(&request);
            if *unit == silent {
                log.pass(1000);
            } else {
                let answer = values(&request, &word(random).to_be_bytes());
                log.answer(&answer.bytes, 12);
            }
        }
        if round == 0 {
            between(&mut log, random, &units);
        }
    }
    let number = Number::new("Unit", silent.into(), 1, Format::Decimal).role(Role::Unit);
    let others: Vec<String> =
        units.iter().filter(|unit| **unit != silent).map(|unit| unit.to_string()).collect();
    let mut working = vec![
        "The first byte of each request says who is asked, the first byte of each response who speaks."
            .to_owned(),
        format!("These answered: {}.", others.join(", ")),
        format!("{silent:02X}h was asked {ROUNDS} times and never answered: unit {silent}."),
    ];
    if count > 2 {
        working.insert(
            2,
            if count == 3 {
                "An exception is a response, too.".to_owned()
            } else {
                "Nobody answers unit 0, a broadcast; and who answers at the second try is not silent."
                    .to_owned()
            },
        );
    }
    Task {
        question: "Several units are asked in turn. Which one never answers? Give its address in decimal.".to_owned(),
        hints: vec![
            "Look for a TX without an RX behind it.".to_owned(),
            match count {
                2 => "The first byte is the unit, in hex.",
                3 => "An exception is a response, too. The first byte is the unit, in hex.",
                _ => "A broadcast (unit 0) is answered by nobody; a retry may be answered. The first byte is the unit, in hex.",
            }
            .to_owned(),
            format!("It is {silent:02X}h: {} × 16 + {}.", silent >> 4, silent & 15),
        ],
        working,
        given: vec![Given::Text(log.lines.join("\n"))],
        expected: Expected::Number(number),
    }
}

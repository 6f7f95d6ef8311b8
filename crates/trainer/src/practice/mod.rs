//! Practice without end: tasks that are made of a seed.
//!
//! A kind, a level and a seed make a round of [`QUESTIONS`] tasks. Each level has a list of slots: what is asked
//! there is the same in every round, and so is how much there is to work out; units, addresses, values, the place of
//! a fault and the order are drawn. So two seeds are equally hard, and [`Measure`] says by which measure.
//!
//! | file | what is asked |
//! | --- | --- |
//! | `decode` | what does it say? |
//! | `find` | which byte is wrong? |
//! | `complete` | what belongs into the blanks? |
//! | `build` | which telegram does this? |
//! | `conversation` | what is wrong with a conversation, and who did not answer |
//!
//! What a link asks never changes: whatever would ask something else for a seed is another [`VERSION`], beside
//! the one that there is. `tests/practice` has the questions of some seeds; a change there is a fault.

mod build;
mod complete;
mod conversation;
mod decode;
mod find;
mod make;

pub(crate) use conversation::Trouble;
pub(crate) use make::{all_fields, bytes_said};

use crate::random::Random;
use crate::task::{Expected, Given, Task};

/// The version of the generator, as links have it.
pub const VERSION: u8 = 1;

/// How many questions a round has.
pub const QUESTIONS: usize = 5;

/// What is practised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Decode,
    Find,
    Complete,
    Build,
    Conversation,
    Silence,
}

impl Kind {
    pub const ALL: [Self; 6] =
        [Self::Decode, Self::Find, Self::Complete, Self::Build, Self::Conversation, Self::Silence];

    /// The stable word of links.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Decode => "decode",
            Self::Find => "find",
            Self::Complete => "complete",
            Self::Build => "build",
            Self::Conversation => "conversation",
            Self::Silence => "silence",
        }
    }

    pub const fn label(self) -> &'static str {
        match self {
            Self::Decode => "Decode this",
            Self::Find => "Find the wrong byte",
            Self::Complete => "Complete it",
            Self::Build => "Build a telegram",
            Self::Conversation => "What went wrong?",
            Self::Silence => "Who did not answer?",
        }
    }

    /// What there is to do, in a few words.
    pub const fn note(self) -> &'static str {
        match self {
            Self::Decode => "Read values out of bytes.",
            Self::Find => "One byte of a telegram is not as it should be.",
            Self::Complete => "Some bytes are missing: fill them in.",
            Self::Build => "A sentence says what to do; you write the bytes.",
            Self::Conversation => "Read a log, and name the cause.",
            Self::Silence => "Several units are asked; one stays silent.",
        }
    }

    /// What level `level` is about.
    pub const fn level_note(self, level: u8) -> &'static str {
        match (self, level) {
            (Self::Decode, 1) => "unit, address, quantity, register",
            (Self::Decode, 2) => "signed numbers, coils, exceptions, status",
            (Self::Decode, _) => "floats, word order, mapping lists, the parameter channel",
            (Self::Find, 1) => "requests, and what they should say",
            (Self::Find, 2) => "responses, and what was asked",
            (Self::Find, _) => "floats, status, PROFIBUS",
            (Self::Complete, 1) => "one field",
            (Self::Complete, 2) => "two fields",
            (Self::Complete, _) => "values, exceptions, other frames",
            (Self::Build, 1) => "read and write by address",
            (Self::Build, 2) => "by register number and by name",
            (Self::Build, _) => "floats, mapping lists, the parameter channel",
            (Self::Conversation, 1) => "silence, exceptions, wrong checksums",
            (Self::Conversation, 2) => "echoes, lost bytes, wrong units",
            (Self::Conversation, _) => "flow control, word order, lateness",
            (Self::Silence, 1) => "two units",
            (Self::Silence, 2) => "three units, with an exception",
            (Self::Silence, _) => "retries, broadcasts, late responses",
        }
    }

    pub fn of(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.key() == key)
    }
}

/// The levels that each kind has.
pub const LEVELS: std::ops::RangeInclusive<u8> = 1..=3;

/// A seed: 20 bits, which are four letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seed(u32);

/// Letters and digits that nobody takes for another: no I, L, O and U.
pub(crate) const LETTERS: &[u8; 32] = b"0123456789ABCDEFGHJKMNPQRSTVWXYZ";

/// The number of a letter; letters that look like a digit are that digit.
pub(crate) fn letter_number(letter: char) -> Option<u32> {
    let letter = match letter.to_ascii_uppercase() {
        'O' => '0',
        'I' | 'L' => '1',
        letter => letter,
    };
    LETTERS.iter().position(|known| char::from(*known) == letter).map(|at| at as u32)
}

impl Seed {
    /// How many there are.
    pub const COUNT: u32 = 1 << 20;

    /// Any number makes one.
    pub const fn new(number: u64) -> Self {
        Self((number % Self::COUNT as u64) as u32)
    }

    pub const fn number(self) -> u32 {
        self.0
    }

    /// The seed that these letters write.
    pub fn of(text: &str) -> Option<Self> {
        let numbers: Option<Vec<u32>> = text.trim().chars().map(letter_number).collect();
        let numbers = numbers.filter(|numbers| numbers.len() == 4)?;
        Some(Self(numbers.into_iter().fold(0, |seed, number| seed << 5 | number)))
    }

    /// The seed of the next round, when nobody wishes another.
    pub fn next(self) -> Self {
        Self::new(Random::of(&[u64::from(self.0)]).draw())
    }
}

impl std::fmt::Display for Seed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        (0..4)
            .rev()
            .try_for_each(|at| write!(f, "{}", char::from(LETTERS[(self.0 >> (5 * at) & 31) as usize])))
    }
}

/// A round: so many questions of a kind and a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Round {
    pub kind: Kind,
    pub level: u8,
    pub seed: Seed,
}

/// Why words of a link name no round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoRound {
    /// A newer page made the link.
    Newer,
    /// The link is incomplete or damaged.
    Damaged,
}

impl Round {
    /// What stands in a link, with points between: version, kind, level, seed.
    pub fn place(&self) -> String {
        format!("{VERSION}.{}.{}.{}", self.kind.key(), self.level, self.seed)
    }

    /// The round that words of a link name, and which question, from 0.
    pub fn of(place: &str) -> Result<(Self, usize), NoRound> {
        let mut words = place.split('.');
        let version: u8 = words.next().and_then(|word| word.parse().ok()).ok_or(NoRound::Damaged)?;
        if version > VERSION {
            return Err(NoRound::Newer);
        }
        let kind = words.next().and_then(Kind::of);
        let level = words.next().and_then(|word| word.parse().ok()).filter(|level| LEVELS.contains(level));
        let seed = words.next().and_then(Seed::of);
        let question = match words.next() {
            None => Some(1),
            Some(word) => word.parse().ok().filter(|number| (1..=QUESTIONS).contains(number)),
        };
        match (version, kind, level, seed, question) {
            (VERSION, Some(kind), Some(level), Some(seed), Some(question)) => {
                Ok((Self { kind, level, seed }, question - 1))
            }
            _ => Err(NoRound::Damaged),
        }
    }

    /// Its questions, in their order.
    pub fn questions(&self) -> Vec<Task> {
        let words = [u64::from(VERSION), self.kind as u64, self.level.into(), self.seed.0.into()];
        let slots = self.slots();
        let mut order: Vec<usize> = (0..slots.len()).collect();
        Random::of(&words).shuffle(&mut order);
        let question = |slot: usize| {
            let mut random = Random::of(&[&words[..], &[slot as u64 + 1]].concat());
            slots[slot](&mut random)
        };
        order.into_iter().map(question).collect()
    }

    fn slots(&self) -> [Slot; QUESTIONS] {
        let levels = match self.kind {
            Kind::Decode => &decode::SLOTS,
            Kind::Find => &find::SLOTS,
            Kind::Complete => &complete::SLOTS,
            Kind::Build => &build::SLOTS,
            Kind::Conversation => &conversation::SLOTS,
            Kind::Silence => &conversation::SILENCE,
        };
        levels[usize::from(self.level.clamp(*LEVELS.start(), *LEVELS.end()) - 1)]
    }

    /// How hard it is.
    pub fn measure(&self) -> Measure {
        let all = self.questions();
        all.iter().map(Measure::of).fold(Measure::default(), |sum, one| Measure {
            bytes: sum.bytes + one.bytes,
            steps: sum.steps + one.steps,
            choices: sum.choices + one.choices,
            answer: sum.answer + one.answer,
        })
    }
}

/// Makes the task of a slot.
type Slot = fn(&mut Random) -> Task;

/// What each level has in its slots.
type Slots = [[Slot; QUESTIONS]; 3];

/// How much there is to do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Measure {
    /// Bytes to look at.
    pub bytes: usize,
    /// Steps of the working.
    pub steps: usize,
    /// Choices to weigh.
    pub choices: usize,
    /// Bytes of the answer.
    pub answer: usize,
}

impl Measure {
    pub fn of(task: &Task) -> Self {
        let bytes = |given: &Given| match given {
            Given::Telegram(telegram) => telegram.bytes.len(),
            // Two digits and what parts them.
            Given::Text(text) => text.len() / 3,
        };
        let (choices, answer) = match &task.expected {
            Expected::Telegram(telegram) => (0, telegram.bytes.len()),
            Expected::Number(number) => (0, number.width),
            Expected::Choice { choices, .. } => (choices.len(), 1),
            Expected::Byte { telegram, .. } => (telegram.bytes.len(), 1),
            Expected::Blanks { blanks, .. } => (0, blanks.iter().map(|blank| blank.span.len()).sum()),
        };
        Self { bytes: task.given.iter().map(bytes).sum(), steps: task.working.len(), choices, answer }
    }

    /// All in one number.
    pub const fn total(self) -> usize {
        self.bytes + 4 * self.steps + self.choices + 3 * self.answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lead_back() {
        for kind in Kind::ALL {
            let round = Round { kind, level: 2, seed: Seed::new(987_654_321) };
            assert_eq!(Round::of(&round.place()), Ok((round, 0)));
            assert_eq!(Round::of(&format!("{}.4", round.place())), Ok((round, 3)));
        }
        assert_eq!(Round::of("2.decode.1.AAAA"), Err(NoRound::Newer));
        for damaged in [
            "",
            "1",
            "1.decode",
            "1.decode.4.AAAA",
            "1.decode.1.AAA",
            "1.x.1.AAAA",
            "1.decode.1.AAAA.6",
            "0.decode.1.AAAA",
        ] {
            assert_eq!(Round::of(damaged), Err(NoRound::Damaged), "{damaged}");
        }
    }

    #[test]
    fn seeds_are_four_letters() {
        for number in [0, 1, 31, 32, 1_048_575] {
            let seed = Seed::new(number);
            assert_eq!(Seed::of(&seed.to_string()), Some(seed));
        }
        assert_eq!(Seed::of("o1iL"), Seed::of("0111"));
        assert_eq!(Seed::of("UUUU"), None);
        assert_ne!(Seed::new(5).next(), Seed::new(5));
    }
}

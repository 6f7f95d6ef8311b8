use super::Detail;
use super::decode::{Options, Report};
use crate::device::{Misprint, PROFILES};
use crate::dialogue::{self, Cause, Certainty, Context, Guess, Hypothesis, chance_of_change, hypotheses};
use crate::field::{self, Message, Span};
use crate::frame::{Frame, Speaker, Verdict, modbus_rtu};
use crate::message;
use crate::walk;

/// Possible causes to a telegram whose check does not match.
#[derive(Clone, Debug)]
pub struct Explanation {
    pub hypothesis: Hypothesis,
    /// How many things would still be wrong with the telegram.
    pub problems: usize,
    /// Whether the content fits what the device's manual says.
    pub known: bool,
    /// What the telegram would then say.
    pub said: Message,
    /// The bytes of the telegram as it came that are changed or too much.
    pub removed: Vec<Span>,
    /// The bytes of the corrected telegram that are changed or were missing.
    pub added: Vec<Span>,
}

impl Explanation {
    /// Why it makes sense, or what speaks against it.
    pub fn sense(&self) -> Message {
        match (self.problems, self.known) {
            (0, true) => message!("byte count and length fit, and the device knows these registers"),
            (0, false) => message!("byte count and length fit"),
            (problems, _) => message!("{n} would remain", n = field::count(problems, "problem")),
        }
    }
}

/// More are not worth reading.
const MOST: usize = 10;

/// What a manual means that prints these bytes.
fn misprint(bytes: &[u8]) -> Option<Hypothesis> {
    let mut misprints = PROFILES.iter().flat_map(|profile| profile.misprints);
    let Misprint { section, slips, right, .. } = misprints.find(|misprint| misprint.printed == bytes)?;
    Some(Hypothesis::known(Cause::Misprint { section, slips }, bytes, right.to_vec()))
}

impl Report {
    /// Possible causes to telegram `index`, best first: what leaves nothing wrong before what
    /// does; then by how often such a thing happens and in how many ways it could have. Empty where
    /// the check is right, or where there is none.
    pub fn explanations(&self, index: usize) -> Vec<Explanation> {
        let telegram = self.telegrams.get(index).filter(|telegram| telegram.verdict != Verdict::Right);
        let Some(telegram) = telegram else { return Vec::new() };
        let printed = misprint(&telegram.line.bytes);
        if telegram.verdict != Verdict::Wrong {
            // A misprint may look like a telegram whose end is missing.
            return printed.map(|printed| self.explain(index, printed, None)).into_iter().collect();
        }
        let bytes_of = |index: usize| self.telegrams[index].line.bytes.as_slice();
        let before = telegram.answers.or(index.checked_sub(1)).map(bytes_of);
        let others = self.neighbours(index);
        let lost = |code: &str| matches!(code, "single-digit" | "odd-digits" | "digit-missing");
        let digit_lost = telegram.line.remarks.iter().any(|remark| lost(remark.code));
        let context = Context { request: before, others: &others, digit_lost };
        let asked = telegram.answers.map(|request| self.read(request).0);
        let mut found: Vec<Explanation> = Vec::new();
        let known = printed.as_ref().map(|known| known.bytes.clone());
        for hypothesis in hypotheses(&telegram.line.bytes, telegram.choice.protocol, context) {
            if known.as_ref() == Some(&hypothesis.bytes) {
                continue;
            }
            let explanation = self.explain(index, hypothesis, asked.as_deref());
            let rank = |one: &Explanation| {
                // Where nothing else is wrong, a device that knows the registers says more than chance.
                let known = if one.known { 0 } else { 3 };
                (one.problems, one.hypothesis.bits() + known)
            };
            let at = found.partition_point(|other| rank(other) <= rank(&explanation));
            if at < MOST {
                found.insert(at, explanation);
                found.truncate(MOST);
            }
        }
        if let Some(printed) = printed {
            found.insert(0, self.explain(index, printed, asked.as_deref()));
            found.truncate(MOST);
        }
        found
    }

    /// Why it cannot be told what happened to telegram `index`, if that is so: on long telegrams a
    /// change of some byte fits by chance.
    pub fn undecidable(&self, index: usize) -> Option<Message> {
        /// From so many chance fits on, one that is found says nothing.
        const MANY: f64 = 0.5;
        let telegram = self.telegrams.get(index).filter(|it| it.verdict == Verdict::Wrong)?;
        let length = telegram.line.bytes.len();
        if !telegram.choice.protocol.is(&modbus_rtu::PROTOCOL) {
            return Some(message!(
                "a checksum of one byte is valid by chance once in 256: it cannot be told which byte is wrong"
            ));
        }
        let chance = chance_of_change(length);
        (chance >= MANY).then(|| {
            message!(
                "it cannot be told which: on {n}, some change of a single byte fits by chance {percent} times in 100",
                n = Message::bytes(length),
                percent = (100.0 * (1.0 - (-chance).exp())).round() as usize
            )
        })
    }

    /// Other telegrams near telegram `index`, whose checks may have been copied.
    fn neighbours(&self, index: usize) -> Vec<&[u8]> {
        const NEAR: usize = 100;
        let near = index.saturating_sub(NEAR)..(index + NEAR).min(self.telegrams.len());
        let others = near.filter(|other| *other != index).map(|other| &self.telegrams[other]);
        others
            .filter(|other| other.verdict == Verdict::Right)
            .map(|other| other.line.bytes.as_slice())
            .collect()
    }

    /// What a hypothesis says in the device's words.
    fn in_words(&self, index: usize, hypothesis: &Hypothesis, guess: &Guess) -> Option<Detail> {
        self.device(index)?;
        let mut telegram = self.telegrams[index].clone();
        telegram.line.bytes.clone_from(&hypothesis.bytes);
        telegram.guess = guess.clone();
        telegram.verdict = Verdict::Right;
        if let Some(protocol) = hypothesis.protocol {
            telegram.choice.protocol = protocol;
        }
        let request = telegram.answers.map(|request| self.telegrams[request].clone());
        telegram.answers = request.as_ref().map(|_| 0);
        let telegrams: Vec<_> = request.into_iter().chain([telegram]).collect();
        let options = Options { settings: self.settings(index).clone(), ..self.options.clone() };
        let alone = Self::of(telegrams, options);
        alone.detail(alone.telegrams.len() - 1)
    }

    /// Reads a hypothesis as what it would be, a response to `asked`.
    fn explain(&self, index: usize, hypothesis: Hypothesis, asked: Option<&dyn Frame>) -> Explanation {
        let telegram = &self.telegrams[index];
        let protocol = hypothesis.protocol.unwrap_or(telegram.choice.protocol);
        let bytes = &hypothesis.bytes;
        let settings = self.settings(index);
        let guess = match protocol.speaker {
            Speaker::Pdu(inside)
                if telegram.guess.certainty != Certainty::Certain || hypothesis.protocol.is_some() =>
            {
                let (pdu, around) = inside(bytes);
                dialogue::direction(pdu, around, telegram.answers.is_some(), settings.frame.dialect)
            }
            _ => telegram.guess.clone(),
        };
        let mut frame = (protocol.expect)(bytes, guess.direction, &settings.frame);
        let mut strange = 0;
        if let (Some(asked), Some(request)) = (asked, telegram.answers) {
            frame.answer(&asked.content());
            strange = usize::from(
                (protocol.exchange)(bytes) != (protocol.exchange)(&self.telegrams[request].line.bytes),
            );
        }
        let fields = walk::read(frame.as_mut(), bytes).fields;
        let mut problems = field::problems(&fields).len() + strange;
        // Nobody knows such a function, or its length fits neither direction.
        if guess.certainty != Certainty::Certain && telegram.guess.certainty != guess.certainty {
            problems += 1;
        }
        let in_words = self.in_words(index, &hypothesis, &guess);
        let wrong = in_words.as_ref().map_or(0, |detail| detail.device.problems.len());
        let known = wrong == 0 && in_words.as_ref().is_some_and(|detail| !detail.device.blocks.is_empty());
        problems += wrong;
        let (removed, added) = hypothesis.difference(&telegram.line.bytes);
        let said = in_words.map_or_else(|| frame.meaning(), |detail| detail.said);
        Explanation { problems, known, said, removed, added, hypothesis }
    }
}

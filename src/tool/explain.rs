use super::decode::Report;
use crate::dialogue::{self, Certainty, Guess, Hypothesis, hypotheses};
use crate::field::{self, Message};
use crate::frame::{Speaker, Verdict, modbus_rtu};
use crate::walk;

/// What may have happened to a telegram whose check does not match.
#[derive(Clone, Debug)]
pub struct Explanation {
    pub hypothesis: Hypothesis,
    /// How many things would still be wrong with the telegram.
    pub problems: usize,
    /// What the telegram would then say.
    pub said: Message,
}

/// More are not worth reading.
const MOST: usize = 8;

impl Report {
    /// What may have happened to telegram `index`, best first: what leaves nothing wrong before what
    /// does, and what fits less often by chance before what fits more often. Empty where the check
    /// is right. Modbus RTU so far.
    pub fn explanations(&self, index: usize) -> Vec<Explanation> {
        let Some(telegram) = self.telegrams.get(index) else { return Vec::new() };
        let rtu = std::ptr::eq(telegram.choice.protocol, &raw const modbus_rtu::PROTOCOL);
        if !rtu || telegram.verdict != Verdict::Wrong {
            return Vec::new();
        }
        let mut found: Vec<Explanation> = Vec::new();
        for hypothesis in hypotheses(&telegram.line.bytes) {
            let explanation = self.explain(index, hypothesis);
            let rank = |one: &Explanation| (one.problems, one.hypothesis.tries.unwrap_or(usize::MAX));
            let at = found.partition_point(|other| rank(other) <= rank(&explanation));
            if at < MOST {
                found.insert(at, explanation);
                found.truncate(MOST);
            }
        }
        found
    }

    /// Reads a hypothesis as what it would be.
    fn explain(&self, index: usize, hypothesis: Hypothesis) -> Explanation {
        let telegram = &self.telegrams[index];
        let protocol = telegram.choice.protocol;
        let bytes = &hypothesis.bytes;
        let settings = &self.settings(index).frame;
        let guess = match protocol.speaker {
            Speaker::Pdu(inside) if telegram.guess.certainty != Certainty::Certain => {
                let (pdu, around) = inside(bytes);
                dialogue::direction(pdu, around, telegram.answers.is_some(), settings.dialect)
            }
            _ => Guess { ..telegram.guess.clone() },
        };
        let mut frame = (protocol.expect)(bytes, guess.direction, settings);
        if let Some(request) = telegram.answers {
            let (asked, _) = self.read(request);
            frame.answer(&asked.content());
        }
        let fields = walk::read(frame.as_mut(), bytes).fields;
        let mut problems = field::problems(&fields).len();
        // Nobody knows such a function, or its length fits neither direction.
        if guess.certainty != Certainty::Certain && telegram.guess.certainty != guess.certainty {
            problems += 1;
        }
        Explanation { problems, said: frame.meaning(), hypothesis }
    }
}

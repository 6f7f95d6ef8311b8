use crate::dialogue::{self, Certainty, Guess, Pairing};
use crate::field::{self, Check, Direction, Field, Message, Problem, Value, hex_value};
use crate::frame::modbus_rtu::{AROUND, BROADCAST, Rtu, SHORTEST};
use crate::message;
use crate::modbus::{Access, EXCEPTION, STANDARD};
use crate::text::{self, Line, Style};
use crate::walk::{self, guide};

/// How a text is to be read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// What the telegrams are, where a person says so; otherwise their bytes tell.
    pub direction: Option<Direction>,
}

/// Reads every telegram of `text`, a line each.
///
/// Here the telegrams are found, checked and paired. Their fields are read one by one by
/// [`Report::detail`], when somebody looks.
pub fn decode(text: &str, options: Options) -> Report {
    let reading = text::read(text);
    let mut report = Report {
        telegrams: Vec::new(),
        not_understood: Vec::new(),
        style: reading.style,
        line_count: text.lines().count(),
    };
    let mut pairing = Pairing::default();
    for line in reading.lines {
        if line.bytes.is_empty() {
            report.not_understood.push(line);
        } else {
            report.add(line, options, &mut pairing);
        }
    }
    report
}

/// What was found in a text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    pub telegrams: Vec<Telegram>,
    /// Lines without a single byte, with what is wrong with them.
    pub not_understood: Vec<Line>,
    /// How the bytes were written.
    pub style: Option<Style>,
    /// How many lines the text has, empty ones included.
    pub line_count: usize,
}

/// A telegram as far as it was looked at without reading its fields.
#[derive(Clone, Debug, PartialEq)]
pub struct Telegram {
    /// Its bytes and where they stand in the text.
    pub line: Line,
    pub guess: Guess,
    pub verdict: Verdict,
    /// The index of the request that it answers.
    pub answers: Option<usize>,
    /// The index of the response to it.
    pub answered_by: Option<usize>,
}

/// What the check says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Right,
    Wrong,
    /// Too short to have a check.
    Unchecked,
}

/// Everything about one telegram.
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    /// The tree; its leaves tile the bytes.
    pub fields: Vec<Field>,
    /// What the telegram says, as if its check were right.
    pub said: Message,
    pub verdict: Verdict,
    /// What kind of telegram it is: "Read holding registers, function 3".
    pub kind: Message,
    /// What the kind is about, for newcomers, and where it is described.
    pub note: &'static str,
    pub source: &'static str,
    pub unit: Option<u8>,
    /// Without the exception bit.
    pub function: Option<u8>,
    pub exception: Option<u8>,
    pub start: Option<u16>,
    pub count: Option<usize>,
    pub values: Vec<u32>,
}

impl Detail {
    /// The telegram in one sentence, with what its check makes of it.
    pub fn meaning(&self) -> Message {
        match self.verdict {
            Verdict::Right => self.said.clone(),
            Verdict::Wrong => message!("{said}, but the check does not match", said = self.said.clone()),
            Verdict::Unchecked => message!("the beginning of a telegram: too short to say what it means"),
        }
    }

    /// The problems of all fields, in their order.
    pub fn problems(&self) -> Vec<&Problem> {
        field::problems(&self.fields)
    }

    /// The check bytes, where the telegram is long enough to have some.
    pub fn check(&self) -> Option<Check> {
        field::leaves(&self.fields).into_iter().find_map(|leaf| match leaf.value {
            Value::Check(check) => Some(check),
            _ => None,
        })
    }
}

/// A report in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    pub telegrams: usize,
    pub check_failed: usize,
    /// Too short to have a check.
    pub unchecked: usize,
    /// Requests with their response.
    pub pairs: usize,
    /// Requests that somebody should have answered.
    pub unanswered: usize,
    /// Responses without their request.
    pub unpaired: usize,
    pub lines: usize,
    pub lines_not_understood: usize,
}

impl Report {
    /// All lines with bytes or remarks: those of telegrams, then those without bytes.
    pub fn lines(&self) -> impl Iterator<Item = &Line> {
        self.telegrams.iter().map(|telegram| &telegram.line).chain(&self.not_understood)
    }

    pub fn summary(&self) -> Summary {
        let mut summary = Summary {
            telegrams: self.telegrams.len(),
            lines: self.line_count,
            lines_not_understood: self.not_understood.len(),
            ..Summary::default()
        };
        for telegram in &self.telegrams {
            summary.check_failed += usize::from(telegram.verdict == Verdict::Wrong);
            summary.unchecked += usize::from(telegram.verdict == Verdict::Unchecked);
            summary.pairs += usize::from(telegram.answers.is_some());
            if telegram.guess.certainty != Certainty::Open {
                match telegram.guess.direction {
                    Direction::Request => {
                        summary.unanswered += usize::from(
                            telegram.answered_by.is_none() && telegram.line.bytes[0] != BROADCAST,
                        );
                    }
                    Direction::Response => summary.unpaired += usize::from(telegram.answers.is_none()),
                }
            }
        }
        summary
    }

    /// Reads the fields of telegram `index`.
    pub fn detail(&self, index: usize) -> Option<Detail> {
        let telegram = self.telegrams.get(index)?;
        let request = telegram.answers.map(|request| self.telegrams[request].read(None).0);
        let asked = request.as_ref().and_then(|request| request.pdu.body.access());
        let (rtu, reading) = telegram.read(asked.as_ref());
        let bytes = &telegram.line.bytes;
        let body = &rtu.pdu.body;
        let access = body.access();
        let function = (bytes.len() > 1).then_some(rtu.pdu.function);
        let said = match missing(&reading.fields) {
            Some(label) => message!(
                "{kind}, cut off: {label} is incomplete",
                kind = field::Argument::Term(rtu.pdu.kind.spec.label),
                label = label
            ),
            None => rtu.meaning(),
        };
        let spec = &rtu.pdu.kind.spec;
        Some(Detail {
            said,
            verdict: telegram.verdict,
            kind: kind_name(spec.label, function),
            note: spec.note,
            source: spec.source,
            unit: bytes.first().copied(),
            function: function.map(|function| function & !EXCEPTION),
            exception: body.exception(),
            start: access.and_then(|access| access.start),
            count: access.map(|access| access.count),
            values: access.map_or(Vec::new(), |access| access.values.to_vec()),
            fields: reading.fields,
        })
    }

    /// How every telegram of the kind of telegram `index` is laid out.
    pub fn layout(&self, index: usize) -> Vec<guide::Row> {
        let telegram = self.telegrams.get(index);
        telegram.map_or(Vec::new(), |telegram| guide::guide(&mut telegram.expected()))
    }

    fn add(&mut self, line: Line, options: Options, pairing: &mut Pairing) {
        let index = self.telegrams.len();
        let guess = match options.direction {
            Some(direction) => {
                Guess { direction, certainty: Certainty::Certain, reason: message!("set by hand") }
            }
            None => self.guess(&line.bytes, pairing),
        };
        let verdict = verdict(&line.bytes);
        let answers = match *line.bytes {
            [unit, function, ..] => pairing.next(index, guess.direction, unit, function),
            _ => None,
        };
        if let Some(request) = answers {
            self.telegrams[request].answered_by = Some(index);
        }
        self.telegrams.push(Telegram { line, guess, verdict, answers, answered_by: None });
    }

    /// Who speaks: by the bytes, and where those leave it open, by the request that waits.
    fn guess(&self, bytes: &[u8], pairing: &Pairing) -> Guess {
        let asked = pairing.waiting().map(|index| (index, self.telegrams[index].line.bytes.as_slice()));
        let awaited = asked.is_some_and(|(_, asked)| asked.get(..2) == bytes.get(..2));
        let guess = dialogue::direction(Rtu::pdu_bytes(bytes), AROUND, awaited, &STANDARD);
        match asked {
            Some((index, asked)) if guess.certainty == Certainty::Open && asked == bytes => Guess {
                direction: Direction::Response,
                certainty: Certainty::Likely,
                reason: message!(
                    "it repeats telegram {n}, as a response of this function does",
                    n = index + 1
                ),
            },
            _ => guess,
        }
    }
}

impl Telegram {
    /// A frame of this telegram's kind with nothing read into it yet.
    fn expected(&self) -> Rtu {
        Rtu::expect(&self.line.bytes, self.guess.direction, &STANDARD)
    }

    fn read(&self, asked: Option<&Access<'_>>) -> (Rtu, walk::Reading) {
        let mut rtu = self.expected();
        if let Some(asked) = asked {
            rtu.pdu.body.answer(asked);
        }
        let reading = walk::read(&mut rtu, &self.line.bytes);
        (rtu, reading)
    }
}

fn verdict(bytes: &[u8]) -> Verdict {
    if bytes.len() < SHORTEST {
        return Verdict::Unchecked;
    }
    if Rtu::check_matches(bytes) { Verdict::Right } else { Verdict::Wrong }
}

/// The first field, items of lists aside, that the telegram ends before.
fn missing(fields: &[Field]) -> Option<Message> {
    fields.iter().find(|field| matches!(field.value, Value::Missing { .. })).map(Field::label)
}

fn kind_name(label: &'static str, function: Option<u8>) -> Message {
    let Some(function) = function else { return message!("no function code yet") };
    let plain = function & !EXCEPTION;
    let label = field::Argument::Term(label);
    match (function & EXCEPTION != 0, plain) {
        (true, _) => message!("{label} to function {plain}", label = label, plain = plain),
        (false, 0..=9) => message!("{label}, function {plain}", label = label, plain = plain),
        (false, _) => message!(
            "{label}, function {plain} ({hex})",
            label = label,
            plain = plain,
            hex = hex_value(plain.into(), 1)
        ),
    }
}

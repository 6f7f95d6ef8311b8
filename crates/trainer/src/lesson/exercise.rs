//! What there is to do in a step, and whether it was done. All but pointing and setting bits is a [`Task`],
//! graded as every task is.

use buslens::field::{self, Format, Span, hex};
use buslens::message;
use buslens::tool::{Options, Report, Verdict as Check, decode, steps};

use super::check::unknown;
use super::{Mistake, Step, field, names};
use crate::grade::{Answer, Remark, Verdict, grade};
use crate::notation::{self, Notation};
use crate::task::{Blank, Checksum, Choice, Expected, Number, Task, Telegram};

/// Something to do.
#[derive(Clone, Debug)]
pub struct Exercise {
    pub question: String,
    pub ask: Ask,
    /// Three steps: where to look, which rule, nearly all of it.
    pub hints: Vec<String>,
    /// What is said once it is right.
    pub then: String,
    pub line: usize,
}

/// What is to be done, and what is right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ask {
    /// One of some sentences is right.
    Choose { choices: Vec<Choice>, right: usize },
    /// A number, or the value of a field of the step's telegrams; some wrong ones have a remark of their own.
    Number { value: String, wrong: Vec<Wrong> },
    /// The field of the step's last telegram that is to be found.
    Point { field: String, wrong: Vec<Wrong> },
    /// Fields of a telegram that are blank.
    Blank { telegram: String, fields: Vec<String> },
    /// A telegram from nothing.
    Build { telegram: String },
    /// A damaged telegram that is to be made right.
    Repair { damaged: String, telegram: String },
    /// Bits that are to be set.
    Bits { from: Vec<u8>, to: Vec<u8>, reading: Reading },
}

/// A wrong answer that has a remark of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// A number, or a field.
    pub answer: String,
    pub remark: String,
    pub line: usize,
}

/// What bits are read as while they are set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// A sum of what each is worth.
    Sum,
    /// Hex digits.
    Hex,
    Float,
}

/// What separates a telegram from the request that it answers.
const AFTER: &str = " after ";

/// Behind a telegram whose checksum is asked for.
const WITH_CHECKSUM: &str = " with checksum";

/// How a number is to be written, where it matters.
const NOTATIONS: [(&str, Notation); 2] = [(" in hex", Notation::Hex), (" in decimal", Notation::Decimal)];

impl Exercise {
    /// Whether `answer` is right; otherwise what is off. The bytes that somebody set are given as text.
    pub fn grade(&self, step: &Step, answer: &Answer) -> Verdict {
        match (&self.ask, answer) {
            (Ask::Choose { .. } | Ask::Point { .. }, Answer::Text(_)) => {
                Verdict::Unread(message!("nothing is chosen yet"))
            }
            (Ask::Point { field, wrong }, Answer::Byte(at)) => point(step, field, wrong, *at),
            (Ask::Bits { to, reading, .. }, Answer::Text(text)) => set(to, *reading, &steps::bytes(text)),
            (Ask::Number { .. }, Answer::Text(text)) if let Some(number) = without_counted(text) => {
                self.grade(step, &Answer::Text(number.to_owned()))
            }
            _ => {
                let Some(task) = self.task(step) else {
                    return Verdict::Unread(message!("there is no answer to this"));
                };
                let verdict = grade(&task, answer);
                match (&self.ask, answer) {
                    (Ask::Number { wrong, .. }, Answer::Text(text))
                        if !verdict.is_right()
                            && let Some(given) = numbered(text)
                            && let Some(own) =
                                wrong.iter().find(|it| numbered(&it.answer) == Some(given)) =>
                    {
                        wrong_with("", message!("{said}", said = step.filled_in(&own.remark)), None)
                    }
                    _ => verdict,
                }
            }
        }
    }

    /// What stands in the place for the answer at first.
    pub fn start(&self) -> String {
        match &self.ask {
            Ask::Repair { damaged, .. } => damaged.clone(),
            Ask::Bits { from, .. } => hex(from),
            _ => String::new(),
        }
    }

    /// The same as a task for all who know tasks; `None` for what is done with the pointer.
    pub fn task(&self, step: &Step) -> Option<Task> {
        let expected = match &self.ask {
            Ask::Choose { choices, right } => {
                let said = |it: &Choice| Choice::new(&it.text, &step.filled_in(&it.remark));
                Expected::Choice { choices: choices.iter().map(said).collect(), right: *right }
            }
            Ask::Number { value, .. } => Expected::Number(number(step, value)?),
            Ask::Blank { telegram, .. } => {
                let blanks = self.blanks(step)?;
                Expected::Blanks { telegram: known(telegram, &step.options())?, blanks }
            }
            Ask::Build { telegram } | Ask::Repair { telegram, .. } => {
                Expected::Telegram(known(telegram, &step.options())?)
            }
            Ask::Point { .. } | Ask::Bits { .. } => return None,
        };
        Some(Task {
            question: self.question.clone(),
            given: Vec::new(),
            expected,
            hints: self.hints.clone(),
            working: Vec::new(),
        })
    }

    /// The telegram that is meant, where one is: with blanks, to build, or as it should be.
    pub fn telegram(&self, step: &Step) -> Option<Telegram> {
        match &self.ask {
            Ask::Blank { telegram, .. } | Ask::Build { telegram } | Ask::Repair { telegram, .. } => {
                known(telegram, &step.options())
            }
            _ => None,
        }
    }

    /// The blank fields, where there are such.
    pub fn blanks(&self, step: &Step) -> Option<Vec<Blank>> {
        let Ask::Blank { telegram, fields } = &self.ask else { return None };
        let detail = known(telegram, &step.options())?.detail()?;
        fields
            .iter()
            .map(|name| {
                let found = field(&detail, name)?;
                Some(Blank { label: found.label().to_string(), span: found.span })
            })
            .collect()
    }

    /// A right answer, as somebody would give it; for tests and for who asks to be shown.
    pub fn answer(&self, step: &Step) -> Option<Answer> {
        Some(match &self.ask {
            Ask::Choose { right, .. } => Answer::Choice(*right),
            Ask::Number { value, .. } => Answer::Text(number(step, value)?.text()),
            Ask::Point { field: name, .. } => {
                let report = step.report();
                let detail = report.detail(report.telegrams.len().checked_sub(1)?)?;
                Answer::Byte(field(&detail, name)?.span.from)
            }
            Ask::Blank { .. } => {
                let telegram = self.telegram(step)?;
                let of = |blank: Blank| hex(blank.span.of(&telegram.bytes));
                Answer::Blanks(self.blanks(step)?.into_iter().map(of).collect())
            }
            Ask::Build { .. } | Ask::Repair { .. } => Answer::Text(self.telegram(step)?.hex()),
            Ask::Bits { to, .. } => Answer::Text(hex(to)),
        })
    }

    /// Whether an answer that stands among the wrong ones is right.
    fn is_right(&self, step: &Step, answer: &str) -> bool {
        match &self.ask {
            Ask::Point { field: name, .. } => {
                let report = step.report();
                let detail = report.telegrams.len().checked_sub(1).and_then(|last| report.detail(last));
                let span = |name: &str| Some(field(detail.as_ref()?, name)?.span);
                span(answer).zip(span(name)).is_some_and(|(own, right)| own == right)
            }
            _ => self.grade(step, &Answer::Text(answer.to_owned())).is_right(),
        }
    }

    /// What is said of answers that are wrong.
    fn remarks(&self) -> Vec<&String> {
        match &self.ask {
            Ask::Choose { choices, .. } => choices.iter().map(|choice| &choice.remark).collect(),
            Ask::Number { wrong, .. } | Ask::Point { wrong, .. } => {
                wrong.iter().map(|own| &own.remark).collect()
            }
            _ => Vec::new(),
        }
    }

    /// What the library does not say so, or cannot do.
    pub(super) fn check(&self, step: &Step, report: &Report, found: &mut Vec<Mistake>) {
        let mut say = |said: String| found.push(Mistake { line: self.line, said });
        for text in [&self.question, &self.then].into_iter().chain(&self.hints).chain(self.remarks()) {
            if let Err(name) = step.filled(text, report) {
                say(format!(
                    "In the words of this task, {{{name}}} is nothing that the telegrams of its step say."
                ));
            }
        }
        if let Ask::Number { wrong, .. } | Ask::Point { wrong, .. } = &self.ask {
            let right = wrong.iter().filter(|own| self.is_right(step, &own.answer));
            found.extend(right.map(|own| right_itself(&own.answer, own.line)));
        }
        let mut say = |said: String| found.push(Mistake { line: self.line, said });
        let last = report.telegrams.len().checked_sub(1).and_then(|last| report.detail(last));
        match &self.ask {
            Ask::Choose { .. } => {}
            Ask::Number { value, .. } => {
                if number(step, value).is_none() {
                    say(format!("“{value}” is no number, and no field of the step's telegrams."));
                }
            }
            Ask::Point { field: name, wrong } => match last {
                Some(detail) => {
                    let all = std::iter::once(name).chain(wrong.iter().map(|own| &own.answer));
                    all.filter(|name| field(&detail, name).is_none())
                        .for_each(|name| say(unknown(name, &names(&detail))));
                }
                None => {
                    say("What is to be found stands in a telegram of the step, and there is none.".to_owned())
                }
            },
            Ask::Blank { telegram, fields } => match known(telegram, &step.options()) {
                Some(telegram) => {
                    let detail = telegram.detail();
                    for name in fields {
                        if let Some(detail) = &detail
                            && field(detail, name).is_none()
                        {
                            say(unknown(name, &names(detail)));
                        }
                    }
                }
                None => say(no_telegram(telegram)),
            },
            Ask::Build { telegram } | Ask::Repair { telegram, .. } => {
                if known(telegram, &step.options()).is_none() {
                    say(no_telegram(telegram));
                }
                if let Ask::Repair { damaged, .. } = &self.ask
                    && steps::bytes(damaged) == steps::bytes(telegram)
                {
                    say("There is nothing to be made right: both are the same bytes.".to_owned());
                }
            }
            Ask::Bits { from, to, .. } => {
                if from == to {
                    say("There is nothing to be set: both are the same bits.".to_owned());
                }
            }
        }
    }
}

/// Nobody would ever see why it is wrong.
pub(super) fn right_itself(answer: &str, line: usize) -> Mistake {
    let said = format!("“{answer}” is the right answer, and stands here as a wrong one: take the line out.");
    Mistake { line, said }
}

/// A whole number as people write it: 200, 0xC8, C8h.
pub(super) fn numbered(text: &str) -> Option<u64> {
    notation::read(text, 8, Format::Decimal, Notation::Any).ok().map(|written| written.raw)
}

/// The number in front of what is counted: 21 of "21 ms".
fn without_counted(text: &str) -> Option<&str> {
    let counted = ["ms", "bytes", "bits", "registers", "characters"];
    counted.iter().find_map(|word| text.trim_end().strip_suffix(word)).map(str::trim_end)
}

fn no_telegram(text: &str) -> String {
    format!("“{text}” is no telegram with a valid checksum.")
}

fn wrong_with(label: &str, text: field::Message, span: Option<Span>) -> Verdict {
    Verdict::Wrong(vec![Remark { field: label.to_owned(), text, span }])
}

/// A telegram that is right, with the request that it stands after.
fn known(text: &str, options: &Options) -> Option<Telegram> {
    let checksum = if text.contains(WITH_CHECKSUM) { Checksum::Asked } else { Checksum::Added };
    let text = text.replacen(WITH_CHECKSUM, "", 1);
    let lines = match text.split_once(AFTER) {
        Some((response, request)) => format!("{request}\n{response}"),
        None => text.clone(),
    };
    let report = decode(&lines, options.clone());
    let asked = usize::from(text.contains(AFTER));
    let telegram = report.telegrams.get(asked).filter(|_| report.telegrams.len() == asked + 1)?;
    let right = matches!(telegram.verdict, Check::Right | Check::NoCheck);
    right.then(|| Telegram {
        bytes: telegram.line.bytes.clone(),
        direction: telegram.guess.direction,
        protocol: telegram.choice.protocol,
        request: telegram.answers.map(|request| report.telegrams[request].line.bytes.clone()),
        options: options.clone(),
        checksum,
    })
}

/// A number as written, or what a field of the step's telegrams holds.
fn number(step: &Step, value: &str) -> Option<Number> {
    let written = NOTATIONS.iter().find_map(|(word, notation)| Some((value.strip_suffix(word)?, *notation)));
    let (value, notation) = written.unwrap_or((value, Notation::Any));
    let fractional = value.contains('.');
    let (width, format) = if fractional { (4, Format::Float) } else { (4, Format::Decimal) };
    if let Ok(written) = notation::read(value, width, format, Notation::Any) {
        let width = if written.raw > 0xFFFF || fractional { 4 } else { 2 };
        return Some(Number::new("", written.raw, width, format).notation(notation));
    }
    let report = step.report();
    let all = (0..report.telegrams.len()).filter_map(|index| report.detail(index));
    all.filter_map(|detail| Number::of(field(&detail, value)?)).next()
}

/// Whether the byte that somebody pointed at is of the field that was meant.
fn point(step: &Step, name: &str, wrong: &[Wrong], at: usize) -> Verdict {
    let report = step.report();
    let last = report.telegrams.len().saturating_sub(1);
    let Some(detail) = report.detail(last) else {
        return Verdict::Unread(message!("there is no telegram to point at"));
    };
    if field(&detail, name).is_some_and(|field| field.span.contains(at)) {
        return Verdict::Right(None);
    }
    let own = wrong.iter().filter_map(|own| Some((field(&detail, &own.answer)?, &own.remark)));
    if let Some((field, said)) = own.into_iter().find(|(field, _)| field.span.contains(at)) {
        let label = field.label().to_string();
        return wrong_with(&label, message!("{said}", said = step.filled_in(said)), Some(field.span));
    }
    let Some(other) = field::leaves(&detail.fields).into_iter().find(|leaf| leaf.span.contains(at)) else {
        return Verdict::Unread(message!("there is no byte {n}", n = at));
    };
    let label = other.label().to_string();
    wrong_with(
        &label,
        message!("this byte belongs to another field: {label}", label = label.clone()),
        Some(other.span),
    )
}

/// Whether bits are set as they should be.
fn set(to: &[u8], reading: Reading, given: &[u8]) -> Verdict {
    if given == to {
        return Verdict::Right(None);
    }
    if given.len() != to.len() {
        return Verdict::Unread(message!("there are {n} bits", n = 8 * to.len()));
    }
    let number = |bytes: &[u8]| bytes.iter().fold(0_u64, |number, byte| number << 8 | u64::from(*byte));
    let off = number(given) ^ number(to);
    if reading == Reading::Float {
        // Sign, exponent, fraction: the first that is off.
        let (part, span) = match off.leading_zeros() - 32 {
            0 => ("sign", Span::new(0, 1)),
            1..=8 => ("exponent", Span::new(0, 2)),
            _ => ("fraction", Span::new(1, 4)),
        };
        let text = match part {
            "sign" => message!("the sign is the other one: 0 is plus, 1 is minus"),
            "exponent" => {
                let exponent = |bytes: &[u8]| number(bytes) >> 23 & 0xFF;
                message!(
                    "the exponent is {is} and should be {wanted}: one more doubles the value, one less halves it",
                    is = exponent(given),
                    wanted = exponent(to)
                )
            }
            _ => message!("the fraction is to stay as it was"),
        };
        return wrong_with(part, text, Some(span));
    }
    let highest = 63 - off.leading_zeros();
    if reading == Reading::Sum {
        // Bits have no numbers yet, only what they are worth.
        let (sum, weight) = (number(given), 1_u64 << highest);
        let text = match sum & weight {
            0 => message!("it is {sum} so far, and {weight} belongs to it", sum = sum, weight = weight),
            _ => message!("it is {sum} now, and {weight} is too much", sum = sum, weight = weight),
        };
        return wrong_with("", text, None);
    }
    let text = match number(given) >> highest & 1 {
        1 => message!(
            "bit {n} is worth {weight}: that is too much here",
            n = highest,
            weight = 1_u64 << highest
        ),
        _ => message!("bit {n}, worth {weight}, is missing", n = highest, weight = 1_u64 << highest),
    };
    wrong_with(&format!("bit {highest}"), text, None)
}

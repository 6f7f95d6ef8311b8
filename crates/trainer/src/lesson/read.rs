//! The text of a lesson, line by line. Reading never fails: what cannot be understood is a [`Mistake`], and all
//! else is there.

use buslens::field::{Span, in_order};
use buslens::tool::{PROFILES, PROTOCOLS, Profile, Protocol, steps::bytes};

use super::exercise::{Ask, Exercise, Reading, Wrong, numbered, right_itself};
use super::{Lesson, Mistake, Place, Remark, Show, Statement, Step, Telegram};
use crate::task::Choice;

/// Longer lines hold no sentence that anybody reads.
const LONGEST_LINE: usize = 2_000;
/// More lines no lesson has.
const MOST_LINES: usize = 2_000;

/// Reads a lesson, with what cannot be understood in its text.
pub fn read(text: &str) -> (Lesson, Vec<Mistake>) {
    let mut reader = Reader::default();
    let mut lines = text.trim_start_matches('\u{feff}').lines().zip(1..).peekable();
    while let Some((line, number)) = lines.next() {
        if number > MOST_LINES {
            reader.say(
                number,
                format!("A lesson has at most {MOST_LINES} lines: this and the rest is left out."),
            );
            break;
        }
        if line.len() > LONGEST_LINE {
            reader.say(number, format!("The line is longer than {LONGEST_LINE} bytes: it is left out."));
            continue;
        }
        let mut line = line.trim_end().to_owned();
        // What is indented goes on with the line before.
        while !line.is_empty()
            && let Some((next, _)) = lines.next_if(|(next, _)| goes_on(next))
        {
            if line.len() + next.len() < LONGEST_LINE {
                line.push(' ');
                line.push_str(next.trim());
            }
        }
        reader.take(&line, number);
    }
    reader.finish()
}

fn goes_on(line: &str) -> bool {
    line.starts_with([' ', '\t']) && !line.trim().is_empty()
}

/// How far a text is read.
#[derive(Default)]
struct Reader {
    lesson: Lesson,
    step: Option<Step>,
    exercise: Option<Draft>,
    /// The next line of text begins a paragraph.
    apart: bool,
    /// The line before was text.
    in_text: bool,
    mistakes: Vec<Mistake>,
}

/// An exercise whose lines are not all there yet.
#[derive(Default)]
struct Draft {
    question: String,
    asked: Option<Ask>,
    hints: Vec<String>,
    wrong: Vec<(String, String, usize)>,
    right: Vec<String>,
    then: String,
    line: usize,
}

/// The keys of lines, for who mistyped one.
const OF_LESSON: &[&str] = &["key", "group", "about", "minutes"];
const OF_STEP: &[&str] = &["device", "protocol", "telegram", "holds", "show", "task"];
const OF_TASK: &[&str] =
    &["right", "wrong", "number", "point", "blank", "build", "repair", "bits", "hint", "then"];

impl Reader {
    fn say(&mut self, line: usize, said: impl Into<String>) {
        self.mistakes.push(Mistake { line, said: said.into() });
    }

    fn take(&mut self, line: &str, number: usize) {
        let mut text = false;
        if line.is_empty() {
            self.apart = true;
        } else if line.starts_with("//") {
            // For who writes it.
        } else if let Some(title) = line.strip_prefix("## ") {
            self.end_step();
            self.step = Some(Step { title: title.trim().to_owned(), line: number, ..Step::default() });
        } else if let Some(title) = line.strip_prefix("# ") {
            if !self.lesson.title.is_empty() {
                self.say(
                    number,
                    "A file holds one lesson, and this line begins a second one. A step begins with “## ”.",
                );
            } else {
                self.lesson.title = title.trim().to_owned();
            }
        } else if let Some(logged) = line.strip_prefix('|') {
            self.take_log(logged, number);
        } else if let Some(remark) = line.strip_prefix("- ") {
            self.take_remark(remark, number);
        } else if let Some((key, value)) = key(line).filter(|(key, _)| !self.in_text || is_known(key)) {
            self.take_key(key, value, number);
        } else {
            self.take_text(line, number);
            text = true;
        }
        if !line.is_empty() {
            self.apart = false;
        }
        // A paragraph may have a word with a colon behind it at the beginning of a line.
        self.in_text = text;
    }

    fn take_text(&mut self, line: &str, number: usize) {
        let Some(step) = &mut self.step else {
            self.say(
                number,
                "Text belongs to a step, and a step begins with a line such as “## The first byte”.",
            );
            return;
        };
        if self.exercise.is_some() {
            self.say(number, "After “task:” there are only lines with a key. Text stands before it.");
        } else if let Some(last) = step.text.last_mut().filter(|_| !self.apart) {
            last.push(' ');
            last.push_str(line);
        } else {
            step.text.push(line.to_owned());
        }
    }

    fn take_log(&mut self, logged: &str, number: usize) {
        let Some(step) = &mut self.step else {
            self.say(
                number,
                "A log belongs to a step, and a step begins with a line such as “## The first byte”.",
            );
            return;
        };
        step.log.push_str(logged.strip_prefix(' ').unwrap_or(logged));
        step.log.push('\n');
        if step.show == Show::Bytes {
            step.show = Show::Log;
        }
    }

    fn take_remark(&mut self, remark: &str, number: usize) {
        let last = self.step.as_mut().and_then(|step| step.telegrams.last_mut());
        let Some(telegram) = last.filter(|_| self.exercise.is_none()) else {
            self.say(
                number,
                "A line with “- ” says something of a telegram: it stands below a line “telegram: …”.",
            );
            return;
        };
        let Some((place, text)) = remark.split_once(": ").filter(|(_, text)| !text.trim().is_empty()) else {
            self.say(number, "Expected “- Field: what to say of it”, with a name such as “Quantity”, “bytes 2-3” or “all”.");
            return;
        };
        let place = place_of(place.trim());
        telegram.remarks.push(Remark { place, text: text.trim().to_owned(), line: number });
    }

    fn take_key(&mut self, key: &str, value: &str, number: usize) {
        if value.is_empty() {
            self.say(number, format!("Behind “{key}:” something is missing."));
            return;
        }
        if OF_LESSON.contains(&key) {
            self.take_of_lesson(key, value, number);
        } else if OF_STEP.contains(&key) {
            self.take_of_step(key, value, number);
        } else if OF_TASK.contains(&key) {
            match self.exercise.take() {
                Some(mut draft) => {
                    self.take_of_task(&mut draft, key, value, number);
                    self.exercise = Some(draft);
                }
                None => {
                    self.say(number, format!("“{key}:” belongs to a task: it stands below a line “task: …”."))
                }
            }
        } else {
            let known = [OF_LESSON, OF_STEP, OF_TASK].concat().join(", ");
            self.say(
                number,
                format!("“{key}” is no key. The keys are: {known}. Text begins with a capital letter."),
            );
        }
    }

    fn take_of_lesson(&mut self, key: &str, value: &str, number: usize) {
        if self.step.is_some() {
            self.say(
                number,
                format!("“{key}:” is said of the whole lesson: it stands above the first step."),
            );
            return;
        }
        match key {
            "key" if is_key(value) => self.lesson.key = value.to_owned(),
            "key" => {
                self.say(number, "A key is one word of small letters, digits and “-”, such as “word-order”.")
            }
            "group" => self.lesson.group = value.to_owned(),
            "about" => self.lesson.about = value.to_owned(),
            _ => match value.parse() {
                Ok(minutes @ 1..=120) => self.lesson.minutes = minutes,
                _ => self.say(number, format!("“{value}” is no number of minutes from 1 to 120.")),
            },
        }
    }

    fn take_of_step(&mut self, key: &str, value: &str, number: usize) {
        let Some(step) = &mut self.step else {
            self.say(number, format!("“{key}:” belongs to a step: it stands below a line “## …”."));
            return;
        };
        if self.exercise.is_some() {
            let more = if key == "task" { " A step has one task." } else { "" };
            self.say(number, format!("“{key}:” stands before “task:” in its step.{more}"));
            return;
        }
        match key {
            "device" => match Profile::of(value) {
                Some(device) => step.device = Some(device),
                None => {
                    let known: Vec<&str> = PROFILES.iter().map(|it| it.key).collect();
                    self.say(number, format!("“{value}” is no device. Known are: {}.", known.join(", ")));
                }
            },
            "protocol" => match Protocol::of(value) {
                Some(protocol) => step.protocol = Some(protocol),
                None => {
                    let known: Vec<&str> = PROTOCOLS.iter().map(|it| it.key).collect();
                    self.say(number, format!("“{value}” is no protocol. Known are: {}.", known.join(", ")));
                }
            },
            "telegram" => {
                step.telegrams.push(Telegram { text: value.to_owned(), remarks: Vec::new(), line: number });
            }
            "show" => match show(value) {
                Some(show) => step.show = show,
                None => self.say(number, "What can be shown is: bytes, sides, checksum, log, and line with a baud rate, such as “line 9600”."),
            },
            "holds" => match value.rsplit_once(" = ") {
                Some((name, value)) => {
                    let telegram = step.telegrams.len().saturating_sub(1);
                    let (name, value) = (name.trim().to_owned(), value.trim().to_owned());
                    step.statements.push(Statement { telegram, name, value, line: number });
                }
                None => self.say(number, "Expected “holds: Field = value”, such as “holds: Quantity = 3”."),
            },
            _ => self.exercise = Some(Draft { question: value.to_owned(), line: number, ..Draft::default() }),
        }
    }

    fn take_of_task(&mut self, draft: &mut Draft, key: &str, value: &str, number: usize) {
        let (first, remark) = value.split_once(" | ").unwrap_or((value, ""));
        let (first, remark) = (first.trim(), remark.trim());
        let asked = match key {
            "hint" if draft.hints.len() == 3 => return self.say(number, "A task has at most three hints."),
            "hint" => return draft.hints.push(value.to_owned()),
            "then" => return draft.then = value.to_owned(),
            "right" => return draft.right.push(first.to_owned()),
            "wrong" if remark.is_empty() => {
                return self.say(number, "Expected “wrong: answer | why it is wrong”: who is wrong wants to know why.");
            }
            "wrong" => return draft.wrong.push((first.to_owned(), remark.to_owned(), number)),
            "number" => Ask::Number { value: value.to_owned(), wrong: Vec::new() },
            "point" => Ask::Point { field: value.to_owned(), wrong: Vec::new() },
            "blank" => match value.split_once(" in ") {
                Some((fields, telegram)) => Ask::Blank {
                    fields: fields.split(';').map(|name| name.trim().to_owned()).collect(),
                    telegram: telegram.trim().to_owned(),
                },
                None => return self.say(number, "Expected “blank: Field; Field in bytes”, such as “blank: Quantity in 01 03 00 C8 00 03 84 35”."),
            },
            "build" => Ask::Build { telegram: value.to_owned() },
            "repair" => match value.split_once("->") {
                Some((damaged, telegram)) => {
                    Ask::Repair { damaged: damaged.trim().to_owned(), telegram: telegram.trim().to_owned() }
                }
                None => return self.say(number, "Expected “repair: damaged bytes -> right bytes”."),
            },
            _ => match bits(value) {
                Some(asked) => asked,
                None => return self.say(number, "Expected “bits: 00 -> 3C”, of one to four bytes on each side, with “as sum” behind them, or “as float” where four are one."),
            },
        };
        if draft.asked.is_some() {
            return self.say(number, "A task asks one thing: number, point, blank, build, repair or bits, or lines “right” and “wrong”.");
        }
        draft.asked = Some(asked);
    }

    fn end_step(&mut self) {
        self.end_task();
        self.lesson.steps.extend(self.step.take());
    }

    fn end_task(&mut self) {
        let Some(draft) = self.exercise.take() else { return };
        let Draft { question, asked, hints, wrong, right, then, line } = draft;
        let own = |(answer, remark, line)| Wrong { answer, remark, line };
        let ask = match asked {
            None if right.len() == 1 && !wrong.is_empty() => {
                let right = right.concat();
                let twice = wrong.iter().filter(|(text, ..)| *text == right);
                self.mistakes.extend(twice.map(|(text, _, at)| right_itself(text, *at)));
                let mut choices: Vec<Choice> =
                    wrong.into_iter().map(|(text, remark, _)| Choice { text, remark }).collect();
                choices.push(Choice { text: right.clone(), remark: String::new() });
                // By the alphabet, so that the order tells nothing.
                let choices = in_order(choices, |choice| choice.text.clone());
                let right = choices.iter().position(|choice| choice.text == right).unwrap_or_default();
                Some(Ask::Choose { choices, right })
            }
            Some(Ask::Number { value, .. }) if right.is_empty() => {
                for (text, _, at) in wrong.iter().filter(|(text, ..)| numbered(text).is_none()) {
                    self.say(*at, format!("“{text}” is no number, such as 200, 0x00C8 or 00C8h."));
                }
                Some(Ask::Number { value, wrong: wrong.into_iter().map(own).collect() })
            }
            Some(Ask::Point { field, .. }) if right.is_empty() => {
                Some(Ask::Point { field, wrong: wrong.into_iter().map(own).collect() })
            }
            Some(ask) if right.is_empty() && wrong.is_empty() => Some(ask),
            _ => None,
        };
        match (ask, &mut self.step) {
            (Some(ask), Some(step)) => step.exercise = Some(Exercise { question, ask, hints, then, line }),
            _ => self.say(line, "The task needs what is right: one line “right: …” with one or more “wrong: … | why”, or number, point, blank, build, repair or bits."),
        }
    }

    fn finish(mut self) -> (Lesson, Vec<Mistake>) {
        self.end_step();
        let Lesson { key, title, steps, .. } = &self.lesson;
        let missing = [
            (title.is_empty(), "A lesson begins with its title, such as “# Bytes and hex”."),
            (key.is_empty(), "A lesson needs a key for links, such as “key: bytes”."),
            (
                steps.is_empty(),
                "A lesson needs a step, which begins with a line such as “## The first byte”.",
            ),
        ];
        let missing = missing.into_iter().filter(|(is, _)| *is).map(|(_, said)| said);
        self.mistakes.extend(missing.map(|said| Mistake { line: 1, said: said.to_owned() }));
        (self.lesson, in_order(self.mistakes, |mistake| mistake.line))
    }
}

/// `key: value`. Keys are small letters, so that text can have colons.
pub(crate) fn key(line: &str) -> Option<(&str, &str)> {
    let (key, value) = line.split_once(':')?;
    let small = !key.is_empty() && key.len() <= 12 && key.bytes().all(|it| it.is_ascii_lowercase());
    (small && (value.is_empty() || value.starts_with(' '))).then(|| (key, value.trim()))
}

pub(crate) fn is_known(key: &str) -> bool {
    [OF_LESSON, OF_STEP, OF_TASK].iter().any(|keys| keys.contains(&key))
}

/// Whether a word can stand in a link.
fn is_key(word: &str) -> bool {
    let fits = |it: u8| it.is_ascii_lowercase() || it.is_ascii_digit() || it == b'-';
    !word.is_empty() && word.len() <= 40 && word.bytes().all(fits)
}

fn place_of(name: &str) -> Place {
    let number = |text: &str| text.trim().parse::<usize>().ok().filter(|at| *at < 10_000);
    let bytes = name.strip_prefix("bytes ").or_else(|| name.strip_prefix("byte ")).and_then(|span| {
        let (from, to) = span.split_once('-').unwrap_or((span, span));
        let (from, to) = (number(from)?, number(to)?);
        (from <= to).then(|| Span::new(from, to + 1))
    });
    match bytes {
        Some(span) => Place::Bytes(span),
        None if name == "all" => Place::Whole,
        None => Place::Field(name.to_owned()),
    }
}

fn show(word: &str) -> Option<Show> {
    Some(match word {
        "bytes" => Show::Bytes,
        "sides" => Show::Sides,
        "checksum" => Show::Checksum,
        "log" => Show::Log,
        _ => Show::Line(
            word.strip_prefix("line ")?
                .trim()
                .parse()
                .ok()
                .filter(|rate| (300..=12_000_000).contains(rate))?,
        ),
    })
}

fn bits(value: &str) -> Option<Ask> {
    let (value, reading) = match value.rsplit_once(" as ") {
        Some((value, "sum")) => (value, Reading::Sum),
        Some((value, "float")) => (value, Reading::Float),
        Some(_) => return None,
        None => (value, Reading::Hex),
    };
    let (from, to) = value.split_once("->")?;
    let (from, to) = (bytes(from), bytes(to));
    let fits = (1..=4).contains(&from.len())
        && from.len() == to.len()
        && (reading != Reading::Float || from.len() == 4);
    fits.then_some(Ask::Bits { from, to, reading })
}

//! Logs of one's own as tasks: what is wrong in them, and who did not answer. Only what the library itself sees
//! in a log is asked.

use buslens::field::{Direction, Format, Role, hex, in_order};
use buslens::tool::log::State;
use buslens::tool::{Options, Report, decode_pasted};

use crate::practice::Trouble;
use crate::random::Random;
use crate::task::{Choice, Expected, Given, Number, Task};

/// A conversation, as a task shows it: a line for each telegram.
#[derive(Clone, Debug)]
pub struct Log {
    pub text: String,
    options: Options,
    report: Report,
}

/// What can be done to a healthy conversation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spoil {
    Silence,
    Unanswered,
    Damaged,
    ByteLost,
    CheckSwapped,
    FlowControl,
    Echo,
    Retry,
}

impl Spoil {
    pub const ALL: [Self; 8] = [
        Self::Silence,
        Self::Unanswered,
        Self::Damaged,
        Self::ByteLost,
        Self::CheckSwapped,
        Self::FlowControl,
        Self::Echo,
        Self::Retry,
    ];

    /// What a log then shows; a unit that never answers is another question.
    const fn trouble(self) -> Option<Trouble> {
        Some(match self {
            Self::Silence => return None,
            Self::Unanswered => Trouble::Unanswered,
            Self::Damaged => Trouble::Damaged,
            Self::ByteLost => Trouble::ByteLost,
            Self::CheckSwapped => Trouble::CheckSwapped,
            Self::FlowControl => Trouble::FlowControl,
            Self::Echo => Trouble::Echo,
            Self::Retry => Trouble::Retry,
        })
    }

    pub const fn label(self) -> &'static str {
        match self.trouble() {
            Some(trouble) => trouble.text(),
            None => "A unit never answers",
        }
    }
}

/// What is asked of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Find {
    /// What is wrong with it.
    Fault,
    /// Which unit never answers.
    Unit,
}

impl Find {
    pub const ALL: [Self; 2] = [Self::Fault, Self::Unit];

    /// The stable word of sets.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Fault => "fault",
            Self::Unit => "unit",
        }
    }

    pub fn of(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|find| find.key() == key)
    }
}

/// More telegrams nobody reads for one question.
pub const MOST: usize = 40;

/// What is asked for where a log shows several things: the one that explains the others.
const GRAVEST: [Trouble; 12] = [
    Trouble::CheckSwapped,
    Trouble::FlowControl,
    Trouble::ByteLost,
    Trouble::Damaged,
    Trouble::Rejected,
    Trouble::OtherUnit,
    Trouble::Late,
    Trouble::Echo,
    Trouble::ByteCount,
    Trouble::OtherRegisters,
    Trouble::Retry,
    Trouble::Unanswered,
];

/// A line: when, whether the client speaks, and what.
type Line = (Option<String>, bool, Vec<u8>);

impl Log {
    /// A log as somebody pastes it. The message says why it is none for a task.
    pub fn of(text: &str, options: Options) -> Result<Self, String> {
        let report = decode_pasted(text, options.clone()).unwrap_or_default();
        match report.telegrams.len() {
            0 => Err("There is no telegram in it.".to_owned()),
            1 => Err("There is one telegram in it: a conversation has more.".to_owned()),
            count if count > MOST => Err(format!(
                "A task shows at most {MOST} telegrams, and these are {count}: choose some lines of it."
            )),
            _ => Ok(Self::written(&lines(&report), of_protocol(&report, options))),
        }
    }

    /// The telegrams around telegram `index` of a long text, as many as a task can show, as lines. A few telegrams
    /// are only their bytes.
    pub fn excerpt(text: &str, options: Options, index: usize) -> String {
        /// So many before it.
        const BEFORE: usize = MOST / 2;
        let report = decode_pasted(text, options.clone()).unwrap_or_default();
        let lines = lines(&report);
        if lines.len() <= 2 {
            return lines.iter().map(|line| hex(&line.2)).collect::<Vec<_>>().join("\n");
        }
        let from = index.saturating_sub(BEFORE).min(lines.len().saturating_sub(MOST));
        let shown = &lines[from..lines.len().min(from + MOST)];
        Self::written(shown, of_protocol(&report, options)).text
    }

    /// The log that these lines are.
    fn written(lines: &[Line], options: Options) -> Self {
        let fraction = |time: &str| time.rsplit_once('.').map_or(0, |(_, digits)| digits.len());
        let digits =
            lines.iter().filter_map(|line| line.0.as_deref().map(fraction)).max().unwrap_or_default();
        let line = |(time, client, bytes): &Line| {
            let time = time.as_deref().map_or(String::new(), |time| {
                let point = if time.contains('.') || digits == 0 { "" } else { "." };
                format!("{time}{point}{:0<missing$} ", "", missing = digits - fraction(time))
            });
            format!("{time}{} {}", if *client { "TX" } else { "RX" }, hex(bytes))
        };
        let text = lines.iter().map(line).collect::<Vec<_>>().join("\n");
        let report = decode_pasted(&text, options.clone()).unwrap_or_default();
        Self { text, options, report }
    }

    /// How it is read.
    pub const fn options(&self) -> &Options {
        &self.options
    }

    /// What the library sees in it, the gravest first.
    pub(crate) fn troubles(&self) -> Vec<Trouble> {
        let states = self.states();
        let mut seen: Vec<Trouble> = Vec::new();
        for trouble in (0..states.len()).filter_map(|index| self.shown(index, &states)) {
            if !seen.contains(&trouble) {
                seen.push(trouble);
            }
        }
        if seen.is_empty() && !states.iter().any(|state| state.is_wrong()) {
            seen.push(Trouble::Nothing);
        }
        in_order(seen, |trouble| GRAVEST.iter().position(|other| other == trouble))
    }

    /// Whether the library sees nothing wrong in it.
    pub fn is_healthy(&self) -> bool {
        self.troubles() == [Trouble::Nothing]
    }

    fn states(&self) -> Vec<State> {
        (0..self.report.telegrams.len()).map(|index| self.report.state(index)).collect()
    }

    /// What telegram `index` shows to be wrong.
    fn shown(&self, index: usize, states: &[State]) -> Option<Trouble> {
        let telegrams = &self.report.telegrams;
        let request = |at: &usize| telegrams[*at].guess.direction == Direction::Request;
        match states[index] {
            State::Damaged => self.damage(index),
            State::Cut => Some(Trouble::ByteLost),
            State::Refused => Some(Trouble::Rejected),
            State::Late => Some(Trouble::Late),
            State::Echo => Some(Trouble::Echo),
            State::Retry => Some(Trouble::Retry),
            State::Unanswered => Some(Trouble::Unanswered),
            State::Unasked => {
                let asked = (0..index).rev().find(request)?;
                match telegrams[asked].unit == telegrams[index].unit {
                    true => (states[asked] == State::Retry).then_some(Trouble::Late),
                    false => Some(Trouble::OtherUnit),
                }
            }
            State::Ok => {
                let detail = self.report.detail(index)?;
                let has = |code: &str| detail.problems().iter().any(|problem| problem.code == code);
                match () {
                    () if has("count-mismatch") || has("truncated") => Some(Trouble::ByteCount),
                    () if has("not-as-asked") => Some(Trouble::OtherRegisters),
                    () => None,
                }
            }
            // Nothing comes behind it.
            _ => {
                let telegram = &telegrams[index];
                let asks = (telegram.choice.protocol.exchange)(&telegram.line.bytes).is_some();
                (index + 1 == states.len() && request(&index) && asks).then_some(Trouble::Unanswered)
            }
        }
    }

    /// What happened to a damaged telegram.
    fn damage(&self, index: usize) -> Option<Trouble> {
        let cause = self.report.explanations(index).first()?.hypothesis.cause.key();
        Some(match cause {
            "check-swapped" => Trouble::CheckSwapped,
            "flow-control" => Trouble::FlowControl,
            "byte-missing" | "register-missing" => Trouble::ByteLost,
            "bit-flipped" | "byte-changed" | "digits-swapped" | "check-digit" => Trouble::Damaged,
            _ => return None,
        })
    }

    /// A task about it. The message says why there is none.
    pub fn task(&self, find: Find) -> Result<Task, String> {
        match find {
            Find::Fault => self.fault(),
            Find::Unit => self.silent(),
        }
    }

    fn is_profibus(&self) -> bool {
        self.report.telegrams.iter().any(|it| it.choice.protocol.key.starts_with("profibus"))
    }

    fn intro(&self) -> String {
        let who = if self.is_profibus() { "master" } else { "client" };
        format!("A log from a plant: TX is what the {who} sends, RX what it hears.")
    }

    fn given(&self) -> Vec<Given> {
        vec![Given::Text(self.text.clone())]
    }

    fn fault(&self) -> Result<Task, String> {
        let seen = self.troubles();
        let Some(right) = seen.first().copied() else {
            return Err("Buslens itself cannot say what is wrong in it.".to_owned());
        };
        let alike = [Trouble::ByteLost, Trouble::FlowControl];
        let fits = |other: &Trouble| {
            let same = alike.contains(other) && alike.contains(&right);
            !seen.contains(other) && !same && *other != Trouble::WordOrder
        };
        let others: Vec<Trouble> = Trouble::ALL.into_iter().filter(fits).collect();
        let mut random = Random::of(&self.text.bytes().map(u64::from).collect::<Vec<_>>());
        let mut all = random.some_of(&others, 3);
        all.push(right);
        random.shuffle(&mut all);
        let place = self.place(right).map_or_else(
            || "Every request has its response.".to_owned(),
            |line| format!("Look at line {}.", line + 1),
        );
        Ok(Task {
            question: format!("{} What is wrong here?", self.intro()),
            given: self.given(),
            hints: vec![
                "Go through it line by line: which response belongs to which request?".to_owned(),
                right.rule().to_owned(),
                place.clone(),
            ],
            working: vec![place, format!("So: {}.", right.text())],
            expected: Expected::Choice {
                choices: all.iter().map(|one| Choice::new(one.text(), one.remark())).collect(),
                right: all.iter().position(|one| *one == right).unwrap_or_default(),
            },
        })
    }

    /// The first telegram that shows it.
    fn place(&self, trouble: Trouble) -> Option<usize> {
        let states = self.states();
        (0..states.len()).find(|index| self.shown(*index, &states) == Some(trouble))
    }

    /// The units that are asked, and those of them that never answer.
    fn units(&self) -> [Vec<u8>; 2] {
        let (mut asked, mut answered) = (Vec::new(), Vec::new());
        for telegram in &self.report.telegrams {
            let Some(unit) = telegram.unit else { continue };
            let request = telegram.guess.direction == Direction::Request;
            // Nobody answers a broadcast.
            let asks = (telegram.choice.protocol.exchange)(&telegram.line.bytes).is_some();
            match request {
                true if asks && !asked.contains(&unit) => asked.push(unit),
                false => answered.push(unit),
                true => {}
            }
        }
        let silent = asked.iter().copied().filter(|unit| !answered.contains(unit)).collect();
        [asked, silent]
    }

    fn silent(&self) -> Result<Task, String> {
        let [asked, silent] = self.units();
        let [unit] = silent[..] else {
            let said = if silent.is_empty() { "every unit answers" } else { "several units never answer" };
            return Err(format!("“find: unit” asks which unit never answers, and here {said}."));
        };
        let profibus = self.is_profibus();
        let who = if profibus { "station" } else { "unit" };
        let others: Vec<String> =
            asked.iter().filter(|other| **other != unit).map(|other| other.to_string()).collect();
        let label = if profibus { "Station" } else { "Unit" };
        Ok(Task {
            question: format!("{} Which {who} never answers? Give its address in decimal.", self.intro()),
            given: self.given(),
            hints: vec![
                "Look for a TX without an RX behind it.".to_owned(),
                "An exception is a response, too; and who answers at the second try is not silent."
                    .to_owned(),
                format!("It is {unit:02X}h: {} × 16 + {}.", unit >> 4, unit & 15),
            ],
            working: vec![
                match others.is_empty() {
                    true => "Nobody answers.".to_owned(),
                    false => format!("These answered: {}.", others.join(", ")),
                },
                format!("{unit:02X}h was asked and never answered: {who} {unit}."),
            ],
            expected: Expected::Number(Number::new(label, unit.into(), 1, Format::Decimal).role(Role::Unit)),
        })
    }

    /// It with something wrong, and what is to be asked of that; `None` where it cannot be so, or nobody could tell.
    pub fn spoiled(&self, spoil: Spoil, random: &mut Random) -> Option<(Self, Find)> {
        /// A place by chance may be one where it shows as something else.
        const TRIES: usize = 20;
        (0..TRIES).find_map(|_| {
            let log = Self::written(&self.changed(spoil, random)?, self.options.clone());
            match spoil.trouble() {
                Some(trouble) => (log.troubles().first() == Some(&trouble)).then_some((log, Find::Fault)),
                None => log.silent().is_ok().then_some((log, Find::Unit)),
            }
        })
    }

    fn changed(&self, spoil: Spoil, random: &mut Random) -> Option<Vec<Line>> {
        let mut lines = lines(&self.report);
        let all: Vec<usize> = (0..lines.len()).filter(|at| !lines[*at].1).collect();
        if all.is_empty() {
            return None;
        }
        let at = random.one_of(&all);
        match spoil {
            Spoil::Silence => {
                let unit = self.report.telegrams.get(at)?.unit?;
                let of_unit = |at: usize| self.report.telegrams.get(at).and_then(|it| it.unit) == Some(unit);
                let mut index = 0;
                lines.retain(|line| {
                    index += 1;
                    line.1 || !of_unit(index - 1)
                });
            }
            Spoil::Unanswered => {
                lines.remove(at);
            }
            Spoil::Damaged => {
                let byte = random.below(lines[at].2.len());
                lines[at].2[byte] ^= 1 << random.below(8);
            }
            Spoil::ByteLost => {
                let byte = random.below(lines[at].2.len());
                lines[at].2.remove(byte);
            }
            Spoil::CheckSwapped => all.iter().for_each(|at| {
                let bytes = &mut lines[*at].2;
                let end = bytes.len();
                if end > 2 {
                    bytes.swap(end - 1, end - 2);
                }
            }),
            Spoil::FlowControl => {
                all.iter().for_each(|at| lines[*at].2.retain(|byte| !matches!(byte, 0x11 | 0x13)));
            }
            Spoil::Echo => {
                let echoed = |line: Line| {
                    let echo = line.1.then(|| (line.0.clone(), false, line.2.clone()));
                    std::iter::once(line).chain(echo)
                };
                lines = lines.into_iter().flat_map(echoed).collect();
            }
            Spoil::Retry => {
                let request = lines[..at].iter().rposition(|line| line.1)?;
                lines.insert(request, lines[request].clone());
            }
        }
        // An echo doubles them.
        lines.truncate(MOST);
        Some(lines)
    }
}

/// With the protocol of its telegrams, so that they are read in the same way whatever is done to them.
fn of_protocol(report: &Report, options: Options) -> Options {
    let first = report.telegrams.first().map(|telegram| telegram.choice.protocol);
    Options { protocol: options.protocol.or(first), ..options }
}

/// The telegrams of a report as lines.
fn lines(report: &Report) -> Vec<Line> {
    let line = |telegram: &buslens::tool::Telegram| {
        let client = telegram.guess.direction == Direction::Request;
        (telegram.time.clone(), client, telegram.line.bytes.clone())
    };
    report.telegrams.iter().map(line).collect()
}

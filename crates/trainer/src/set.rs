//! Sets of tasks that somebody put together, as a text that people can read and write. docs/practice.md has the
//! format: that of lessons, whose tasks a set can have, and three lines more.

use std::ops::Range;

use buslens::field::{hex, in_order};
use buslens::tool::steps::bytes;
use buslens::tool::{Options, Profile, Report, decode};

use crate::fault::{self, Fault};
use crate::lesson::{self, Ask, Lesson, Mistake, Step};
use crate::log::{Find, Log, Spoil};
use crate::practice::{NoRound, QUESTIONS, Round, Seed, all_fields};
use crate::random::Random;
use crate::task::{Expected, Given, Task, Telegram};

/// A set of tasks.
#[derive(Clone, Debug, Default)]
pub struct Set {
    pub title: String,
    /// What it is about, in a sentence; may be empty.
    pub about: String,
    pub tasks: Vec<Titled>,
}

/// A task of a set.
#[derive(Clone, Debug)]
pub struct Titled {
    pub title: String,
    /// Which of its [`places`] it is of: one can hold all questions of a round.
    pub place: usize,
    pub task: Task,
}

/// As many tasks as a result code can count.
pub const MOST: usize = 31;

/// The lines that a set has and a lesson does not.
const OWN: [&str; 3] = ["practice", "came", "find"];

/// A line of those.
struct OwnLine<'a> {
    key: &'a str,
    value: &'a str,
    number: usize,
}

/// Reads a set, with what cannot be understood in its text.
pub fn read(text: &str) -> (Set, Vec<Mistake>) {
    let text = text.trim_start_matches('\u{feff}');
    let mut mistakes = Vec::new();
    let mut own = Vec::new();
    // A lesson has a key, and knows none of the lines of a set: a line more before it, and those empty.
    let mut rest = "key: set\n".to_owned();
    for (line, number) in text.lines().zip(1..) {
        match lesson::key(line) {
            Some((key, value)) if OWN.contains(&key) => own.push(OwnLine { key, value, number }),
            Some((key, _)) if !lesson::is_known(key) => mistakes.push(Mistake {
                line: number,
                said: format!(
                    "“{key}” is no key. In a set there are practice, came and find, and the keys of lessons."
                ),
            }),
            _ => rest.push_str(line),
        }
        rest.push('\n');
    }
    let (lesson, of_lesson) = lesson::read(&rest);
    let of_lines = of_lesson.into_iter().filter(|mistake| mistake.line > 1);
    mistakes.extend(of_lines.map(|mistake| Mistake { line: mistake.line - 1, ..mistake }));
    let Lesson { title, about, steps, .. } = lesson;
    if title.is_empty() {
        mistakes.push(Mistake {
            line: 1,
            said: "A set begins with its title, such as “# Friday's test”.".to_owned(),
        });
    }
    let first = steps.first().map_or(usize::MAX, |step| step.line - 1);
    let stray = own.iter().filter(|line| line.number < first);
    mistakes.extend(stray.map(|line| Mistake {
        line: line.number,
        said: format!("“{}:” belongs to a task: it stands below a line “## …”.", line.key),
    }));
    let mut tasks: Vec<Titled> = Vec::new();
    for (at, step) in steps.iter().enumerate() {
        // It was read with a line more before it.
        let line = step.line - 1;
        let end = steps.get(at + 1).map_or(usize::MAX, |next| next.line - 1);
        let lines: Vec<&OwnLine> = own.iter().filter(|own| (line..end).contains(&own.number)).collect();
        let mut wrong = Vec::new();
        step.check(&mut wrong);
        mistakes.extend(wrong.into_iter().map(|it| Mistake { line: it.line.saturating_sub(1), ..it }));
        match of_step(step, &lines) {
            Ok(all) => {
                let title = &step.title;
                tasks.extend(all.into_iter().map(|task| Titled { title: title.clone(), place: at, task }));
            }
            // A line that is not understood is why nothing is asked.
            Err((None, _)) if mistakes.iter().any(|mistake| (line..end).contains(&mistake.line)) => {}
            Err((at, said)) => mistakes.push(Mistake { line: at.unwrap_or(line), said }),
        }
    }
    if steps.is_empty() {
        let said = "A set needs a task, which begins with a line such as “## Who did not answer?”.";
        mistakes.push(Mistake { line: 1, said: said.to_owned() });
    }
    if tasks.len() > MOST {
        let said = format!("A set has at most {MOST} tasks, and this one has {}.", tasks.len());
        mistakes.push(Mistake { line: 1, said });
    }
    let mut mistakes = in_order(mistakes, |mistake| mistake.line);
    // What a line lacks is said once.
    mistakes.dedup_by_key(|mistake| mistake.line);
    (Set { title, about, tasks }, mistakes)
}

/// The tasks of a step; else what is wrong, and in which line if not in its title's.
fn of_step(step: &Step, lines: &[&OwnLine]) -> Result<Vec<Task>, (Option<usize>, String)> {
    let intro = step.text.join(" ");
    let led = |mut task: Task| {
        if !intro.is_empty() {
            task.question = format!("{intro} {}", task.question);
        }
        task
    };
    let ways = lines.len() + usize::from(step.exercise.is_some());
    match lines {
        _ if ways > 1 => {
            Err((lines.last().map(|line| line.number), "A task asks one thing: practice, came, find or task.".to_owned()))
        }
        [line] => {
            let made = match line.key {
                "practice" => generated(line.value),
                "came" => hidden(step, line.value).map(|task| vec![task]),
                _ => found(step, line.value).map(|task| vec![task]),
            };
            made.map(|all| all.into_iter().map(led).collect()).map_err(|said| (Some(line.number), said))
        }
        _ => match &step.exercise {
            Some(exercise) => own(step).map(|task| vec![led(task)]).map_err(|said| (Some(exercise.line - 1), said)),
            None => Err((
                None,
                "This task asks nothing yet: it needs a line “practice: …”, “came: …”, “find: …” or “task: …”.".to_owned(),
            )),
        },
    }
}

/// Questions of a round: all, or the one that is named.
fn generated(place: &str) -> Result<Vec<Task>, String> {
    let (round, index) = Round::of(place).map_err(|why| match why {
        NoRound::Newer => "It is of a newer version of the page: reload this one.".to_owned(),
        NoRound::Damaged => {
            "Expected “practice: 1.decode.2.K7QM.3”: version, kind, level, seed and question, as links have them.".to_owned()
        }
    })?;
    let one = place.split('.').count() > 4;
    let chosen = |at: usize| !one || at == index;
    Ok(round
        .questions()
        .into_iter()
        .enumerate()
        .filter(|(at, _)| chosen(*at))
        .map(|(_, task)| task)
        .collect())
}

/// A telegram and what came instead of it.
fn hidden(step: &Step, came: &str) -> Result<Task, String> {
    let text: Vec<&str> = step.telegrams.iter().map(|telegram| telegram.text.as_str()).collect();
    if text.is_empty() || text.len() > 2 {
        return Err("Above “came:” stands “telegram: …” as it should be, with its request before it if it answers one.".to_owned());
    }
    let telegram = fault::telegram(&text.join("\n"), step.protocol, step.device)?;
    fault::hidden(&telegram, bytes(came))
}

/// Something to find in a log.
fn found(step: &Step, key: &str) -> Result<Task, String> {
    let find = Find::of(key)
        .ok_or("Expected “find: fault” (what is wrong) or “find: unit” (who never answers).".to_owned())?;
    if step.log.is_empty() {
        return Err("What is to be found stands in a log above it, whose lines begin with “| ”.".to_owned());
    }
    Log::of(&step.log, step.options())?.task(find)
}

/// A task as lessons have it.
fn own(step: &Step) -> Result<Task, String> {
    let asked = step.exercise.as_ref().and_then(|exercise| Some((exercise, exercise.task(step)?)));
    let Some((exercise, mut task)) = asked else {
        return Err("Pointing at bytes and setting bits are for lessons: a set asks right and wrong, number, blank, build or repair.".to_owned());
    };
    let report = step.report();
    let fill = |text: &str| step.filled(text, &report).unwrap_or_else(|_| text.to_owned());
    task.question = fill(&task.question);
    task.hints.iter_mut().for_each(|hint| *hint = fill(hint));
    let known = (0..report.telegrams.len()).map(|index| Given::Telegram(known(step, &report, index)));
    task.given = known.collect();
    if !step.log.is_empty() {
        task.given.push(Given::Text(step.log.trim_end().to_owned()));
    }
    if let (Ask::Repair { damaged, .. }, Expected::Telegram(telegram)) = (&exercise.ask, &task.expected) {
        task.given.push(Given::Telegram(telegram.with(bytes(damaged))));
    }
    task.working = match &task.expected {
        Expected::Telegram(telegram) | Expected::Blanks { telegram, .. } => all_fields(telegram),
        expected => vec![expected.text()],
    };
    task.working.extend(Some(fill(&exercise.then)).filter(|then| !then.is_empty()));
    Ok(task)
}

fn known(step: &Step, report: &Report, index: usize) -> Telegram {
    let telegram = &report.telegrams[index];
    Telegram {
        request: telegram.answers.map(|request| report.telegrams[request].line.bytes.clone()),
        options: step.options(),
        ..Telegram::new(telegram.line.bytes.clone(), telegram.guess.direction, telegram.choice.protocol)
    }
}

/// What a set is told apart by, in links and results: of its lines, whatever ends them.
pub fn seed(text: &str) -> Seed {
    // FNV-1a.
    let lines = text.lines().flat_map(|line| line.trim_end().bytes().chain([b'\n']));
    Seed::new(
        lines.fold(0xCBF2_9CE4_8422_2325, |hash: u64, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
        }) >> 20,
    )
}

/// A set without a task.
pub fn empty(title: &str) -> String {
    format!("# {}\n", one_line(title))
}

/// Where each task stands in the text, from its line `## …` on.
pub fn places(text: &str) -> Vec<Range<usize>> {
    let mut starts = Vec::new();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        if line.starts_with("## ") {
            starts.push(at);
        }
        at += line.len();
    }
    let ends = starts.iter().skip(1).copied().chain([text.len()]);
    starts.iter().copied().zip(ends).map(|(from, to)| from..to).collect()
}

/// The text with another task at its end.
pub fn with(text: &str, title: &str, lines: &str) -> String {
    format!("{}\n\n## {}\n{}\n", text.trim_end(), one_line(title), lines.trim_end())
}

/// The text without task `at`.
pub fn without(text: &str, at: usize) -> String {
    let mut text = text.to_owned();
    if let Some(place) = places(&text).get(at) {
        text.replace_range(place.clone(), "");
    }
    text
}

/// The text with task `at` behind the next one.
pub fn later(text: &str, at: usize) -> String {
    match places(text).get(at..at + 2) {
        Some([one, other]) => {
            let part = |place: &Range<usize>| text[place.clone()].trim_end();
            format!("{}{}\n\n{}\n\n{}", &text[..one.start], part(other), part(one), &text[other.end..])
        }
        _ => text.to_owned(),
    }
}

/// The text with another title for task `at`, or, without that, for the whole.
pub fn titled(text: &str, at: Option<usize>, title: &str) -> String {
    let all = places(text);
    let (from, mark) = match at {
        Some(at) => (all.get(at).map(|place| place.start), "## "),
        None => (text.starts_with("# ").then_some(0), "# "),
    };
    let Some(from) = from else { return text.to_owned() };
    let end = text[from..].find('\n').map_or(text.len(), |length| from + length);
    format!("{}{mark}{}{}", &text[..from], one_line(title), &text[end..])
}

/// A title is one line.
fn one_line(title: &str) -> String {
    let title = title.split_whitespace().collect::<Vec<_>>().join(" ");
    if title.is_empty() { "No title yet".to_owned() } else { title }
}

/// The lines of a task of a round.
pub fn of_round(round: &Round, index: usize) -> String {
    format!("practice: {}.{}", round.place(), index.min(QUESTIONS - 1) + 1)
}

/// The line of all tasks of a round.
pub fn of_rounds(round: &Round) -> String {
    format!("practice: {}", round.place())
}

/// The lines of a telegram and what came instead of it.
pub fn of_telegram(telegram: &Telegram, came: &[u8]) -> String {
    let mut lines = format!("protocol: {}\n", telegram.protocol.key);
    if let Some(device) = telegram.options.device {
        lines += &format!("device: {}\n", device.key);
    }
    for bytes in telegram.request.iter().chain([&telegram.bytes]) {
        lines += &format!("telegram: {}\n", hex(bytes));
    }
    lines + &format!("came: {}", hex(came))
}

/// The lines of a log and what is to be found in it.
pub fn of_log(log: &Log, find: Find) -> String {
    let mut lines = String::new();
    let options = log.options();
    if let Some(protocol) = options.protocol {
        lines += &format!("protocol: {}\n", protocol.key);
    }
    if let Some(device) = options.device {
        lines += &format!("device: {}\n", device.key);
    }
    log.text.lines().for_each(|line| lines += &format!("| {line}\n"));
    lines + &format!("find: {}", find.key())
}

/// What is to be found in what somebody pastes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hide {
    /// Whatever can be in it, by chance; what is wrong already stays as it is.
    Any,
    /// A fault in a telegram.
    Fault(Fault),
    /// A log as it is.
    Log(Find),
    /// A log with something wrong.
    Spoil(Spoil),
}

impl Hide {
    /// The title of the task, and its lines.
    fn titled(self, lines: String) -> (&'static str, String) {
        let title = match self {
            Self::Fault(_) => "What happened to it?",
            Self::Log(Find::Unit) => "Who does not answer?",
            _ => "What is wrong here?",
        };
        (title, lines)
    }
}

/// A task of what somebody pastes: its title and its lines. The message says why there is none.
pub fn made(
    text: &str,
    device: Option<&'static Profile>,
    hide: Hide,
    random: &mut Random,
) -> Result<(&'static str, String), String> {
    const CANNOT: &str = "This cannot be in it so that it can be found: choose something else.";
    let telegrams = decode(text, Options { device, ..Options::default() }).telegrams.len();
    let log = || Log::of(text, Options { device, ..Options::default() });
    let found = |find: Find| -> Result<_, String> {
        let log = log()?;
        log.task(find)?;
        Ok(Hide::Log(find).titled(of_log(&log, find)))
    };
    match hide {
        Hide::Any if telegrams > 2 => {
            if !log()?.is_healthy() {
                return found(Find::Fault);
            }
            let mut all = Spoil::ALL;
            random.shuffle(&mut all);
            let made = all.into_iter().find_map(|spoil| made(text, device, Hide::Spoil(spoil), random).ok());
            made.ok_or_else(|| CANNOT.to_owned())
        }
        Hide::Any => {
            let telegram = fault::telegram(text, None, device)?;
            let mut all = Fault::ALL;
            random.shuffle(&mut all);
            let came = all.into_iter().find_map(|fault| fault.inject(&telegram, random));
            let (came, _) = came.ok_or(CANNOT)?;
            Ok(Hide::Fault(Fault::WrongByte).titled(of_telegram(&telegram, &came)))
        }
        Hide::Fault(fault) => {
            let telegram = fault::telegram(text, None, device)?;
            let (came, _) = fault.inject(&telegram, random).ok_or(CANNOT)?;
            Ok(hide.titled(of_telegram(&telegram, &came)))
        }
        Hide::Log(find) => found(find),
        Hide::Spoil(spoil) => {
            let log = log()?;
            if !log.is_healthy() {
                return Err("Something is wrong in this log already: ask for that.".to_owned());
            }
            let (log, find) = log.spoiled(spoil, random).ok_or(CANNOT)?;
            Ok(Hide::Log(find).titled(of_log(&log, find)))
        }
    }
}

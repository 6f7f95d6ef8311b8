//! Where in Practice somebody is, and what came of the questions so far.

use std::collections::HashMap;

use leptos::prelude::*;

use crate::browser::storage;
use buslens_trainer::practice::{NoRound, QUESTIONS, Round};
use buslens_trainer::{Answer, Verdict};

/// What is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Where {
    Start,
    /// A question of a round, from 0.
    Question(Round, usize),
    /// What came of a round.
    Done(Round),
    /// A round made for paper.
    Paper(Round),
    /// A question of a round, large, field by field.
    Wall(Round, usize),
    /// Results of many, in a table.
    Results,
}

impl Where {
    /// What words of a link lead to.
    pub fn of(place: &str) -> Result<Self, NoRound> {
        if place.is_empty() {
            return Ok(Self::Start);
        }
        if place == RESULTS {
            return Ok(Self::Results);
        }
        let part = |end: &str| place.strip_suffix(end).map(|round| Round::of(round).map(|(round, _)| round));
        if let Some(round) = part(".done") {
            return Ok(Self::Done(round?));
        }
        if let Some(round) = part(".paper") {
            return Ok(Self::Paper(round?));
        }
        if let Some(rest) = place.strip_prefix("wall.") {
            return Round::of(rest).map(|(round, index)| Self::Wall(round, index));
        }
        Round::of(place).map(|(round, index)| Self::Question(round, index))
    }

    pub fn place(self) -> String {
        match self {
            Self::Start => String::new(),
            Self::Question(round, index) => format!("{}.{}", round.place(), index + 1),
            Self::Done(round) => format!("{}.done", round.place()),
            Self::Paper(round) => format!("{}.paper", round.place()),
            Self::Wall(round, index) => format!("wall.{}.{}", round.place(), index + 1),
            Self::Results => RESULTS.to_owned(),
        }
    }
}

const RESULTS: &str = "results";

/// How it went with a question.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outcome {
    #[default]
    Open,
    /// Right at the first answer.
    First,
    /// Right after others.
    Later,
    /// The answer was shown.
    Shown,
}

impl Outcome {
    /// The letter that it is kept by.
    const fn letter(self) -> char {
        match self {
            Self::Open => '-',
            Self::First => '1',
            Self::Later => '2',
            Self::Shown => '0',
        }
    }

    fn of(letter: char) -> Self {
        [Self::First, Self::Later, Self::Shown]
            .into_iter()
            .find(|it| it.letter() == letter)
            .unwrap_or_default()
    }

    pub const fn words(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::First => "right at the first answer",
            Self::Later => "right after another try",
            Self::Shown => "the answer was shown",
        }
    }
}

/// What somebody did with a question.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attempt {
    /// What is typed or chosen.
    pub answer: Option<Answer>,
    /// What was said to it.
    pub verdict: Option<Verdict>,
    /// Answers that were wrong.
    pub wrong: usize,
    /// Hints that are shown.
    pub hints: usize,
    pub outcome: Outcome,
}

/// What came of the questions; it outlasts every switch of views.
#[derive(Clone, Copy)]
pub struct PracticeState {
    /// By the place of the round and the index of the question.
    attempts: RwSignal<HashMap<(String, usize), Attempt>>,
    /// What was pasted into the table of results.
    pub codes: RwSignal<String>,
    /// The next question gets the focus: somebody went on to it.
    pub moved: StoredValue<bool>,
}

/// Of so many rounds this browser keeps what came of them.
const KEPT: usize = 200;
const KEY: &str = "practice";

impl PracticeState {
    pub fn new() -> Self {
        let mut attempts = HashMap::new();
        for line in storage::kept(KEY).unwrap_or_default().lines() {
            let Some((round, letters)) = line.split_once(' ') else { continue };
            if Round::of(round).is_err() {
                continue;
            }
            for (index, letter) in letters.chars().take(QUESTIONS).enumerate() {
                let outcome = Outcome::of(letter);
                attempts.insert((round.to_owned(), index), Attempt { outcome, ..Attempt::default() });
            }
        }
        Self {
            attempts: RwSignal::new(attempts),
            codes: RwSignal::new(String::new()),
            moved: StoredValue::new(false),
        }
    }

    pub fn attempt(self, round: Round, index: usize) -> Attempt {
        let key = (round.place(), index);
        self.attempts.with(|all| all.get(&key).cloned().unwrap_or_default())
    }

    /// What came of each question of a round.
    pub fn outcomes(self, round: Round) -> [Outcome; QUESTIONS] {
        let place = round.place();
        self.attempts.with(|all| {
            std::array::from_fn(|index| {
                all.get(&(place.clone(), index)).map_or(Outcome::Open, |attempt| attempt.outcome)
            })
        })
    }

    /// How many questions of this kind and level were answered so far.
    pub fn answered(self, of: impl Fn(Round) -> bool) -> usize {
        self.attempts.with(|all| {
            let done = all.iter().filter(|(_, attempt)| attempt.outcome != Outcome::Open);
            done.filter(|((place, _), _)| Round::of(place).is_ok_and(|(round, _)| of(round))).count()
        })
    }

    pub fn change(self, round: Round, index: usize, change: impl FnOnce(&mut Attempt)) {
        self.attempts.update(|all| change(all.entry((round.place(), index)).or_default()));
        self.keep();
    }

    /// Begins a round anew.
    pub fn forget(self, round: Round) {
        let place = round.place();
        self.attempts.update(|all| all.retain(|(other, _), _| *other != place));
        self.keep();
    }

    /// Keeps what came of them for the next visit. A full or forbidden store only means that it is gone then.
    fn keep(self) {
        let text = self.attempts.with_untracked(|all| {
            let mut rounds: Vec<&String> = Vec::new();
            for ((place, _), attempt) in all {
                if attempt.outcome != Outcome::Open && !rounds.contains(&place) {
                    rounds.push(place);
                }
            }
            let letter = |place: &String, index| {
                all.get(&(place.clone(), index)).map_or(Outcome::Open, |attempt| attempt.outcome).letter()
            };
            let line = |place: &&String| {
                let letters: String = (0..QUESTIONS).map(|index| letter(place, index)).collect();
                format!("{place} {letters}")
            };
            rounds.iter().take(KEPT).map(line).collect::<Vec<_>>().join("\n")
        });
        let _ = storage::keep(KEY, &text);
    }
}

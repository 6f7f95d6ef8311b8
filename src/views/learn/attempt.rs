//! What somebody did with a task so far, in a lesson or in practice.

use buslens_trainer::{Answer, Verdict};

/// How it went with a question of practice.
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
    pub const fn letter(self) -> char {
        match self {
            Self::Open => '-',
            Self::First => '1',
            Self::Later => '2',
            Self::Shown => '0',
        }
    }

    pub fn of(letter: char) -> Self {
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

/// What somebody did with a task so far.
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

impl Attempt {
    /// Takes an answer: what was said is about the one before.
    pub fn enter(&mut self, answer: Answer) {
        if self.answer.as_ref() != Some(&answer) {
            self.verdict = None;
        }
        self.answer = Some(answer);
    }

    /// Takes what there is to say to the answer.
    pub fn take(&mut self, verdict: Verdict) {
        self.wrong += usize::from(matches!(verdict, Verdict::Wrong(_)));
        self.verdict = Some(verdict);
    }

    /// Whether nothing can be changed any more.
    pub fn is_closed(&self) -> bool {
        self.outcome != Outcome::Open
    }

    /// Whether the answer was found, or is shown.
    pub fn is_over(&self) -> bool {
        self.is_closed() || self.is_checked(true)
    }

    /// Whether the answer was checked, and found right or not.
    pub fn is_checked(&self, right: bool) -> bool {
        self.verdict.as_ref().is_some_and(|verdict| verdict.is_right() == right)
    }

    /// What was typed.
    pub fn text(&self) -> Option<&str> {
        match &self.answer {
            Some(Answer::Text(text)) => Some(text),
            _ => None,
        }
    }
}

//! Tasks in a row: a round, a set that somebody prepared, or a task by itself from a link of version 1.

use std::sync::Arc;

use buslens::tool::{Profile, Protocol};
use buslens_trainer::Task;
use buslens_trainer::fault::{self, Fault};
use buslens_trainer::practice::{NoRound, Round, Seed};
use buslens_trainer::random::Random;
use buslens_trainer::result::About;
use buslens_trainer::set;

/// Which tasks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    Round(Round),
    /// The set whose text has this seed.
    Set(Seed),
    /// `own.1.bit-flipped.K7QM.memograph-rsg45.010300C800038435-0103…`: version, fault, seed, device, and the
    /// telegram behind its request.
    Own(String),
}

/// The first word of places of sets.
pub const SET: &str = "set.";
const OWN: &str = "own.";

impl Source {
    /// What words of a link name, and which task, from 0.
    pub fn of(place: &str) -> Result<(Self, usize), NoRound> {
        // The last word may be the task's number.
        let numbered = |words: usize| match place.match_indices('.').nth(words - 1) {
            None => Some((place, 0)),
            Some((at, _)) => {
                let number: usize = place[at + 1..].parse().ok()?;
                Some((&place[..at], number.checked_sub(1)?))
            }
        };
        if let Some(rest) = place.strip_prefix(SET) {
            let (_, index) = numbered(2).ok_or(NoRound::Damaged)?;
            let seed = rest.split('.').next().and_then(Seed::of).ok_or(NoRound::Damaged)?;
            return Ok((Self::Set(seed), index));
        }
        if place.starts_with(OWN) {
            let (own, index) = numbered(6).ok_or(NoRound::Damaged)?;
            return Ok((Self::Own(own.to_owned()), index));
        }
        Round::of(place).map(|(round, index)| (Self::Round(round), index))
    }

    pub fn place(&self) -> String {
        match self {
            Self::Round(round) => round.place(),
            Self::Set(seed) => format!("{SET}{seed}"),
            Self::Own(place) => place.clone(),
        }
    }
}

/// Tasks in a row.
#[derive(Clone)]
pub struct Series {
    pub source: Source,
    pub title: String,
    /// Behind the title: ", level 2".
    pub level: String,
    pub seed: Option<Seed>,
    /// What it is about, in a sentence; may be empty.
    pub about: String,
    pub tasks: Vec<Task>,
    /// What the tasks are called; empty where they have no names.
    pub titles: Vec<String>,
}

impl Series {
    pub fn of_round(round: Round) -> Self {
        Self {
            source: Source::Round(round),
            title: round.kind.label().to_owned(),
            level: format!(", level {}", round.level),
            seed: Some(round.seed),
            about: String::new(),
            tasks: round.questions(),
            titles: Vec::new(),
        }
    }

    /// A set by its text, which was read without mistakes before.
    pub fn of_set(text: &str) -> Self {
        let seed = set::seed(text);
        let (set, _) = set::read(text);
        let (titles, tasks) = set.tasks.into_iter().map(|titled| (titled.title, titled.task)).unzip();
        Self {
            source: Source::Set(seed),
            title: set.title,
            level: String::new(),
            seed: Some(seed),
            about: set.about,
            tasks,
            titles,
        }
    }

    pub fn of_own(place: &str) -> Option<Self> {
        let mut words = place.split('.').skip(1);
        words.next().filter(|version| *version == "1")?;
        let fault = Fault::of(words.next()?)?;
        let seed = Seed::of(words.next()?)?;
        let device = Profile::of(words.next()?);
        let text = words.next()?.replace('-', "\n");
        let telegram = fault::telegram(&text, Protocol::of("modbus-rtu"), device).ok()?;
        let task = fault::task(&telegram, fault, &mut Random::of(&[seed.number().into()]))?;
        Some(Self {
            source: Source::Own(place.to_owned()),
            title: "A task of somebody's own".to_owned(),
            level: String::new(),
            seed: None,
            about: String::new(),
            tasks: vec![task],
            titles: Vec::new(),
        })
    }

    /// Title and level.
    pub fn name(&self) -> String {
        format!("{}{}", self.title, self.level)
    }

    /// A name for files.
    pub fn file(&self) -> String {
        match &self.source {
            Source::Round(round) => format!("buslens-{}-{}-{}", round.kind.key(), round.level, round.seed),
            Source::Set(seed) => format!("buslens-set-{seed}"),
            Source::Own(_) => "buslens-task".to_owned(),
        }
    }

    /// What result codes say of it.
    pub fn result(&self) -> Option<About> {
        match self.source {
            Source::Round(round) => Some(About::Round(round)),
            Source::Set(seed) => Some(About::Set(seed)),
            Source::Own(_) => None,
        }
    }

    /// What stands at the foot of its papers.
    pub fn foot(&self) -> String {
        let seed = self.seed.map_or(String::new(), |seed| format!(" · seed {seed}"));
        match self.source {
            Source::Round(_) => format!("Buslens practice {}{seed}", self.source.place()),
            _ => format!("Buslens · {}{seed}", self.title),
        }
    }
}

/// A series that several screens share.
pub type Shared = Arc<Series>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lead_back() {
        for place in ["1.decode.2.K7QM", "set.K7QM", "own.1.bit-flipped.K7QM.any.010300C800038435"] {
            let (source, index) = Source::of(place).unwrap();
            assert_eq!((source.place().as_str(), index), (place, 0));
            assert_eq!(Source::of(&format!("{place}.4")), Ok((source, 3)), "{place}");
        }
        for damaged in ["set.K7", "set.", "set.K7QM.0", "set.K7QM.x", "own.1.a.b.c.d.e", "1.decode.2.K7QM.6"]
        {
            assert_eq!(Source::of(damaged), Err(NoRound::Damaged), "{damaged}");
        }
    }
}

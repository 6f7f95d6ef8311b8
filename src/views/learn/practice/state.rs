//! Where in Practice somebody is, what came of the questions so far, and the sets that were opened.

use std::collections::HashMap;
use std::sync::Arc;

use leptos::prelude::*;

use super::series::{Series, Shared, Source};
use crate::browser::storage;
use crate::components::toast::Toasts;
use crate::views::learn::attempt::{Attempt, Outcome};
use crate::views::learn::mistakes::Refused;
use buslens_trainer::practice::{NoRound, Seed};
use buslens_trainer::set;

/// What is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Where {
    Start,
    /// Where a set is prepared.
    Prepare,
    /// The same, with what is in Read as a task.
    FromRead,
    /// Results of many, in a table.
    Results,
    In(Source, Screen),
}

/// What is shown of tasks in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Screen {
    /// A task, from 0.
    Question(usize),
    /// What came of all.
    Done,
    /// Made for paper.
    Paper,
    /// A task, large, field by field.
    Wall(usize),
}

/// Words of links that name no tasks. A link to `own` is of before there were sets.
const NAMED: [(&str, Where); 5] = [
    ("", Where::Start),
    ("results", Where::Results),
    ("prepare", Where::Prepare),
    ("read", Where::FromRead),
    ("own", Where::Prepare),
];

impl Where {
    /// What words of a link lead to.
    pub fn of(place: &str) -> Result<Self, NoRound> {
        if let Some((_, named)) = NAMED.into_iter().find(|(key, _)| *key == place) {
            return Ok(named);
        }
        let whole = |place: &str, screen| Source::of(place).map(|(source, _)| Self::In(source, screen));
        if let Some(place) = place.strip_suffix(".done") {
            return whole(place, Screen::Done);
        }
        if let Some(place) = place.strip_suffix(".paper") {
            return whole(place, Screen::Paper);
        }
        match place.strip_prefix("wall.") {
            Some(rest) => Source::of(rest).map(|(source, index)| Self::In(source, Screen::Wall(index))),
            None => Source::of(place).map(|(source, index)| Self::In(source, Screen::Question(index))),
        }
    }

    pub fn place(&self) -> String {
        let Self::In(source, screen) = self else {
            return NAMED.iter().find(|(_, named)| named == self).map_or("", |(key, _)| key).to_owned();
        };
        let place = source.place();
        match screen {
            Screen::Question(index) => format!("{place}.{}", index + 1),
            Screen::Done => format!("{place}.done"),
            Screen::Paper => format!("{place}.paper"),
            Screen::Wall(index) => format!("wall.{place}.{}", index + 1),
        }
    }
}

/// Which question: the place of its round, or of a task by itself, and its index there.
pub type Key = (String, usize);

/// What came of the questions; it outlasts every switch of views.
#[derive(Clone, Copy)]
pub struct PracticeState {
    attempts: RwSignal<HashMap<Key, Attempt>>,
    /// The texts of sets that were opened, the latest first.
    pub sets: RwSignal<Vec<Arc<str>>>,
    pub refused: RwSignal<Option<Refused>>,
    /// The text of the set that is being prepared.
    pub draft: RwSignal<String>,
    /// What was pasted into the table of results.
    pub codes: RwSignal<String>,
    /// The telegram or the log that is to become a task.
    pub own: RwSignal<String>,
    /// The next question gets the focus: somebody went on to it.
    pub moved: StoredValue<bool>,
    /// What was made last: going from task to task makes nothing anew.
    made: StoredValue<Option<Shared>>,
    toasts: Toasts,
}

/// Of so many rounds this browser keeps what came of them.
const KEPT: usize = 200;
/// So many sets it keeps.
const KEPT_SETS: usize = 30;
/// Where they are kept.
const KEY: &str = "practice";
const SETS: &str = "practice-sets";
const DRAFT: &str = "practice-draft";
/// Stands between the texts of several sets.
const BETWEEN: char = '\u{1E}';
/// A set has some thousand characters.
pub const LONGEST_FILE: u32 = 300_000;

impl PracticeState {
    /// For the app, by whose context it says things.
    pub fn new() -> Self {
        let mut attempts = HashMap::new();
        for line in storage::kept(KEY).unwrap_or_default().lines() {
            let Some((place, letters)) = line.split_once(' ') else { continue };
            if Source::of(place).is_err() {
                continue;
            }
            for (index, letter) in letters.chars().take(set::MOST).enumerate() {
                let outcome = Outcome::of(letter);
                attempts.insert((place.to_owned(), index), Attempt { outcome, ..Attempt::default() });
            }
        }
        let sets = storage::kept(SETS).unwrap_or_default();
        let draft = storage::kept(DRAFT).unwrap_or_else(|| set::empty("My set"));
        Self {
            attempts: RwSignal::new(attempts),
            sets: RwSignal::new(sets.split(BETWEEN).filter(|text| !text.is_empty()).map(Arc::from).collect()),
            refused: RwSignal::new(None),
            draft: RwSignal::new(draft),
            codes: RwSignal::new(String::new()),
            own: RwSignal::new(String::new()),
            moved: StoredValue::new(false),
            made: StoredValue::new(None),
            toasts: expect_context(),
        }
    }

    /// The tasks of a source; `None` where a link's are damaged, or where its set was not opened here.
    pub fn series(self, source: &Source) -> Option<Shared> {
        let made = self.made.with_value(|made| made.clone().filter(|made| made.source == *source));
        if made.is_some() {
            return made;
        }
        let series = match source {
            Source::Round(round) => Some(Series::of_round(*round)),
            Source::Set(seed) => self.text(*seed).map(|text| Series::of_set(&text)),
            Source::Own(place) => Series::of_own(place),
        };
        let series = series.map(Arc::new);
        self.made.set_value(series.clone());
        series
    }

    /// The text of a set that was opened, for links; empty for all else.
    pub fn text_of(self, place: &str) -> String {
        let Ok(Where::In(Source::Set(seed), _)) = Where::of(place) else { return String::new() };
        untrack(|| self.text(seed)).map_or(String::new(), |text| text.to_string())
    }

    /// The text of the set with this seed, where it was opened here.
    pub fn text(self, seed: Seed) -> Option<Arc<str>> {
        self.sets.with(|sets| sets.iter().find(|text| set::seed(text) == seed).cloned())
    }

    pub fn say(self, text: impl Into<String>) {
        self.toasts.say(text);
    }

    /// Opens the set of a link to `place`, and says where that is.
    pub fn follow(self, place: &str, text: &str) -> String {
        let Ok(Where::In(Source::Set(_), screen)) = Where::of(place) else { return place.to_owned() };
        let opened = self.open_text("The set of this link", text);
        opened.map_or(String::new(), |source| Where::In(source, screen).place())
    }

    /// Opens the text of a set, and says how its places begin; else what is wrong with it is shown.
    pub fn open_text(self, name: &str, text: &str) -> Option<Source> {
        let (_, mistakes) = set::read(text);
        if !mistakes.is_empty() {
            let said = format!("{name} is not opened as a set yet.");
            self.refused.set(Some(Refused { said, mistakes }));
            return None;
        }
        self.refused.set(None);
        let seed = set::seed(text);
        self.sets.update(|sets| {
            sets.retain(|other| set::seed(other) != seed);
            sets.insert(0, text.replace(BETWEEN, "").into());
            sets.truncate(KEPT_SETS);
        });
        self.keep_sets();
        Some(Source::Set(seed))
    }

    /// Removes a set that was opened.
    pub fn remove(self, text: &Arc<str>) {
        let before = self.sets.get_untracked();
        self.sets.update(|sets| sets.retain(|other| other != text));
        self.keep_sets();
        let title = set::read(text).0.title;
        self.toasts.offer(format!("“{title}” is removed."), "Undo", move || {
            self.sets.set(before.clone());
            self.keep_sets();
        });
    }

    /// A full or forbidden store only means that they are gone at the next visit: whoever prepared one has the file.
    fn keep_sets(self) {
        let text = self.sets.with_untracked(|sets| sets.join(&BETWEEN.to_string()));
        let _ = storage::keep(SETS, &text);
    }

    /// Changes the set that is being prepared.
    pub fn prepare(self, text: String) {
        let _ = storage::keep(DRAFT, &text);
        self.draft.set(text);
    }

    pub fn attempt(self, key: &Key) -> Attempt {
        self.attempts.with(|all| all.get(key).cloned().unwrap_or_default())
    }

    /// What came of each task.
    pub fn outcomes(self, series: &Series) -> Vec<Outcome> {
        let place = series.source.place();
        self.attempts.with(|all| {
            let outcome = |index| all.get(&(place.clone(), index)).map(|attempt| attempt.outcome);
            (0..series.tasks.len()).map(|index| outcome(index).unwrap_or_default()).collect()
        })
    }

    /// How many tasks of these sources were answered so far.
    pub fn answered(self, of: impl Fn(&Source) -> bool) -> usize {
        self.attempts.with(|all| {
            let done = all.iter().filter(|(_, attempt)| attempt.outcome != Outcome::Open);
            done.filter(|((place, _), _)| Source::of(place).is_ok_and(|(source, _)| of(&source))).count()
        })
    }

    pub fn change(self, key: &Key, change: impl FnOnce(&mut Attempt)) {
        self.attempts.update(|all| change(all.entry(key.clone()).or_default()));
        self.keep();
    }

    /// Begins anew.
    pub fn forget(self, source: &Source) {
        let place = source.place();
        self.attempts.update(|all| all.retain(|(other, _), _| *other != place));
        self.keep();
    }

    /// Keeps what came of them for the next visit. A full or forbidden store only means that it is gone then.
    fn keep(self) {
        let text = self.attempts.with_untracked(|all| {
            let mut lines: HashMap<&str, String> = HashMap::new();
            for ((place, index), attempt) in all {
                // Tasks by themselves are not kept: there may be any number of them.
                if attempt.outcome == Outcome::Open || place.starts_with("own.") {
                    continue;
                }
                let letters = lines.entry(place).or_default();
                while letters.len() <= *index {
                    letters.push(Outcome::Open.letter());
                }
                letters.replace_range(*index..=*index, &attempt.outcome.letter().to_string());
            }
            let line = |(place, letters): (&str, String)| format!("{place} {letters}");
            lines.into_iter().take(KEPT).map(line).collect::<Vec<_>>().join("\n")
        });
        let _ = storage::keep(KEY, &text);
    }
}

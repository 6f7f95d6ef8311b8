//! The lessons that there are, what somebody has done of them, and what was typed.

use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use web_sys::File;

use crate::address::{View, href};
use crate::browser::{file, storage};
use crate::components::toast::Toasts;
use crate::views::learn::attempt::Attempt;
use crate::views::learn::mistakes::Refused;
use buslens::field::in_order;
use buslens::tool::link::Link;
use buslens_trainer::Answer;
use buslens_trainer::lesson::{LESSONS, Lesson, Progress, Step, read};

/// A lesson with its text, which can be saved, changed and opened again.
#[derive(Clone)]
pub struct Course {
    pub lesson: Arc<Lesson>,
    pub text: Arc<str>,
    /// It was opened from a file.
    pub own: bool,
}

/// Where in the lessons somebody is.
#[derive(Clone)]
pub struct Here {
    pub course: Course,
    /// From 0.
    pub step: usize,
}

#[derive(Clone, Copy)]
pub struct LessonsState {
    courses: RwSignal<Vec<Course>>,
    pub progress: RwSignal<Progress>,
    /// By the places of their steps.
    attempts: RwSignal<Vec<(String, Attempt)>>,
    pub refused: RwSignal<Option<Refused>>,
    pub not_kept: RwSignal<Option<storage::NotKept>>,
    toasts: Toasts,
}

/// Where things are kept in the browser.
const PROGRESS: &str = "lessons";
const OWN: &str = "own-lessons";

/// Stands between the texts of several lessons.
const BETWEEN: char = '\u{1E}';

/// A lesson has some thousand characters.
const LONGEST_FILE: u32 = 300_000;

impl LessonsState {
    /// For the app, by whose context it says things.
    pub fn new() -> Self {
        let own = storage::kept(OWN).unwrap_or_default();
        let state = Self {
            courses: RwSignal::new(courses(own.split(BETWEEN).filter(|text| !text.is_empty()))),
            progress: RwSignal::new(kept(&storage::kept(PROGRESS).unwrap_or_default())),
            attempts: RwSignal::new(Vec::new()),
            refused: RwSignal::new(None),
            not_kept: RwSignal::new(None),
            toasts: expect_context(),
        };
        // What is done in another tab is done here, too.
        storage::on_change(PROGRESS, move |text| {
            state.progress.update(|progress| progress.join(&kept(&text.unwrap_or_default())));
        });
        state
    }

    pub fn courses(self) -> Vec<Course> {
        self.courses.get()
    }

    /// Where a place in a link leads: `crc.3` is the third step of the lesson crc.
    pub fn find(self, place: &str) -> Option<Here> {
        let (key, step) = place.split_once('.').unwrap_or((place, "1"));
        let course = self.courses.with(|all| all.iter().find(|it| it.lesson.key == key).cloned())?;
        let step = step.parse::<usize>().unwrap_or(1).clamp(1, course.lesson.steps.len()) - 1;
        Some(Here { course, step })
    }

    /// How many of the steps of a lesson are done.
    pub fn count(self, lesson: &Lesson) -> usize {
        self.progress.with(|progress| progress.count(&lesson.key, lesson.steps.len()))
    }

    pub fn is_done(self, lesson: &Lesson, step: usize) -> bool {
        self.progress.with(|progress| progress.holds(&lesson.key, step + 1))
    }

    /// The step to go on with: the first of a lesson that is not done, or its first one.
    pub fn next(self, lesson: &Lesson) -> usize {
        (0..lesson.steps.len()).find(|step| !self.is_done(lesson, *step)).unwrap_or(0)
    }

    pub fn attempt(self, place: &str) -> Attempt {
        let own =
            |all: &Vec<(String, Attempt)>| all.iter().find(|(of, _)| of == place).map(|(_, it)| it.clone());
        self.attempts.with(own).unwrap_or_default()
    }

    pub fn change(self, place: &str, change: impl FnOnce(&mut Attempt)) {
        self.attempts.update(|all| {
            let at = all.iter().position(|(of, _)| of == place).unwrap_or(all.len());
            if at == all.len() {
                all.push((place.to_owned(), Attempt::default()));
            }
            change(&mut all[at].1);
        });
    }

    /// Grades what was answered. A right answer finishes the step.
    pub fn grade(self, here: &Here, answer: Answer) {
        let Some(step) = here.step() else { return };
        let Some(exercise) = &step.exercise else { return };
        let verdict = exercise.grade(step, &answer);
        if verdict.is_right() {
            self.progress.update(|progress| progress.finish(&here.course.lesson.key, here.step + 1));
            self.keep();
        }
        self.change(&here.place(), |attempt| {
            attempt.enter(answer);
            attempt.take(verdict);
        });
    }

    fn keep(self) {
        let kept = self.progress.with_untracked(|progress| storage::keep(PROGRESS, &progress.write()));
        self.not_kept.set(kept.err());
    }

    /// Begins anew.
    pub fn forget(self) {
        let before = self.progress.get_untracked();
        let attempts = self.attempts.get_untracked();
        self.progress.set(Progress::default());
        self.attempts.update(Vec::clear);
        self.keep();
        self.toasts.offer("All lessons are as if you had not begun.", "Undo", move || {
            self.progress.set(before.clone());
            self.attempts.set(attempts.clone());
            self.keep();
        });
    }

    /// Opens a file: a lesson of one's own, or progress that was saved.
    pub fn open(self, opened: File) {
        spawn_local(async move {
            let name = opened.name();
            match file::text(&opened, LONGEST_FILE).await {
                Err(why) => self.toasts.say(format!("{} Nothing is changed.", why.sentence())),
                Ok(text) => match Progress::read(&text) {
                    Some(progress) => {
                        self.progress.update(|own| own.join(&progress));
                        self.keep();
                        self.toasts.say(format!("{name} is opened: what is done in it is done here, too."));
                    }
                    None => self.open_lesson(name, &text),
                },
            }
        });
    }

    fn open_lesson(self, name: String, text: &str) {
        let (lesson, mut mistakes) = read(text);
        mistakes.extend(lesson.mistakes());
        let mistakes = in_order(mistakes, |mistake| mistake.line);
        if !mistakes.is_empty() {
            let said = format!("{name} is not opened as a lesson yet.");
            self.refused.set(Some(Refused { said, mistakes }));
            return;
        }
        self.refused.set(None);
        let mut own = self.own();
        own.retain(|other| read(other).0.key != lesson.key);
        own.push(text.replace(BETWEEN, ""));
        self.take_own(&own);
        self.toasts.say(format!("“{}” is opened. It stays here until you remove it.", lesson.title));
    }

    /// Removes a lesson that was opened.
    pub fn remove(self, course: &Course) {
        let before = self.own();
        let left: Vec<String> = before.iter().filter(|text| **text != *course.text).cloned().collect();
        self.take_own(&left);
        self.toasts.offer(format!("“{}” is removed.", course.lesson.title), "Undo", move || {
            self.take_own(&before)
        });
    }

    fn own(self) -> Vec<String> {
        self.courses
            .with_untracked(|all| all.iter().filter(|it| it.own).map(|it| it.text.to_string()).collect())
    }

    fn take_own(self, own: &[String]) {
        self.courses.set(courses(own.iter().map(String::as_str)));
        self.not_kept.set(storage::keep(OWN, &own.join(&BETWEEN.to_string())).err());
    }
}

impl Here {
    pub fn step(&self) -> Option<&Step> {
        self.course.lesson.steps.get(self.step)
    }

    /// How a link names it.
    pub fn place(&self) -> String {
        format!("{}.{}", self.course.lesson.key, self.step + 1)
    }
}

/// The address of a step.
pub fn link_to(lesson: &Lesson, step: usize) -> String {
    let place = format!("lessons.{}.{}", lesson.key, step + 1);
    href(View::Learn, &Link { place, ..Link::default() })
}

fn kept(text: &str) -> Progress {
    Progress::read(text).unwrap_or_default()
}

/// All lessons. One of a person's own with the key of another takes its place: a translation, or a better one.
fn courses<'a>(own: impl Iterator<Item = &'a str>) -> Vec<Course> {
    let course = |text: &str, own| Course { lesson: Arc::new(read(text).0), text: text.into(), own };
    let mut all: Vec<Course> = LESSONS.iter().map(|text| course(text, false)).collect();
    for own in own.map(|text| course(text, true)).filter(|own| !own.lesson.steps.is_empty()) {
        match all.iter_mut().find(|it| it.lesson.key == own.lesson.key) {
            Some(other) => *other = own,
            None => all.push(own),
        }
    }
    all
}

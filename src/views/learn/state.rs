//! Where in Learn somebody is, as links know it.

use leptos::prelude::*;

use super::lessons::LessonsState;
use super::practice::PracticeState;
use crate::address::Address;
use buslens::tool::link::Link;

/// A part of Learn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Lessons,
    Practice,
    Gallery,
    Reference,
}

impl Part {
    pub const ALL: [Self; 4] = [Self::Lessons, Self::Practice, Self::Gallery, Self::Reference];

    /// What it is called in links.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Lessons => "lessons",
            Self::Practice => "practice",
            Self::Gallery => "telegrams",
            Self::Reference => "reference",
        }
    }

    pub const fn label(self) -> &'static str {
        match self {
            Self::Lessons => "Lessons",
            Self::Practice => "Practice",
            Self::Gallery => "Telegrams",
            Self::Reference => "Reference",
        }
    }
}

/// Where somebody is in each part; it outlasts every switch of parts and views.
#[derive(Clone, Copy)]
pub struct LearnState {
    address: Address,
    part: RwSignal<Part>,
    /// The place in each part, in the order of [`Part::ALL`]: words with points between them.
    places: [RwSignal<String>; 4],
    pub practice: PracticeState,
    pub lessons: LessonsState,
}

impl LearnState {
    /// For the app, by whose context it finds the address.
    pub fn new() -> Self {
        Self {
            address: expect_context(),
            part: RwSignal::new(Part::Lessons),
            places: std::array::from_fn(|_| RwSignal::new(String::new())),
            practice: PracticeState::new(),
            lessons: LessonsState::new(),
        }
    }

    pub fn part(self) -> Part {
        self.part.get()
    }

    /// Somebody chose another part.
    pub fn turn_to(self, part: Part) {
        self.part.set(part);
        self.address.chosen();
    }

    /// The place in `part`: words with points between them, as they stand in a link; empty at first.
    pub fn place(self, part: Part) -> String {
        self.places[part as usize].get()
    }

    /// Somebody went elsewhere in `part`; "back" leads back.
    pub fn go_to(self, part: Part, place: String) {
        self.places[part as usize].set(place);
        self.address.chosen();
    }

    /// Somebody types there: the address follows at the next pause.
    pub fn type_to(self, part: Part, place: String) {
        self.places[part as usize].set(place);
        self.address.typed();
    }

    pub fn link(&self) -> Link {
        let part = self.part.get_untracked();
        let place = self.places[part as usize].get_untracked();
        let place = match (part, place.as_str()) {
            (Part::Lessons, "") => String::new(),
            (_, "") => part.key().to_owned(),
            _ => format!("{}.{place}", part.key()),
        };
        // A set travels in its links.
        let text = match part {
            Part::Practice => self.practice.text_of(&self.places[part as usize].get_untracked()),
            _ => String::new(),
        };
        Link { place, text, ..Link::default() }
    }

    /// Shows what a link says.
    pub fn follow(&self, link: Link) {
        let (key, place) = link.place.split_once('.').unwrap_or((&link.place, ""));
        let part = Part::ALL.into_iter().find(|part| part.key() == key).unwrap_or(Part::Lessons);
        let mut place = place.to_owned();
        if part == Part::Practice && !link.text.is_empty() {
            place = self.practice.follow(&place, &link.text);
        }
        self.part.set(part);
        self.places[part as usize].set(place);
    }
}

//! A check while it is followed step by step. As in `state`, what is shown follows from the signals
//! here, and only the methods here change them.

use leptos::prelude::*;

use super::address::{self, Shows};
use super::browser;
use buslens::tool::link::Link;
use buslens::tool::steps::{Algorithm, CHECKS, Deed, Step, bytes, steps};

/// The page's state, as handed to every part of it.
#[derive(Clone, Copy)]
pub struct Stepping {
    pub followed: RwSignal<Followed>,
}

/// What is followed, and how far.
pub struct Followed {
    pub text: String,
    pub check: &'static Algorithm,
    pub bytes: Vec<u8>,
    pub steps: Vec<Step>,
    /// The index of the step that is shown.
    pub at: usize,
}

impl Followed {
    fn new(text: String, check: &'static Algorithm, at: usize) -> Self {
        let bytes = bytes(&text);
        let steps = steps(check, &bytes);
        Self { at: at.min(steps.len() - 1), text, check, bytes, steps }
    }

    pub fn step(&self) -> Step {
        self.steps[self.at]
    }

    pub fn last(&self) -> usize {
        self.steps.len() - 1
    }

    /// The index of the step behind which the byte `index` is done with.
    pub fn done_with(&self, index: usize) -> usize {
        self.steps.iter().rposition(|step| step.byte == index && step.deed != Deed::Complement).unwrap_or(0)
    }
}

/// What is followed where nothing else is asked for: section 2.3.1 of the Memograph's manual.
const EXAMPLE: &str = "01 03 00 C8 00 03";

/// The name of the check in a link.
const CHECK: &str = "check";

impl Stepping {
    pub fn new() -> Self {
        Self { followed: RwSignal::new(Followed::new(String::new(), CHECKS[0], 0)) }
    }

    /// Other bytes, or another check: from the start.
    pub fn follow_other(&self, text: String, check: &'static Algorithm) {
        self.followed.set(Followed::new(text, check, 0));
        self.slide();
        address::renew(address::Step::Typed);
    }

    /// Goes to the step `at`, or to the last one.
    pub fn go(&self, at: usize) {
        self.followed.update(|followed| followed.at = at.min(followed.last()));
        self.slide();
        address::renew(address::Step::Typed);
    }

    /// Moves the slider to the step that is shown.
    fn slide(&self) {
        self.followed.with_untracked(|followed| browser::set_range(AT, followed.at, followed.last()));
    }
}

/// The ids of the bytes, of the list of checks, and of the slider.
pub const BYTES: &str = "bytes";
pub const KIND: &str = "kind";
pub const AT: &str = "at";

impl Shows for Stepping {
    fn key(&self) -> &'static str {
        "check"
    }

    fn link(&self) -> Link {
        self.followed.with_untracked(|Followed { text, check, at, .. }| Link {
            text: text.clone(),
            telegram: *at,
            entries: vec![(CHECK.to_owned(), check.kind.to_owned())],
            ..Link::default()
        })
    }

    fn follow(&self, link: Link) {
        let asked = link.entries.iter().find(|(path, _)| path == CHECK);
        let check = CHECKS.iter().find(|check| asked.is_some_and(|(_, kind)| check.kind == kind));
        let text = if link.text.is_empty() && asked.is_none() { EXAMPLE.to_owned() } else { link.text };
        browser::set_field(BYTES, &text);
        let check = check.copied().unwrap_or(CHECKS[0]);
        browser::set_field(KIND, check.kind);
        self.followed.set(Followed::new(text, check, link.telegram));
        self.slide();
    }
}

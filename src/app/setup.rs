//! How the user's devices are set up. As in `state`, what is shown follows from the signals here, and
//! only the methods here change them.

use leptos::prelude::*;

use super::address::SETTINGS;
use super::browser;
use super::components::form;
use buslens::tool::link::{keep_settings, kept_settings};
use buslens::tool::{Change, Entries, Settings, settings};

/// The page's state, as handed to every part of it.
#[derive(Clone, Copy)]
pub struct Setup {
    kept: RwSignal<Kept, LocalStorage>,
    /// Counts on whenever the form has other entries than before.
    pub shape: RwSignal<usize>,
}

/// The settings and their form.
pub struct Kept {
    pub settings: Settings,
    pub entries: Entries,
}

impl From<Settings> for Kept {
    fn from(mut settings: Settings) -> Self {
        Self { entries: settings::entries(&mut settings), settings }
    }
}

impl Setup {
    /// The settings as they were kept.
    pub fn new() -> Self {
        let kept = kept_settings(&browser::remembered(SETTINGS).unwrap_or_default());
        Self { kept: RwSignal::new_local(kept.into()), shape: RwSignal::new(0) }
    }

    /// Looks at the settings, and is called again when they are others.
    pub fn with<T>(&self, look: impl FnOnce(&Kept) -> T) -> T {
        self.kept.with(look)
    }

    /// Looks at the settings as they are now.
    pub fn now<T>(&self, look: impl FnOnce(&Kept) -> T) -> T {
        self.kept.with_untracked(look)
    }

    /// Changes the entry at `path`.
    pub fn edit(&self, path: &str, change: Change) {
        let mut other = false;
        self.kept.update(|Kept { settings, entries }| {
            let before = form::shape(entries);
            entries.edit(settings, path, change);
            other = form::outgrown(&before, entries);
        });
        if other {
            self.reshape();
        }
        self.keep();
    }

    /// Puts other settings in the place of these.
    pub fn replace(&self, settings: Settings) {
        self.kept.set(settings.into());
        self.reshape();
        self.keep();
    }

    fn reshape(&self) {
        self.shape.update(|shape| *shape += 1);
    }

    fn keep(&self) {
        browser::remember(SETTINGS, &self.now(|kept| keep_settings(&kept.settings)));
    }
}

//! A form while somebody fills it in.

use std::collections::HashMap;

use crate::field::{Argument, Message, number_text};
use crate::message;
use crate::walk::form::{self, Content, Entry, Form, Misfit, Unfit};
use crate::walk::{self, Deviations, Overflow, Telegram};

/// The entries of something that can be walked. What is typed is kept as it was typed; what does not fit
/// leaves the thing itself as it was, and is listed in [`misfits`](Self::misfits).
#[derive(Clone, Debug)]
pub struct Entries {
    pub form: Form,
    pub deviations: Deviations,
    pub misfits: Vec<Misfit>,
}

/// What a person does with an entry.
#[derive(Clone, Copy, Debug)]
pub enum Change<'a> {
    /// Types a number, text or bytes; what to write instead of a computed number, or nothing for what is
    /// computed; the number of a choice; how many items a list is to have.
    Enter(&'a str),
    /// Sets some bits of a number: part `part` of its spec.
    Bits { part: usize, value: u64 },
    /// Adds an item to the end of a list.
    Add,
    /// Takes an item from a list.
    Remove(usize),
    /// Takes the last one.
    RemoveLast,
}

impl Change<'_> {
    fn make(self, entry: &mut Entry) {
        match (self, &mut entry.content) {
            (
                Self::Enter(typed),
                Content::Number { text, .. }
                | Content::Computed { text, .. }
                | Content::Bytes { text }
                | Content::Text { text }
                | Content::Extra { text }
                | Content::Cut { text },
            ) => typed.clone_into(text),
            (Self::Enter(typed), Content::Choice { raw, .. }) => {
                *raw = form::parse_number(typed, 8).unwrap_or(*raw);
            }
            (Self::Enter(typed), Content::List { items }) => {
                if let Ok(wanted @ 0..=MOST_ITEMS) = form::parse_number(typed, 2) {
                    items.resize_with(wanted as usize, Vec::new);
                }
            }
            (Self::Bits { part, value }, Content::Number { width, text }) => {
                if let Some(part) = entry.spec.bits.get(part) {
                    // What does not fit is no number to set bits of.
                    let raw = form::parse_value(text, *width, entry.spec).unwrap_or(0);
                    *text = number_text(part.put(raw, value), *width, entry.spec.format);
                }
            }
            (Self::Add, Content::List { items }) if (items.len() as u64) < MOST_ITEMS => {
                items.push(Vec::new())
            }
            (Self::Remove(index), Content::List { items }) if index < items.len() => {
                items.remove(index);
            }
            (Self::RemoveLast, Content::List { items }) => _ = items.pop(),
            _ => {}
        }
    }
}

impl Entries {
    pub fn of(telegram: &mut dyn Telegram, deviations: Deviations) -> Self {
        Self { form: form::form(telegram, &deviations), deviations, misfits: Vec::new() }
    }

    /// Changes the entry at `path`, if it is one of such a kind. A list takes no more items than what
    /// counts them can say.
    pub fn edit(&mut self, telegram: &mut dyn Telegram, path: &str, change: Change) {
        let Some(entry) = find(&mut self.form.entries, path) else { return };
        if !matches!(entry.content, Content::List { .. }) {
            change.make(entry);
            return self.renew(telegram);
        }
        let before = entry.clone();
        change.make(entry);
        self.renew(telegram);
        if walk::overflow(telegram, &self.deviations).is_some()
            && let Some(entry) = find(&mut self.form.entries, path)
        {
            *entry = before;
            self.renew(telegram);
        }
    }

    /// Takes the form's own entries, after they were changed.
    fn renew(&mut self, telegram: &mut dyn Telegram) {
        let typed = std::mem::replace(&mut self.form, Form { entries: Vec::new() });
        self.take(telegram, &typed);
    }

    /// Takes the entries of `typed` that the telegram has.
    pub fn take(&mut self, telegram: &mut dyn Telegram, typed: &Form) {
        match form::fill(telegram, typed) {
            Ok(deviations) => {
                self.deviations = deviations;
                self.misfits.clear();
            }
            Err(Unfit { misfits, mut deviations }) => {
                // What does not fit leaves its field as it was.
                for Misfit { path, .. } in &misfits {
                    if let Some(before) = self.deviations.get(path) {
                        deviations.set(path.clone(), before.clone());
                    }
                }
                (self.deviations, self.misfits) = (deviations, misfits);
            }
        }
        if let Some(overflow) = walk::overflow(telegram, &self.deviations) {
            self.misfits.push(Misfit { message: too_large(&overflow), path: overflow.path });
        }
        let mut fresh = form::form(telegram, &self.deviations);
        keep_typed(&mut fresh.entries, &typed.entries);
        self.form = fresh;
    }

    /// Types again what did not fit in `typed`, where there still is such an entry: nothing that was typed
    /// gets lost when something else changes the telegram.
    pub fn keep_misfits(&mut self, telegram: &mut dyn Telegram, typed: &Self) {
        let texts = texts(&typed.form);
        for misfit in &typed.misfits {
            if let Some((path, text)) = texts.iter().find(|(path, _)| *path == misfit.path) {
                self.edit(telegram, path, Change::Enter(text));
            }
        }
    }

    /// Every entry that is not as in `default`, as path and text, in an order in which
    /// [`enter_all`](Self::enter_all) takes them.
    pub fn changed(&self, default: &Self) -> Vec<(String, String)> {
        let before: HashMap<String, String> = texts(&default.form).into_iter().collect();
        let mut changed = texts(&self.form);
        changed.retain(|(path, text)| before.get(path) != Some(text));
        changed
    }

    /// What [`enter_all`](Self::enter_all) has to type into the entries `fresh` for these ones: of an
    /// entry that does not fit first what it held before.
    pub fn typed(&self, telegram: &mut dyn Telegram, fresh: &Self) -> Vec<(String, String)> {
        let held: HashMap<String, String> = match self.misfits.is_empty() {
            true => HashMap::new(),
            false => texts(&form::form(telegram, &self.deviations)).into_iter().collect(),
        };
        let before = |path: &str| {
            let misfit = self.misfits.iter().any(|misfit| misfit.path == path);
            held.get(path).filter(|_| misfit).map(|text| (path.to_owned(), text.clone()))
        };
        let changed = self.changed(fresh).into_iter();
        changed.flat_map(|(path, text)| before(&path).into_iter().chain([(path, text)])).collect()
    }

    /// Types all of `texts`, paths and what is typed there, and returns why some cannot be. It takes a
    /// few walks for all of them, not one for each; of what is typed into one entry only the last two
    /// texts count, the last of which may not fit.
    pub fn enter_all(&mut self, telegram: &mut dyn Telegram, texts: &[(&str, &str)]) -> Vec<Message> {
        let mut refused = Vec::new();
        let mut last: HashMap<&str, [Option<usize>; 2]> = HashMap::new();
        for ((path, _), at) in texts.iter().zip(0..) {
            let places = last.entry(path).or_default();
            *places = [places[1], Some(at)];
        }
        for round in [0, 1] {
            let counts = |(at, (path, _)): &(usize, &(&str, &str))| last[path][round] == Some(*at);
            let texts: Vec<(&str, &str)> = (0..).zip(texts).filter(counts).map(|(_, typed)| *typed).collect();
            if !texts.is_empty() {
                refused.extend(self.enter_each(telegram, &texts));
            }
        }
        refused
    }

    /// Types all of `texts`, each into another entry.
    fn enter_each(&mut self, telegram: &mut dyn Telegram, texts: &[(&str, &str)]) -> Vec<Message> {
        let mut refused = Vec::new();
        let (mut typed, mut changed) = (Vec::new(), false);
        for (path, text) in texts {
            if changed && self.entry(path).is_none() {
                // What was typed before may have made it.
                self.renew(telegram);
                changed = false;
            }
            match self.entry(path) {
                None => refused.push(message!("there is no entry “{path}”", path = (*path).to_owned())),
                Some(Entry { content: Content::List { .. } | Content::Choice { .. }, .. }) => {
                    // These make other entries, by all that was typed before.
                    refused.extend(self.enter_list(telegram, path, text));
                }
                Some(entry) => {
                    Change::Enter(text).make(entry);
                    changed = true;
                    typed.push((*path, *text));
                }
            }
        }
        self.renew(telegram);
        // What one entry says can make another kind of entry of one behind it.
        for (path, text) in typed {
            let kept = self.entry(path).is_some_and(|entry| entry.text().is_none_or(|it| it == text));
            if !kept {
                self.edit(telegram, path, Change::Enter(text));
            }
        }
        refused
    }

    /// Types how many items a list is to have, or which choice is made.
    fn enter_list(&mut self, telegram: &mut dyn Telegram, path: &str, text: &str) -> Option<Message> {
        self.edit(telegram, path, Change::Enter(text));
        let Content::List { items } = &self.entry(path)?.content else { return None };
        match form::parse_number(text, 2) {
            Ok(wanted) if wanted == items.len() as u64 => None,
            Ok(wanted) => Some(message!(
                "{path}: {items} items are too many: the list cannot have so many",
                path = path.to_owned(),
                items = wanted
            )),
            Err(message) => Some(message!("{path}: {message}", path = path.to_owned(), message = message)),
        }
    }

    fn entry(&mut self, path: &str) -> Option<&mut Entry> {
        find(&mut self.form.entries, path)
    }
}

/// What there is to say of a computed number that its bytes cannot hold.
fn too_large(overflow: &Overflow) -> Message {
    message!(
        "{label} would be {number}; it can say {widest} at most",
        label = Argument::Term(overflow.spec.label),
        number = overflow.number,
        widest = overflow.widest
    )
}

/// No telegram has more items: a PDU of coils has 246 bytes.
const MOST_ITEMS: u64 = 256;

/// Every entry with a text of its own, a list before its items.
fn texts(form: &Form) -> Vec<(String, String)> {
    let mut texts = Vec::new();
    form.visit(&mut |entry| {
        let text = match &entry.content {
            Content::Choice { raw, .. } => raw.to_string(),
            Content::List { items } => items.len().to_string(),
            _ => match entry.text() {
                Some(text) => text.to_owned(),
                None => return,
            },
        };
        texts.push((entry.path.clone(), text));
    });
    texts
}

/// The entry at `path`: each entry's path begins with that of the list or group it is in.
fn find<'a>(entries: &'a mut [Entry], path: &str) -> Option<&'a mut Entry> {
    for entry in entries {
        if entry.path == path {
            return Some(entry);
        }
        let within = path.strip_prefix(entry.path.as_str()).and_then(|within| within.strip_prefix('.'));
        let found = match (within, &mut entry.content) {
            (Some(within), Content::List { items }) => {
                let index: Option<usize> = within.split('.').next().and_then(|index| index.parse().ok());
                index.and_then(|index| items.get_mut(index)).and_then(|item| find(item, path))
            }
            (Some(_), Content::Group { entries }) => find(entries, path),
            _ => None,
        };
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Puts what was typed into the entries of `fresh` that were there before.
fn keep_typed(fresh: &mut [Entry], typed: &[Entry]) {
    for entry in fresh {
        let same = |before: &&Entry| std::ptr::eq(before.spec, entry.spec) && before.key() == entry.key();
        let Some(before) = typed.iter().find(same) else {
            continue;
        };
        match (&mut entry.content, &before.content) {
            (Content::Number { text, .. }, Content::Number { text: typed, .. })
            | (Content::Computed { text, .. }, Content::Computed { text: typed, .. })
            | (Content::Bytes { text }, Content::Bytes { text: typed })
            | (Content::Text { text }, Content::Text { text: typed })
            | (Content::Extra { text }, Content::Extra { text: typed })
            | (Content::Cut { text }, Content::Cut { text: typed }) => typed.clone_into(text),
            (Content::List { items }, Content::List { items: typed }) => {
                items.iter_mut().zip(typed).for_each(|(item, typed)| keep_typed(item, typed));
            }
            (Content::Group { entries }, Content::Group { entries: typed }) => keep_typed(entries, typed),
            _ => {}
        }
    }
}

//! A form while somebody fills it in.

use crate::field::{Message, number_text};
use crate::message;
use crate::walk::form::{self, Content, Entry, Form, Misfit};
use crate::walk::{Deviations, Telegram};

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
                items.resize_with(length(typed).unwrap_or(items.len()), Vec::new);
            }
            (Self::Bits { part, value }, Content::Number { width, text }) => {
                if let Some(part) = entry.spec.bits.get(part) {
                    // What does not fit is no number to set bits of.
                    let raw = form::parse_value(text, *width, entry.spec).unwrap_or(0);
                    *text = number_text(part.put(raw, value), *width, entry.spec.format);
                }
            }
            (Self::Add, Content::List { items }) if items.len() < MOST_ITEMS => items.push(Vec::new()),
            (Self::Remove(index), Content::List { items }) if index < items.len() => {
                items.remove(index);
            }
            _ => {}
        }
    }
}

impl Entries {
    pub fn of(telegram: &mut dyn Telegram, deviations: Deviations) -> Self {
        Self { form: form::form(telegram, &deviations), deviations, misfits: Vec::new() }
    }

    /// Changes the entry at `path`, if it is one of such a kind.
    pub fn edit(&mut self, telegram: &mut dyn Telegram, path: &str, change: Change) {
        let Some(entry) = find(&mut self.form.entries, path) else { return };
        change.make(entry);
        let typed = self.form.clone();
        self.take(telegram, &typed);
    }

    /// Takes the entries of `typed` that the telegram has.
    pub fn take(&mut self, telegram: &mut dyn Telegram, typed: &Form) {
        match form::fill(telegram, typed) {
            Ok(deviations) => {
                self.deviations = deviations;
                self.misfits.clear();
            }
            Err(misfits) => self.misfits = misfits,
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
        let before = texts(&default.form);
        let mut changed = texts(&self.form);
        changed.retain(|(path, text)| {
            let default = before.iter().find(|(other, _)| other == path);
            default.is_none_or(|(_, other)| other != text)
        });
        changed
    }

    /// Types all of `texts`. The message names the first path that there is none of.
    pub fn enter_all<'a>(
        &mut self,
        telegram: &mut dyn Telegram,
        texts: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<(), Message> {
        for (path, text) in texts {
            match find(&mut self.form.entries, path).map(|entry| &entry.content) {
                None => return Err(message!("there is no entry “{path}”", path = path.to_owned())),
                Some(Content::List { .. }) => drop(length(text)?),
                Some(_) => {}
            }
            self.edit(telegram, path, Change::Enter(text));
        }
        Ok(())
    }
}

/// No telegram has more items: a PDU of coils has 246 bytes.
const MOST_ITEMS: usize = 256;

/// How many items a list is to have.
fn length(typed: &str) -> Result<usize, Message> {
    match form::parse_number(typed, 2)? as usize {
        items @ ..=MOST_ITEMS => Ok(items),
        items => Err(message!(
            "{items} items are too many: no list has more than {most}",
            items = items,
            most = MOST_ITEMS
        )),
    }
}

/// Every entry with a text of its own, a list before its items.
fn texts(form: &Form) -> Vec<(String, String)> {
    let mut texts = Vec::new();
    form.visit(&mut |entry| {
        let text = match &entry.content {
            Content::Number { text, .. }
            | Content::Computed { text, .. }
            | Content::Bytes { text }
            | Content::Text { text }
            | Content::Extra { text }
            | Content::Cut { text } => text.clone(),
            Content::Choice { raw, .. } => raw.to_string(),
            Content::List { items } => items.len().to_string(),
            Content::Group { .. } => return,
        };
        texts.push((entry.path.clone(), text));
    });
    texts
}

/// The entry at `path`.
fn find<'a>(entries: &'a mut [Entry], path: &str) -> Option<&'a mut Entry> {
    for entry in entries {
        if entry.path == path {
            return Some(entry);
        }
        let found = match &mut entry.content {
            Content::List { items } => items.iter_mut().find_map(|item| find(item, path)),
            Content::Group { entries } => find(entries, path),
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
        let Some(before) = typed.iter().find(|before| std::ptr::eq(before.spec, entry.spec)) else {
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

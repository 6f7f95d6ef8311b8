//! The words of somebody tried on a task of a device: what they fill in, and how well that fits.

use super::query::{Number, Query, STATES, Word, fold, in_words, meant, split};
use super::{ADDRESS, ALSO, BEGINNING, Fit, NAME, NOTE, VALUE, WORD};
use crate::device::{Access, Area, Content as Held, Parameter, Target, Task};
use crate::field::{Argument, Format, Message, Role, Spec, hex_value, number_text};
use crate::message;
use crate::walk::form::{self, Content, Entry, Form};
use crate::walk::{Deviations, Telegram};

impl Query {
    /// How well a task fits, and what the words fill in.
    pub fn fit_task(&self, task: &Task) -> Option<Fit> {
        if self.words.is_empty()
            || self.access.is_some_and(|access| access != task.access) && !self.names(task)
        {
            return None;
        }
        // Forms are made only where a word may mean something.
        if !self.words.iter().any(|word| may_mean(task, word)) {
            return None;
        }
        let mut best: Option<Fit> = None;
        for choice in choices(task) {
            let fit = Fitting::new(self, task, choice).fit();
            if let Some(fit) = fit
                && best.as_ref().is_none_or(|best| fit.score > best.score)
            {
                best = Some(fit);
            }
        }
        best
    }

    /// Whether the verb is a part of what the task is about: "set speed", "read mapping entry".
    fn names(&self, task: &Task) -> bool {
        let Some(verb) = self.words.iter().find(|word| word.verb) else { return false };
        let has = |label: &str| split(label).any(|word| word == verb.plain);
        has(spec_of(task).label)
            || choices(task)
                .iter()
                .flatten()
                .any(|(_, value, spec)| spec.name(*value).is_some_and(|name| has(name.label)))
    }
}

/// What a task is about.
fn spec_of(task: &Task) -> &'static Spec {
    match task.target {
        Target::Area(area) => &area.spec,
        Target::Parameter(parameter) => &parameter.spec,
    }
}

/// Whether a word can mean something of a task, as far as that is told without its form.
fn may_mean(task: &Task, word: &Word) -> bool {
    let spec = spec_of(task);
    let (also, id, whole) = match task.target {
        Target::Area(area) => {
            // Commands and parts have words of their own.
            let more = matches!(area.content, Held::Telegram { .. } | Held::Parts(_));
            (area.also, "", more || spec.format == crate::field::Format::Float)
        }
        Target::Parameter(parameter) => (parameter.also, parameter.id, false),
    };
    let plain = word.plain.as_str();
    let meant = meant(plain);
    let bits = spec.bits.iter().flat_map(|part| part.names.iter().map(|name| name.label).chain([part.label]));
    let names = spec.names.iter().map(|name| name.label).chain(bits);
    let noted =
        |text: &str| text.to_ascii_lowercase().contains(plain) || text.to_ascii_lowercase().contains(meant);
    word.number.is_some_and(|number| number.whole.is_some())
        || (whole && !word.stop)
        || in_words(&[spec.label, also, id], plain) > 0
        || numbered_names(also).any(|name| fold(name) == plain.trim_end_matches(|c: char| c.is_ascii_digit()))
        || (!word.stop && !plain.is_empty() && (names.into_iter().any(noted) || noted(spec.note)))
}

/// The forms of a task: one for each function that can be chosen, or the only one.
fn choices(task: &Task) -> Vec<Option<(String, u64, &'static Spec)>> {
    let form = form::form(&mut task.draft(), &Deviations::default());
    let mut found = Vec::new();
    form.visit(&mut |entry| {
        if let Content::Choice { .. } = entry.content {
            for name in entry.spec.names {
                found.push(Some((entry.path.clone(), name.value, entry.spec)));
            }
        }
    });
    if found.is_empty() { vec![None] } else { found }
}

/// A task while words are tried on it.
struct Fitting<'a> {
    query: &'a Query,
    task: &'a Task,
    /// The function that is tried, as path, value and spec.
    choice: Option<(String, u64, &'static Spec)>,
    form: Form,
    entries: Vec<(String, String)>,
    score: i32,
    reason: Message,
    /// Something besides the address was understood: a value, or which one.
    filled: bool,
    /// The values that were taken by their names.
    named: Vec<&'static str>,
}

impl<'a> Fitting<'a> {
    fn new(query: &'a Query, task: &'a Task, choice: Option<(String, u64, &'static Spec)>) -> Self {
        let mut draft = task.draft();
        let mut form = form::form(&mut draft, &Deviations::default());
        let mut entries = Vec::new();
        if let Some((path, value, _)) = &choice {
            choose(&mut form.entries, path, *value);
            let _ = form::fill(&mut draft as &mut dyn Telegram, &form);
            form = form::form(&mut draft, &Deviations::default());
            entries.push((path.clone(), value.to_string()));
        }
        let reason = Message::term("");
        Self { query, task, choice, form, entries, score: 0, reason, filled: false, named: Vec::new() }
    }

    fn fit(mut self) -> Option<Fit> {
        let words = &self.query.words;
        let mut values: Vec<usize> = Vec::new();
        let mut free = None;
        let mut before = Before::Start;
        for (index, word) in words.iter().enumerate() {
            let label = self.in_label(word);
            if label > 0 {
                self.score += label;
                before = Before::Label;
                continue;
            }
            if word.number.is_some() && self.take_address(word, before) {
                before = Before::Label;
                continue;
            }
            // "8E1" is a name before it is a number.
            let spelled = word.text.bytes().any(|byte| byte.is_ascii_alphabetic());
            if word.number.is_some() && spelled && self.in_names(word) {
                self.score += self.take_value_name(word).unwrap_or_default();
                before = Before::Value;
                continue;
            }
            if word.number.is_some() || word.text.contains(';') {
                if before == Before::Label && self.take_number(word) {
                    before = Before::Number;
                    continue;
                }
                // What follows a name at once says which one: less is said for a value.
                self.score -= if before == Before::Label { 10 } else { 0 };
                values.push(index);
                before = Before::Number;
                continue;
            }
            if word.stop {
                before = if word.verb { Before::Start } else { Before::Stop };
                continue;
            }
            if let Some(score) = self.take_value_name(word) {
                self.score += score;
                before = Before::Value;
                continue;
            }
            if self.text_entry().is_some() && self.task.access == Access::Write && self.score > 0 {
                free = Some(index);
                break;
            }
            if self.take_parameter(word) {
                before = Before::Value;
                continue;
            }
            let note = self.in_notes(word);
            if note == 0 {
                return None;
            }
            self.score += note;
            before = Before::Label;
        }
        // Nothing is meant by numbers and verbs alone.
        if self.score == 0 {
            return None;
        }
        for index in values {
            let word = &words[index];
            if !(self.take_value(word) || self.take_number(word) || self.is_read_with_all(word)) {
                return None;
            }
        }
        if let Some(index) = free {
            self.take_text(index)?;
        }
        self.finish()
    }

    /// What is left to decide once all words are understood.
    fn finish(mut self) -> Option<Fit> {
        let written = self.task.access == Access::Write;
        if self.filled && !written && self.query.access != Some(Access::Read) && self.has_value() {
            return None;
        }
        // "Set digital 4" means that it is on.
        if written && self.query.access == Some(Access::Write) && !self.has_value() {
            self.switch();
        }
        self.score += match (self.query.access, self.task.access, self.has_value()) {
            (Some(wanted), access, _) if wanted == access => 6,
            (None, Access::Write, true) => 6,
            (None, Access::Read, false) => 3,
            _ => 0,
        };
        // Of a task with functions, the one that was named; where none was, the one that takes the values.
        if let Some((_, value, spec)) = &self.choice {
            let label = spec.name(*value).map_or("", |name| name.label);
            let own = self.query.words.iter().filter(|word| word.verb || self.in_label(word) == 0);
            let named =
                own.map(|word| in_words(&[label], &word.plain) / if word.verb { 10 } else { 4 }).max();
            let named = named.unwrap_or_default();
            let needs = self.text_entry().is_some() && !self.has_value();
            self.score += named - if needs && named == 0 { 4 } else { 0 };
            let first = spec.names.first().is_some_and(|name| name.value == *value);
            if first && self.entries.len() == 1 && named == 0 {
                self.entries.clear();
            }
        }
        Some(Fit { score: self.score, entries: self.entries, reason: self.reason })
    }

    /// How much a word is of what the task is called.
    fn in_label(&self, word: &Word) -> i32 {
        if word.plain.is_empty()
            || (word.number.is_some() && word.plain.bytes().all(|it| it.is_ascii_digit()))
        {
            return 0;
        }
        let (label, also, id) = match self.task.target {
            Target::Area(Area { spec, also, .. }) => (spec.label, *also, ""),
            Target::Parameter(Parameter { spec, also, id, .. }) => (spec.label, *also, *id),
        };
        if !id.is_empty() && fold(id) == word.plain {
            return NAME;
        }
        let own = in_words(&[label], &word.plain);
        // A verb counts as a name only where it stands in the label as a whole word.
        if word.verb && own < WORD {
            return 0;
        }
        // What is written with capitals is a name, the rest are words.
        let names = split_names(also);
        let named =
            |name: &&str| fold(name) == word.plain && name.bytes().any(|byte| byte.is_ascii_uppercase());
        let more = if names.iter().any(named) { NAME } else { in_words(&names, &word.plain).min(ALSO) };
        own.max(more).max(self.numbered_name(word))
    }

    /// A name that ends with the number of a block: `MDB_Mapping_Rd_0`.
    fn numbered_name(&self, word: &Word) -> i32 {
        let Target::Area(Area { also, .. }) = self.task.target else { return 0 };
        let name = word.plain.trim_end_matches(|c: char| c.is_ascii_digit());
        let named = name != word.plain && numbered_names(also).any(|known| fold(known) == name);
        if named { NAME } else { 0 }
    }

    fn in_notes(&self, word: &Word) -> i32 {
        let spec = spec_of(self.task);
        let mut notes = vec![spec.note];
        let mut labels = Vec::new();
        self.form.visit(&mut |entry| {
            notes.push(entry.spec.note);
            labels.push(entry.spec.label);
        });
        if let Target::Area(area) = self.task.target {
            // What reading gives has words of its own.
            if let Held::Telegram { read: Some(new), .. } = area.content
                && self.task.access == Access::Read
            {
                let read =
                    form::form(new(&crate::device::Settings::default()).as_mut(), &Deviations::default());
                read.visit(&mut |entry| labels.push(entry.spec.label));
            }
            if let Held::Parts(parts) = area.content {
                labels.extend(parts.iter().map(|part| part.spec.label));
                let floats = parts.iter().filter(|part| part.spec.format == crate::field::Format::Float);
                labels.extend(
                    floats.map(
                        |part| {
                            if part.registers == 4 { "double float 64 bit" } else { "float 32 bit" }
                        },
                    ),
                );
            } else if area.spec.format == crate::field::Format::Float {
                labels.push(if area.stride == 4 { "double float 64 bit" } else { "float 32 bit" });
            }
        }
        let said = in_words(&labels, &word.plain);
        if said > 0 {
            return said.min(ALSO);
        }
        let meant = meant(&word.plain);
        let noted = notes.iter().any(|note| split(note).any(|own| own == word.plain || own == meant));
        if noted && word.plain.len() > 2 { NOTE } else { 0 }
    }

    /// Takes a number for the address of what the task is about.
    fn take_address(&mut self, word: &Word, before: Before) -> bool {
        let Some(Number { whole: Some(whole), hex }) = word.number else { return false };
        let Ok(address) = u16::try_from(whole) else { return false };
        let profile = self.task.profile;
        // A number beside a name says which one, or how much.
        if before != Before::Start && before != Before::Stop || self.is_named() {
            return false;
        }
        match self.task.target {
            Target::Parameter(parameter) => {
                let subindex = parameter.subindex.unwrap_or_default();
                let alias = profile.alias(parameter.address, subindex);
                let known = alias.is_some_and(|alias| [alias.new, alias.old].contains(&Some(address)));
                if parameter.address == address {
                    self.score += ADDRESS;
                    return true;
                }
                if known && (hex || word.text.len() == 4) {
                    self.score += ADDRESS;
                    self.reason =
                        message!("COMBIVIS address {address}", address = hex_value(address.into(), 2));
                    return true;
                }
                false
            }
            Target::Area(area) => {
                if !(area.from..=area.last()).contains(&address) {
                    return false;
                }
                let inside = (address - area.from) / area.stride.max(1);
                self.score += if address == area.from { ADDRESS - 20 } else { ADDRESS - 30 };
                // A range of anything is less than what has a name there.
                if area.count > 1000 {
                    self.score -= 50;
                }
                if let Some(first) = area.first {
                    if self.is_filled("number") {
                        return false;
                    }
                    let number = first + u64::from(inside);
                    let text = number_text(
                        number,
                        2,
                        if area.spec.hex_numbers { Format::Hex } else { Format::Decimal },
                    );
                    self.entries.push(("number".to_owned(), text));
                }
                true
            }
        }
    }

    /// Takes a number for which one is meant: the block, or what a command is for.
    fn take_number(&mut self, word: &Word) -> bool {
        if word.number.and_then(|number| number.whole).is_none() {
            return false;
        }
        let mut place = None;
        self.form.visit(&mut |entry| {
            let fits = match &entry.content {
                Content::Number { width, .. } => form::parse_value(&word.text, *width, entry.spec).is_ok(),
                _ => false,
            };
            let which = entry.spec.role == Role::Address && entry.path != "subindex" && fits;
            if which && place.is_none() && !self.is_filled(&entry.path) {
                place = Some((entry.path.clone(), entry.spec));
            }
        });
        let Some((path, spec)) = place else { return false };
        let whole = word.number.and_then(|number| number.whole).unwrap_or_default();
        if !spec.allows(whole) || path == "number" && !self.has_block(whole) {
            return false;
        }
        self.score += VALUE;
        self.fill(path, word.text.clone());
        true
    }

    /// Whether there is a block of this number.
    fn has_block(&self, number: u64) -> bool {
        let Target::Area(area) = self.task.target else { return false };
        let first = area.first.unwrap_or_default();
        (first..first + u64::from(area.count)).contains(&number)
    }

    /// Takes a number, or values parted by semicolons, for what is written.
    fn take_value(&mut self, word: &Word) -> bool {
        if self.task.access != Access::Write {
            return false;
        }
        let mut place = None;
        self.form.visit(&mut |entry| {
            let open = entry.path.starts_with("content.") && !self.is_filled(&entry.path);
            let fits = match &entry.content {
                Content::Number { width, .. } => {
                    !matches!(entry.spec.role, Role::Address | Role::Status)
                        && form::parse_value(&word.text, *width, entry.spec).is_ok()
                }
                Content::Text { .. } => true,
                _ => false,
            };
            if open && fits && place.is_none() {
                place = Some(entry.path.clone());
            }
        });
        let Some(path) = place else { return false };
        self.score += VALUE;
        self.fill(path, word.text.clone());
        true
    }

    /// Takes a word for the name of a value.
    fn take_value_name(&mut self, word: &Word) -> Option<i32> {
        let meant = meant(&word.plain);
        let state = STATES.iter().find(|(said, _)| *said == word.plain).map_or("", |(_, meant)| *meant);
        let fits = |label: &str| {
            split(label).any(|own| {
                [&word.plain, meant, state].contains(&own.as_str()) || own.strip_suffix('s') == Some(meant)
            })
        };
        if let Some((_, value, spec)) = &self.choice
            && spec.name(*value).is_some_and(|name| fits(name.label))
        {
            return Some(VALUE + 5);
        }
        if self.task.access != Access::Write {
            // What can be read has words for its values, too.
            let spec = spec_of(self.task);
            let names = spec.names.iter().chain(spec.bits.iter().flat_map(|part| part.names));
            return names.into_iter().any(|name| fits(name.label)).then_some(NOTE);
        }
        let mut place: Option<(String, String, &'static str)> = None;
        self.form.visit(&mut |entry: &Entry| {
            let Content::Number { width, text } = &entry.content else { return };
            if place.is_some() || self.is_filled(&entry.path) {
                return;
            }
            let begun = form::parse_value(text, *width, entry.spec).unwrap_or_default();
            let plain = entry.spec.names.iter().map(|name| (name.label, name.value));
            // Of a number whose bits each say something, only those that are named change.
            let parts = entry.spec.bits.iter().flat_map(|part| {
                let flag =
                    (part.count == 1 && part.names.is_empty()).then(|| (part.label, part.put(begun, 1)));
                part.names.iter().map(|name| (name.label, part.put(begun, name.value))).chain(flag)
            });
            let names: Vec<(&'static str, u64)> = plain.chain(parts).collect();
            let whole = names.iter().find(|(label, _)| fold(label) == word.plain);
            if let Some((label, raw)) = whole.or_else(|| names.iter().find(|(label, _)| fits(label))) {
                let text = number_text(*raw, *width, entry.spec.format);
                place = Some((entry.path.clone(), text, label));
            }
        });
        let Some((path, text, label)) = place else {
            // A second word of the same name.
            let again = self.named.iter().any(|label| fits(label));
            return again.then_some(VALUE / 2);
        };
        if fold(label) != word.plain {
            self.reason = message!("“{value}”", value = Argument::Term(label));
        }
        self.named.push(label);
        self.fill(path, text);
        Some(VALUE)
    }

    /// Whether a value is called exactly so.
    fn in_names(&self, word: &Word) -> bool {
        let mut found = false;
        self.form.visit(&mut |entry| {
            let parts = entry.spec.bits.iter().flat_map(|part| part.names);
            found |= entry.spec.names.iter().chain(parts).any(|name| fold(name.label) == word.plain);
        });
        found
    }

    /// Whether a word that is no verb is a part of what the task is called.
    fn is_named(&self) -> bool {
        self.query.words.iter().any(|word| !word.verb && self.in_label(word) >= BEGINNING)
    }

    /// Takes the name of a parameter for what a mapping is to carry.
    fn take_parameter(&mut self, word: &Word) -> bool {
        let wanted = self.task.access == Access::Write && self.is_named();
        let Some(refers) = spec_of(self.task).refers.filter(|_| wanted) else { return false };
        let mut named =
            self.task.profile.parameters().filter(|it| !it.id.is_empty() && fold(it.id) == word.plain);
        let Some(parameter) = named.next() else { return false };
        let path = format!("content.{}", spec_of(self.task).key);
        // An entry that stands for the parameter, in set 0 and of its length.
        let address = u64::from(parameter.address);
        let words = if parameter.length == Some(4) { 2 } else { 1 };
        let entry = (address.wrapping_sub(0x2000) << 16) | 0x0100 | words;
        let raw = [address, entry].into_iter().find(|raw| refers(*raw) == Some(parameter.address));
        let Some(raw) = raw else { return false };
        self.score += WORD;
        self.fill(path, hex_value(raw, if raw > 0xFFFF { 4 } else { 2 }).to_string());
        true
    }

    /// Whether a number is that of one of several things that are read together: a batch, a relay.
    fn is_read_with_all(&mut self, word: &Word) -> bool {
        const MOST: u64 = 60;
        let Target::Area(Area { content: Held::Telegram { .. } | Held::Parts(_), first: None, .. }) =
            self.task.target
        else {
            return false;
        };
        let one =
            word.number.and_then(|number| number.whole).is_some_and(|number| (1..=MOST).contains(&number));
        if one && self.task.access == Access::Read {
            self.score += VALUE + 10;
        }
        one && self.task.access == Access::Read
    }

    /// Takes the words from `index` on for a text.
    fn take_text(&mut self, index: usize) -> Option<()> {
        let path = self.text_entry()?;
        let texts = self.query.words[index..].iter().map(|word| word.text.as_str());
        let text = texts.collect::<Vec<_>>().join(" ");
        self.score += VALUE;
        self.fill(path, text);
        Some(())
    }

    /// The text that is written, where it is not filled in yet.
    fn text_entry(&self) -> Option<String> {
        let mut place = None;
        self.form.visit(&mut |entry| {
            if matches!(entry.content, Content::Text { .. }) && !self.is_filled(&entry.path) {
                place = place.take().or(Some(entry.path.clone()));
            }
        });
        place
    }

    /// Fills in "on", or "off", where there is nothing else to choose.
    fn switch(&mut self) {
        let mut place = None;
        self.form.visit(&mut |entry| {
            let states = ["on", "off", "active", "inactive"];
            let two = entry.spec.names.len() == 2
                && entry.spec.names.iter().all(|name| states.contains(&name.label));
            if two && entry.spec.role != Role::Function && place.is_none() {
                place = Some((entry.path.clone(), entry.spec));
            }
        });
        if let Some((path, spec)) = place {
            let value = u64::from(!self.query.off);
            let name = spec.name(value).map_or(value.to_string(), |name| name.label.to_owned());
            self.fill(path, name);
        }
    }

    fn fill(&mut self, path: String, text: String) {
        self.filled = true;
        self.entries.push((path, text));
    }

    fn is_filled(&self, path: &str) -> bool {
        self.entries.iter().any(|(filled, _)| filled == path)
    }

    /// Whether something is filled in that is to be written, besides which one.
    fn has_value(&self) -> bool {
        let chosen = self.choice.as_ref().map(|(path, ..)| path.as_str());
        self.entries.iter().any(|(path, _)| {
            let mut which = false;
            self.form.visit(&mut |entry| which |= entry.path == *path && entry.spec.role == Role::Address);
            path.starts_with("content.") && Some(path.as_str()) != chosen && !which
        })
    }
}

/// What stood before a word.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Before {
    Start,
    Label,
    Number,
    Value,
    Stop,
}

/// The names in a list that have a number behind them: `MDB_Mapping_Rd_N`, without that.
fn numbered_names(also: &'static str) -> impl Iterator<Item = &'static str> {
    also.split(' ').filter_map(|name| name.strip_suffix("_N"))
}

/// The names in a list parted by spaces, each with what it is parted by inside.
fn split_names(also: &'static str) -> Vec<&'static str> {
    also.split(' ').filter(|name| !name.is_empty()).collect()
}

/// Sets the choice at `path`.
fn choose(entries: &mut [Entry], path: &str, value: u64) {
    for entry in entries {
        match &mut entry.content {
            Content::Choice { raw, .. } if entry.path == path => *raw = value,
            Content::Group { entries } => choose(entries, path, value),
            _ => {}
        }
    }
}

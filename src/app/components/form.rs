//! A form: an entry for each field of something.

use maud::{Markup, html};
use web_sys::Event;

use super::strip::role_class;
use crate::app::browser;
use buslens::field::{Bits, Message, Role, Spec, hex_value, number_text};
use buslens::tool::{Change, Content, Entries, Entry, parse_value};

/// Calls `make` with the path and the change, if the event is one of an entry.
pub fn hear(kind: &str, event: &Event, make: impl FnOnce(&str, Change)) {
    let Some(path) = browser::attribute(event, "data-path") else { return };
    let number = |name: &str| browser::attribute(event, name).and_then(|number| number.parse().ok());
    let typed = browser::value(event);
    match kind {
        // Not every way to choose in a list tells of an input.
        "input" | "change" => match number("data-part") {
            // The first line of a list of names chooses none.
            None if typed.is_empty() && browser::id(event).ends_with(BY_NAME) => {}
            None => make(&path, Change::Enter(&typed)),
            Some(part) => {
                let value = browser::checked(event).map_or_else(|| typed.parse().ok(), |on| Some(on.into()));
                if let Some(value) = value {
                    make(&path, Change::Bits { part, value });
                }
            }
        },
        "click" if browser::attribute(event, "data-add").is_some() => make(&path, Change::Add),
        "click" => {
            if let Some(index) = number("data-remove") {
                make(&path, Change::Remove(index));
            }
        }
        _ => {}
    }
}

/// Ends of the ids of what belongs to the field of an entry: the list of names or what is computed, and
/// what is wrong with it.
const BY_NAME: &str = "=";
const MISFIT: &str = "!";

/// Which entries a form has: when that changes, it is drawn anew. In between its fields stay as they are
/// while somebody types.
pub fn shape(entries: &Entries) -> String {
    let mut shape = String::new();
    entries.form.visit(&mut |entry| {
        shape.push_str(&entry.path);
        if let Content::Choice { raw, .. } = entry.content {
            shape.push_str(&raw.to_string());
        }
        shape.push(' ');
    });
    shape
}

/// Whether the form has other entries than the [`shape`] `before` tells, and is to be drawn anew. If not,
/// its fields are brought up to date.
pub fn outgrown(before: &str, entries: &Entries) -> bool {
    let other = shape(entries) != before;
    if !other {
        refresh(entries);
    }
    other
}

/// Brings fields that stay in the page up to what the form says, and says beside them what does not fit.
fn refresh(entries: &Entries) {
    entries.form.visit(&mut |entry| {
        let path = &entry.path;
        let field = |part: &str| format!("{path}{part}");
        match &entry.content {
            Content::Number { width, text } => {
                browser::set_field(path, text);
                let raw = parse_value(text, *width, entry.spec);
                let name = raw.as_ref().ok().and_then(|raw| entry.spec.name(*raw));
                browser::set_field(&field(BY_NAME), name.map_or("", |name| name.label));
                for (index, part) in entry.spec.bits.iter().enumerate() {
                    let value = raw.as_ref().map_or(0, |raw| part.of(*raw));
                    browser::set_field(&field(&format!("#{index}")), &value.to_string());
                }
            }
            Content::Computed { width, computed, .. } => {
                browser::set_text(&field(BY_NAME), &hex_value(*computed, *width));
            }
            _ => {}
        }
        browser::set_text(&field(MISFIT), &said(entries, entry));
    });
}

/// What is wrong with an entry: it does not fit, or should not be so.
fn said(entries: &Entries, entry: &Entry) -> String {
    let spec = entry.spec;
    if let Some(misfit) = entries.misfits.iter().find(|misfit| misfit.path == entry.path) {
        return misfit.message.sentence();
    }
    match (&entry.content, spec.limits) {
        (Content::Number { width, text }, Some((from, to)))
            if parse_value(text, *width, spec).is_ok_and(|raw| !spec.allows(raw)) =>
        {
            format!("Allowed: {}.", range(entry, from, to))
        }
        _ => String::new(),
    }
}

/// The form.
pub fn form(all: &Entries) -> Markup {
    entries(all, &all.form.entries)
}

fn entries(all: &Entries, entries: &[Entry]) -> Markup {
    html! { div.entries { @for it in entries { (entry(all, it)) } } }
}

fn entry(all: &Entries, entry: &Entry) -> Markup {
    let spec = entry.spec;
    let label = entry.label().sentence();
    let class = role_class(spec.role);
    match &entry.content {
        Content::Group { entries: within } => html! {
            fieldset class=(class) { legend { (label) } (note(entry)) (entries(all, within)) }
        },
        Content::List { items } => html! {
            fieldset class=(class) data-path=(entry.path) {
                legend { (label) }
                (note(entry))
                @for (index, item) in items.iter().enumerate() {
                    div.item {
                        (entries(all, item))
                        button.quiet type="button" data-remove=(index) aria-label={ "Remove number " (index + 1) } { "−" }
                    }
                }
                button.quiet type="button" data-add="" { "Add one" }
            }
        },
        Content::Choice { raw, chosen } if !spec.names.is_empty() => html! {
            div.entry class=(class) data-path=(entry.path) {
                (label_of(entry, &label))
                div.control {
                    select id=(entry.path) {
                        @if spec.name(*raw).is_none() { option value=(raw) selected { (raw) ": " (chosen.label) } }
                        @for name in spec.names {
                            option value=(name.value) selected[*raw == name.value] { (Message::term(name.label).sentence()) }
                        }
                    }
                }
                p.note { (chosen.note) }
            }
        },
        // Too many to list, or known by their numbers: function codes.
        Content::Choice { raw, chosen } => html! {
            div.entry class=(class) data-path=(entry.path) {
                (label_of(entry, &label))
                div.control {
                    input id=(entry.path) value=(raw) autocomplete="off" spellcheck="false";
                    span.unit { (Message::term(chosen.label).sentence()) }
                }
            }
        },
        Content::Computed { width, computed, text } => html! {
            div.entry.computed class=(class) data-path=(entry.path) {
                (label_of(entry, &label))
                div.control {
                    output id={ (entry.path) (BY_NAME) } { (hex_value(*computed, *width)) }
                    input id=(entry.path) value=(text) placeholder="computed" autocomplete="off" spellcheck="false";
                }
                (misfit(all, entry))
            }
        },
        Content::Number { width, text } => html! {
            div.entry class=(class) data-path=(entry.path) {
                (label_of(entry, &label))
                div.control {
                    input id=(entry.path) value=(text) autocomplete="off" spellcheck="false" aria-describedby={ (entry.path) (MISFIT) };
                    @if !spec.unit.is_empty() { span.unit { (spec.unit) } }
                    @if by_name(spec) { (names(entry, parse_value(text, *width, spec).ok())) }
                }
                (misfit(all, entry))
                @if !spec.bits.is_empty() { (bits(entry, parse_value(text, *width, spec).unwrap_or(0))) }
            }
        },
        Content::Bytes { text }
        | Content::Text { text }
        | Content::Extra { text }
        | Content::Cut { text } => html! {
            div.entry class=(class) data-path=(entry.path) {
                (label_of(entry, &label))
                div.control {
                    input id=(entry.path) value=(text) autocomplete="off" spellcheck="false" aria-describedby={ (entry.path) (MISFIT) };
                }
                (misfit(all, entry))
            }
        },
    }
}

/// The entry's name, with what may be written there.
fn label_of(entry: &Entry, label: &str) -> Markup {
    html! {
        label for=(entry.path) title=(entry.spec.note) {
            (label)
            @if let Some((from, to)) = entry.spec.limits { small { (range(entry, from, to)) } }
        }
    }
}

fn range(entry: &Entry, from: u64, to: u64) -> String {
    let Content::Number { width, .. } = entry.content else { return String::new() };
    let text = |raw| number_text(raw, width, entry.spec.format);
    format!("{} to {}", text(from), text(to))
}

/// Where what is wrong with the entry is said.
fn misfit(all: &Entries, entry: &Entry) -> Markup {
    html! { p.misfit id={ (entry.path) (MISFIT) } { (said(all, entry)) } }
}

/// What there is to know of a group.
fn note(entry: &Entry) -> Markup {
    html! { @if !entry.spec.note.is_empty() { p.note { (entry.spec.note) } } }
}

/// Whether people think of its values by their names. A unit has a number; only a few are special.
fn by_name(spec: &Spec) -> bool {
    !spec.names.is_empty() && spec.role != Role::Unit
}

/// The named values to choose from.
fn names(entry: &Entry, raw: Option<u64>) -> Markup {
    html! {
        select id={ (entry.path) (BY_NAME) } aria-label={ (entry.label().sentence()) ", by name" } {
            option value="" { "by name" }
            @for name in entry.spec.names {
                option value=(name.label) selected[raw == Some(name.value)] { (Message::term(name.label).sentence()) }
            }
        }
    }
}

/// A switch for each bit that says something, a list or a number for several together.
fn bits(entry: &Entry, raw: u64) -> Markup {
    let parts = entry.spec.bits.iter().enumerate().filter(|(_, part)| !part.reserved);
    html! {
        div.bits {
            @for (index, part) in parts {
                @let id = format!("{}#{index}", entry.path);
                label title=(part.note) data-part=(index) {
                    (switch(&id, part, part.of(raw)))
                    span { (Message::term(part.label).sentence()) }
                }
            }
        }
    }
}

fn switch(id: &str, part: &Bits, value: u64) -> Markup {
    html! {
        @if !part.names.is_empty() {
            select id=(id) {
                @for name in part.names {
                    option value=(name.value) selected[value == name.value] {
                        @if name.label.is_empty() { (name.value) } @else { (Message::term(name.label).sentence()) }
                    }
                }
                @if part.name(value).is_none() { option value=(value) selected { (value) } }
            }
        } @else if part.count == 1 {
            input id=(id) type="checkbox" checked[value == 1];
        } @else {
            input id=(id) type="number" min="0" max=((1_u64 << part.count) - 1) value=(value);
        }
    }
}

//! The form of what is built: an entry for each field.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use super::strip::role_class;
use crate::app::browser;
use crate::app::making::{Made, Making};
use crate::app::state::State;
use crate::field::{Bits, Message, hex_value, number_text};
use crate::tool::{Content, Editor, Entry, parse_value};

#[component]
pub fn Form(making: Making) -> impl IntoView {
    let form = move || {
        making.shape.track();
        making.now(|made| form(made).into_string())
    };
    view! { <section class="card form" aria-label="Form" inner_html=form></section> }
}

/// Takes what was typed or chosen in the form.
pub fn hear(making: Making, state: State, kind: &str, event: &Event) {
    if kind == "click" && browser::attribute(event, "data-open").is_some() {
        making.open_all(state);
    }
    let Some(path) = browser::attribute(event, "data-path") else { return };
    let part = browser::attribute(event, "data-part").and_then(|part| part.parse().ok());
    let typed = || browser::value(event);
    match (kind, part) {
        ("input", None) => making.edit(state, |editor| editor.enter(&path, &typed())),
        ("input", Some(part)) => {
            let value = browser::checked(event).map_or_else(|| typed().parse().ok(), |on| Some(on.into()));
            if let Some(value) = value {
                making.edit(state, |editor| editor.set_bits(&path, part, value));
            }
        }
        ("click", _) => {
            if browser::attribute(event, "data-add").is_some() {
                making.edit(state, |editor| editor.add(&path));
            } else if let Some(index) =
                browser::attribute(event, "data-remove").and_then(|at| at.parse().ok())
            {
                making.edit(state, |editor| editor.remove(&path, index));
            }
        }
        _ => return,
    }
    making.now(|made| made.editor.as_ref().map(refresh));
}

/// Brings fields that stay in the page up to what the form says, and says beside them what does not fit.
fn refresh(editor: &Editor) {
    editor.entries().form.visit(&mut |entry| {
        let path = &entry.path;
        let field = |part: &str| format!("{path}{part}");
        match &entry.content {
            Content::Number { width, text } => {
                browser::set_field(&field(""), text);
                let raw = parse_value(text, *width, entry.spec);
                let name = raw.as_ref().ok().and_then(|raw| entry.spec.name(*raw));
                browser::set_field(&field("="), name.map_or("", |name| name.label));
                for (index, part) in entry.spec.bits.iter().enumerate() {
                    let value = raw.as_ref().map_or(0, |raw| part.of(*raw));
                    browser::set_field(&field(&format!("#{index}")), &value.to_string());
                }
            }
            Content::Computed { width, computed, .. } => {
                browser::set_text(&field("="), &hex_value(*computed, *width));
            }
            _ => {}
        }
        let misfit = editor.entries().misfits.iter().find(|misfit| misfit.path == *path);
        let said = misfit.map_or(String::new(), |misfit| misfit.message.sentence());
        browser::set_text(&field("!"), &said);
    });
}

fn form(made: &Made) -> Markup {
    let Some(editor) = &made.editor else { return html! {} };
    html! {
        h2 { @if let Some(offer) = made.chosen { (offer.label().sentence()) } }
        (entries(&editor.entries().form.entries))
        @if editor.is_task() {
            button.quiet type="button" data-open="" { "Edit every field of it" }
        }
    }
}

fn entries(entries: &[Entry]) -> Markup {
    html! { div.entries { @for it in entries { (entry(it)) } } }
}

fn entry(entry: &Entry) -> Markup {
    let spec = entry.spec;
    let label = entry.label().sentence();
    let class = role_class(spec.role);
    match &entry.content {
        Content::Group { entries: within } => html! {
            fieldset class=(class) { legend { (label) } (entries(within)) }
        },
        Content::List { items } => html! {
            fieldset class=(class) data-path=(entry.path) {
                legend { (label) }
                @for (index, item) in items.iter().enumerate() {
                    div.item {
                        (entries(item))
                        button.quiet type="button" data-remove=(index) aria-label={ "Remove number " (index + 1) } { "−" }
                    }
                }
                button.quiet type="button" data-add="" { "Add one" }
            }
        },
        Content::Choice { raw, chosen } => html! {
            p.entry class=(class) { span.label { (label) } span { (raw) ": " (chosen.label) } }
        },
        Content::Computed { width, computed, text } => html! {
            div.entry class=(class) data-path=(entry.path) {
                (label_of(entry, &label))
                div.control {
                    output id={ (entry.path) "=" } { (hex_value(*computed, *width)) }
                    input id=(entry.path) value=(text) placeholder="computed" autocomplete="off" spellcheck="false";
                }
                (misfit(entry))
            }
        },
        Content::Number { width, text } => html! {
            div.entry class=(class) data-path=(entry.path) {
                (label_of(entry, &label))
                div.control {
                    input id=(entry.path) value=(text) autocomplete="off" spellcheck="false" aria-describedby={ (entry.path) "!" };
                    @if !spec.unit.is_empty() { span.unit { (spec.unit) } }
                    @if !spec.names.is_empty() { (names(entry, parse_value(text, *width, spec).ok())) }
                }
                (misfit(entry))
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
                    input id=(entry.path) value=(text) autocomplete="off" spellcheck="false" aria-describedby={ (entry.path) "!" };
                }
                (misfit(entry))
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
fn misfit(entry: &Entry) -> Markup {
    html! { p.misfit id={ (entry.path) "!" } {} }
}

/// The named values to choose from.
fn names(entry: &Entry, raw: Option<u64>) -> Markup {
    html! {
        select id={ (entry.path) "=" } aria-label={ (entry.label().sentence()) ", by name" } {
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
                    option value=(name.value) selected[value == name.value] { (Message::term(name.label).sentence()) }
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

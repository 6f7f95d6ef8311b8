//! The tree of fields as a table.

use maud::{Markup, html};

use super::strip::{faulty, role_class};
use crate::app::browser::span_text;
use crate::app::state::{Shown, count};
use crate::field::{Bits, Field, Message, Value, hex};
use crate::tool::Block;

/// All fields of the telegram.
pub fn fields(shown: &Shown) -> Markup {
    let bytes = shown.bytes();
    let rows = shown.detail.fields.iter().enumerate();
    table("Fields", html! { @for (index, field) in rows { (row(field, 0, bytes, index == 0, None)) } })
}

/// What the device's manual says about registers and parameters.
pub fn device(shown: &Shown, name: &str) -> Markup {
    let blocks = &shown.detail.device.blocks;
    let rows = blocks.iter().enumerate();
    html! {
        @if !blocks.is_empty() {
            h3.device { (name) }
            (table(name, html! {
                @for (index, block) in rows {
                    (row(&block.field, 0, shown.bytes(), index == 0, Some(about(block))))
                }
            }))
        }
    }
}

/// Where a block is, and what there is to say of it.
fn about(block: &Block) -> String {
    let mut text = format!("at {}", block.registers());
    if !block.id.is_empty() {
        text = format!("{}, {text}", block.id);
    }
    match &block.note {
        Some(note) => format!("{text}; {note}"),
        None => text,
    }
}

fn table(name: &str, rows: Markup) -> Markup {
    html! {
        // The roles say again what the elements are, since a phone shows the rows as blocks.
        table.fields role="table" aria-label=(name) {
            thead role="rowgroup" {
                tr role="row" {
                    @for title in ["Field", "Bytes", "Value", "Meaning"] {
                        th role="columnheader" scope="col" { (title) }
                    }
                }
            }
            tbody role="rowgroup" { (rows) }
        }
    }
}

/// The row of a field and those of the fields within it.
fn row(field: &Field, depth: usize, bytes: &[u8], first: bool, about: Option<String>) -> Markup {
    /// More bytes do not fit into the column; the strip shows them.
    const SHOWN: usize = 12;
    let span = field.span;
    let parts: Vec<_> = field.parts().filter(|(part, value)| !part.reserved || *value != 0).collect();
    let within = !field.children.is_empty();
    // The meaning tells what is set: the bits are for those who want to know more.
    let open = if parts.is_empty() { "true" } else { "false" };
    let opens = within || !parts.is_empty();
    let meaning = match field.value {
        Value::Group if within && about.is_none() => count(field.children.len(), "value"),
        _ => field.meaning().map_or(String::new(), |meaning| meaning.to_string()),
    };
    html! {
        tr role="row" class={ (role_class(field.spec.role)) (faulty(field)) }
            data-span=(span_text(span)) data-depth=(depth) {
            th role="rowheader" scope="row" {
                button.field.group[opens] type="button" data-stop="" tabindex=(if first { "0" } else { "-1" })
                    aria-expanded=[opens.then_some(open)] title=(field.spec.note) {
                    (field.label())
                }
            }
            td.bytes role="cell" {
                (hex(&span.of(bytes)[..span.len().min(SHOWN)]))
                @if span.len() > SHOWN { " …" }
            }
            td.value role="cell" { (field.value_text()) }
            td.meaning role="cell" {
                (meaning)
                @if let Some(about) = about {
                    @if !meaning.is_empty() { br; }
                    small { (about) }
                }
            }
        }
        @for (part, value) in parts { (part_row(part, value, field, depth + 1)) }
        @for child in &field.children { (row(child, depth + 1, bytes, false, None)) }
    }
}

/// Some bits of a field.
fn part_row(part: &Bits, value: u64, field: &Field, depth: usize) -> Markup {
    let last = part.from + part.count - 1;
    let meaning = match part.name(value) {
        Some(name) => Message::term(name.label),
        None if part.count == 1 && value == 1 => Message::term("set"),
        None if part.count == 1 => Message::term("not set"),
        None => Message::term(""),
    };
    html! {
        tr role="row" hidden class=(role_class(field.spec.role)) data-span=(span_text(field.span)) data-depth=(depth) {
            th role="rowheader" scope="row" {
                button.field type="button" data-stop="" tabindex="-1" title=(part.note) { (Message::term(part.label).sentence()) }
            }
            td.bytes role="cell" {
                @if part.count == 1 { "bit " (part.from) } @else { "bits " (last) " to " (part.from) }
            }
            td.value role="cell" { (value) }
            td.meaning role="cell" { (meaning) }
        }
    }
}

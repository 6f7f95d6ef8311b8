//! The tree of fields as a table.

use maud::{Markup, html};

use super::strip::{faulty, role_class};
use crate::app::browser::span_text;
use crate::app::state::Shown;
use buslens::field::{Bits, Field, Message, Value, count, hex};
use buslens::tool::Block;

/// The rows of all fields of the telegram.
pub fn fields(shown: &Shown) -> Vec<String> {
    let mut rows = Rows::default();
    shown.detail.fields.iter().for_each(|field| rows.add(field, 0, shown.bytes(), None));
    rows.0
}

/// The rows of what the device's manual says about registers and parameters.
pub fn device(shown: &Shown) -> Vec<String> {
    let mut rows = Rows::default();
    for block in &shown.detail.device.blocks {
        rows.add(&block.field, 0, shown.bytes(), Some(about(block)));
    }
    rows.0
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

/// A table for rows that come later, in the element `id`.
pub fn table(name: &str, id: &str) -> Markup {
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
            tbody id=(id) role="rowgroup" {}
        }
    }
}

#[derive(Default)]
struct Rows(Vec<String>);

impl Rows {
    /// Adds the row of a field and those of the fields within it.
    fn add(&mut self, field: &Field, depth: usize, bytes: &[u8], about: Option<String>) {
        let parts: Vec<_> = field.parts().filter(|(part, value)| !part.reserved || *value != 0).collect();
        let first = self.0.is_empty();
        self.0.push(row(field, depth, bytes, first, !parts.is_empty(), about).into_string());
        for (part, value) in parts {
            self.0.push(part_row(part, value, field, depth + 1).into_string());
        }
        for child in &field.children {
            self.add(child, depth + 1, bytes, None);
        }
    }
}

fn row(
    field: &Field,
    depth: usize,
    bytes: &[u8],
    first: bool,
    has_parts: bool,
    about: Option<String>,
) -> Markup {
    /// More bytes do not fit into the column; the strip shows them.
    const SHOWN: usize = 12;
    let (span, own) = (field.span, field.span.of(bytes));
    let within = !field.children.is_empty();
    // The meaning tells what is set: the bits are for those who want to know more.
    let open = if has_parts { "false" } else { "true" };
    let opens = within || has_parts;
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
                (hex(&own[..own.len().min(SHOWN)]))
                @if own.len() > SHOWN { " …" }
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

//! The tree of fields as a table.

use maud::{Markup, html};

use super::strip::{faulty, role_class};
use crate::app::browser::span_text;
use crate::app::state::{Shown, count};
use crate::field::{Field, Value, hex};

pub fn fields(shown: &Shown) -> Markup {
    html! {
        // The roles say again what the elements are, since a phone shows the rows as blocks.
        table.fields role="table" aria-label="Fields" {
            thead role="rowgroup" {
                tr role="row" {
                    @for title in ["Field", "Bytes", "Value", "Meaning"] {
                        th role="columnheader" scope="col" { (title) }
                    }
                }
            }
            tbody role="rowgroup" {
                @for (index, field) in shown.detail.fields.iter().enumerate() {
                    (row(field, 0, shown.bytes(), index == 0))
                }
            }
        }
    }
}

/// The row of a field and those of the fields within it.
fn row(field: &Field, depth: usize, bytes: &[u8], first: bool) -> Markup {
    /// More bytes do not fit into the column; the strip shows them.
    const SHOWN: usize = 12;
    let span = field.span;
    let group = !field.children.is_empty();
    html! {
        tr role="row" class={ (role_class(field.spec.role)) (faulty(field)) }
            data-span=(span_text(span)) data-depth=(depth) {
            th role="rowheader" scope="row" {
                button.field.group[group] type="button" data-stop="" tabindex=(if first { "0" } else { "-1" })
                    aria-expanded=[group.then_some("true")] title=(field.spec.note) {
                    (field.label())
                }
            }
            td.bytes role="cell" {
                (hex(&span.of(bytes)[..span.len().min(SHOWN)]))
                @if span.len() > SHOWN { " …" }
            }
            td.value role="cell" { (field.value_text()) }
            td.meaning role="cell" {
                @match (&field.value, field.meaning()) {
                    (Value::Group, _) => @if group { (count(field.children.len(), "value")) },
                    (_, Some(meaning)) => (meaning),
                    (_, None) => "",
                }
            }
        }
        @for child in &field.children { (row(child, depth + 1, bytes, false)) }
    }
}

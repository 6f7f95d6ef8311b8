//! How telegrams of a kind are laid out, for those who want to know how one is made.

use maud::{Markup, html};

use super::strip::role_class;
use buslens::field::Message;
use buslens::tool::{Detail, Row, Size};

pub fn layout(detail: &Detail, layout: &[Row]) -> Markup {
    let rows = || layout.iter().filter(|row| row.size != Size::Group);
    html! {
        p { (detail.note) }
        div.boxes aria-hidden="true" {
            @for row in rows() {
                div class={ "box " (role_class(row.spec.role)) } {
                    b { (row.spec.short) }
                    small { (number(row)) }
                }
            }
        }
        dl {
            @for row in rows() { (explained(row)) }
        }
        @if !detail.source.is_empty() { p.source { "Source: " (detail.source) "." } }
    }
}

/// How many bytes, in a word.
fn number(row: &Row) -> String {
    match row.size {
        Size::Fixed(n) => n.to_string(),
        Size::Each(n) => format!("{n} × n"),
        Size::Rest | Size::Group => "n".to_owned(),
    }
}

fn explained(row: &Row) -> Markup {
    let spec = row.spec;
    html! {
        dt {
            (spec.label)
            small {
                @match row.size {
                    Size::Fixed(n) => (Message::bytes(n)),
                    Size::Each(n) => { (Message::bytes(n)) " each" },
                    Size::Rest | Size::Group => "all bytes up to the check",
                }
                @if let Some(offset) = row.offset { ", from byte " (offset) }
            }
        }
        dd {
            (spec.note)
            @if let Some((from, to)) = spec.limits { " Allowed: " (from) " to " (to) "." }
            @if let Some((value, chosen)) = row.chosen { " Here " (value) ": " (chosen.label) "." }
            @if !spec.names.is_empty() {
                dl.names {
                    @for name in spec.names {
                        dt { (name.value) }
                        dd { (name.label) ". " (name.note) }
                    }
                }
            }
        }
    }
}

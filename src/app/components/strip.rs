//! The bytes of a telegram in a row, grouped by field.

use maud::{Markup, html};

use crate::app::browser::span_text;
use crate::app::state::Shown;
use buslens::field::{Field, Numbering, Role, Severity};

/// More bytes than a telegram can have are not worth a cell each.
const MOST: usize = 300;

/// A piece for each field, and one for what is left out.
pub fn strip(shown: &Shown) -> Vec<String> {
    let bytes = shown.bytes();
    let leaves = shown.leaves().into_iter().filter(|leaf| leaf.span.from < MOST);
    let mut pieces: Vec<String> = leaves.map(|leaf| group(leaf, bytes).into_string()).collect();
    if bytes.len() > MOST {
        pieces.push(html! { p.rest { "and " (bytes.len() - MOST) " bytes more" } }.into_string());
    }
    pieces
}

fn group(leaf: &Field, bytes: &[u8]) -> Markup {
    let name = leaf.label().to_string();
    let label = match leaf.number {
        None => leaf.spec.short.to_owned(),
        Some(Numbering::At(_)) => name.rsplit(' ').next().unwrap_or_default().to_owned(),
        Some(Numbering::Offset(n)) => format!("+{n}"),
    };
    let to = leaf.span.to.min(MOST);
    html! {
        div class={ "group " (role_class(leaf.spec.role)) (faulty(leaf)) }
            data-span=(span_text(leaf.span)) {
            span.name aria-hidden="true" { (label) }
            div.cells {
                @for (at, byte) in (leaf.span.from..to).zip(&bytes[leaf.span.from..to]) {
                    button type="button" data-stop="" data-at=(at) tabindex=(if at == 0 { "0" } else { "-1" })
                        aria-label={ (format_args!("{byte:02X}")) ", byte " (at) ", " (name) } {
                        (format_args!("{byte:02X}"))
                    }
                }
            }
        }
    }
}

/// The class of a field with an error.
pub fn faulty(field: &Field) -> &'static str {
    let error = field.problems.iter().any(|problem| problem.severity == Severity::Error);
    if error { " faulty" } else { "" }
}

/// The class that gives a role its colour.
pub fn role_class(role: Role) -> &'static str {
    match role {
        Role::Unit => "role-unit",
        Role::Function => "role-function",
        Role::Address => "role-address",
        Role::Count => "role-count",
        Role::Data => "role-data",
        Role::Status => "role-status",
        Role::Check => "role-check",
        Role::Unknown => "role-unknown",
    }
}

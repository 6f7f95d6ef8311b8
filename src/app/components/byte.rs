//! The chosen byte: which field it is of, and how the field's value comes about.

use maud::{Markup, html};

use crate::app::state::Shown;
use buslens::tool::byte::{itself, shares};

pub fn byte(shown: &Shown, at: usize) -> Markup {
    let Some(byte) = shown.bytes().get(at).copied() else { return html! {} };
    html! {
        div.bar {
            p { strong { "Byte " (at) } ": " code { (itself(byte)) } }
            button.quiet type="button" data-close="" aria-label="Close" { "✕" }
        }
        @for share in shares(&shown.detail, shown.bytes(), at) {
            p {
                strong { (share.place.sentence()) "." }
                @for step in &share.steps { " " (step.sentence()) "." }
                " " (share.note)
                @if !share.source.is_empty() { " " cite { (share.source) "." } }
            }
        }
    }
}

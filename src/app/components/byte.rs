//! The chosen byte: which field it is of, and how the field's value comes about.

use maud::{Markup, html};

use crate::app::state::Shown;
use crate::tool::byte::{itself, shares};

pub fn byte(shown: &Shown, at: Option<usize>) -> Markup {
    let chosen = at.and_then(|at| Some((at, *shown.bytes().get(at)?)));
    let Some((at, byte)) = chosen else {
        return html! { p { "Choose a byte to see how its value comes about." } };
    };
    html! {
        p { strong { "Byte " (at) } ": " code { (itself(byte)) } }
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

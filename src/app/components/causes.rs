//! What may have happened to a telegram whose check failed.

use maud::{Markup, html};

use crate::app::address::fragment;
use crate::app::browser::span_text;
use crate::app::state::Shown;
use buslens::field::{Span, hex};
use buslens::tool::link::Link;
use buslens::tool::{Explanation, Options};

/// The causes of the telegram that is shown, best first; `options` say how it was read.
pub fn causes(shown: &Shown, options: &Options) -> Markup {
    html! {
        @if !shown.causes.is_empty() {
            div.causes {
                h3 { "What may have happened" }
                @if let Some(undecidable) = &shown.undecidable { p.warning { (undecidable.sentence()) "." } }
                ol {
                    @for cause in &shown.causes { li { (one(shown, cause, options)) } }
                }
            }
        }
    }
}

fn one(shown: &Shown, cause: &Explanation, options: &Options) -> Markup {
    let found = shown.bytes();
    let right = &cause.hypothesis.bytes;
    let options = Options {
        protocol: cause.hypothesis.protocol.or(Some(shown.telegram.choice.protocol)),
        ..options.clone()
    };
    let both = Link { telegram: 1, ..Link::to(format!("{}\n{}", hex(found), hex(right)), options) };
    let first = cause.removed.first().or(cause.added.first());
    html! {
        p { strong { (cause.hypothesis.text(found).sentence()) "." } }
        p.odds { "Fits by chance: " (cause.hypothesis.odds()) ". " (cause.sense().sentence()) "." }
        details {
            summary data-span=[first.map(|span| span_text(*span))] { "Show" }
            dl.both {
                dt { "As it came" }
                dd { (marked(found, &cause.removed, "bad")) }
                dt { "As it would be" }
                dd { (marked(right, &cause.added, "good")) }
                dt { "It would say" }
                dd { (cause.said.sentence()) "." }
            }
            div.actions {
                a.quiet href={ "./#" (fragment(&both)) } { "Open both" }
                button.quiet type="button" data-copy=(hex(right)) { "Copy the corrected bytes" }
            }
        }
    }
}

/// Bytes with those of `spans` marked.
fn marked(bytes: &[u8], spans: &[Span], class: &str) -> Markup {
    let is_marked = |at: usize| spans.iter().any(|span| span.contains(at));
    html! {
        code {
            @for (at, byte) in bytes.iter().enumerate() {
                @if is_marked(at) { mark class=(class) { (format_args!("{byte:02X}")) } } @else { (format_args!("{byte:02X}")) }
                " "
            }
        }
    }
}

//! The check: what it covers, what was found, what it should be.

use maud::{Markup, html};

use super::causes;
use crate::app::address::fragment;
use crate::app::browser::span_text;
use crate::app::state::Shown;
use buslens::field::{Check, Span, hex, hex_value};
use buslens::tool::link::Link;
use buslens::tool::{Options, Verdict};

/// `options` say how the telegram was read.
pub fn check(shown: &Shown, options: &Options) -> Markup {
    let Some(check) = shown.detail.check() else { return unchecked(shown) };
    let bytes = shown.bytes();
    let computed = check.computed_bytes();
    let explained = html! {
        (check.kind.to_ascii_uppercase()) " over "
        button.link type="button" data-span=(span_text(check.covered)) {
            "bytes " (check.covered.from) " to " (check.covered.to.saturating_sub(1))
        }
        " gives " code { (hex_value(check.computed_value(), check.width)) }
        @if check.low_first { ", on the wire low byte first: " code { (computed) } }
        "."
    };
    if check.ok() {
        html! {
            div.check.good {
                h3 { "The check is right" }
                p { (explained) " " (followed(bytes, &check)) }
            }
        }
    } else {
        html! {
            div.check.error {
                h3 { "The check does not match" }
                p { (explained) " Found: " code { (check.found_bytes()) } ". " (followed(bytes, &check)) }
                p {
                    "Some byte is not what its sender checked, or is missing or too many, or the check itself is \
                     wrong. The check alone cannot tell which: what is said above may be wrong, too."
                }
                div.actions {
                    button.quiet type="button" data-copy=(hex(&corrected(bytes, &check))) {
                        "Copy with the computed check"
                    }
                }
                (causes::causes(shown, options))
            }
        }
    }
}

/// A link to where the check is worked out step by step.
fn followed(bytes: &[u8], check: &Check) -> Markup {
    let link = Link {
        text: hex(check.covered.of(bytes)),
        entries: vec![("check".to_owned(), check.kind.to_owned())],
        ..Link::default()
    };
    html! { a href={ "check.html#" (fragment(&link)) } { "Follow it step by step" } }
}

/// The bytes with the check as it should be.
fn corrected(bytes: &[u8], check: &Check) -> Vec<u8> {
    let place = Span::new(check.covered.to, check.covered.to + check.width);
    let computed = &check.computed.to_be_bytes()[8 - check.width..];
    [Span::new(0, place.from).of(bytes), computed, Span::new(place.to, bytes.len().max(place.to)).of(bytes)]
        .concat()
}

/// A protocol without a check of its own: said, so that nobody takes it for checked.
fn unchecked(shown: &Shown) -> Markup {
    html! {
        @if shown.detail.verdict == Verdict::NoCheck {
            div.check.none {
                h3 { "No check of its own" }
                p {
                    (shown.telegram.choice.protocol.label)
                    " has none: what carries it checks the bytes. A changed byte cannot be told here."
                }
            }
        }
    }
}

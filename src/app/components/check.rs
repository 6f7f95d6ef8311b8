//! The check: what it covers, what was found, what it should be.

use maud::{Markup, html};

use crate::app::browser::span_text;
use crate::app::state::Shown;
use crate::field::{Span, hex, hex_value};
use crate::tool::Verdict;

pub fn check(shown: &Shown) -> Markup {
    let Some(check) = shown.detail.check() else { return unchecked(shown) };
    let bytes = shown.bytes();
    let covered = bytes.len() - check.width;
    let computed = check.computed_bytes();
    let explained = html! {
        (check.kind.to_ascii_uppercase()) " over "
        button.link type="button" data-span=(span_text(Span::new(0, covered))) { "bytes 0 to " (covered - 1) }
        " gives " code { (hex_value(check.computed_value(), check.width)) }
        @if check.low_first { ", on the wire low byte first: " code { (computed) } }
        "."
    };
    if check.ok() {
        html! {
            div.check.good {
                h3 { "The check is right" }
                p { (explained) }
            }
        }
    } else {
        html! {
            div.check.error {
                h3 { "The check does not match" }
                p { (explained) " Found: " code { (check.found_bytes()) } "." }
                p {
                    "Some byte is not what its sender checked, or is missing or too many, or the check itself is \
                     wrong. The check alone cannot tell which: what is said above may be wrong, too."
                }
                button.quiet type="button" data-copy={ (hex(&bytes[..covered])) " " (computed) } {
                    "Copy with the computed check"
                }
            }
        }
    }
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

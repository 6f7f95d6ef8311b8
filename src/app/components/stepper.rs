//! One step of a check: the bytes, the register before and after, and what is done.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use super::settings::list;
use super::{Drawn, drawn};
use crate::app::browser;
use crate::app::stepping::{AT, BYTES, Followed, KIND, Stepping};
use buslens::field::{count, hex_value};
use buslens::tool::steps::{CHECKS, Deed, MOST, POLYNOMIAL, Step};

#[component]
pub fn Stepper(stepping: Stepping) -> impl IntoView {
    let bytes = drawn(move || stepping.followed.with(bytes));
    let step = drawn(move || stepping.followed.with(step));
    let said: Drawn = Box::new(move || stepping.followed.with(said));
    view! {
        <section class="card input" aria-label="Input" inner_html=content().into_string()></section>
        <section class="card stepper" aria-label="The check, step by step">
            <div inner_html=bytes></div>
            <div class="walk">
                <div class="actions" inner_html=back().into_string()></div>
                <input id=AT type="range" min="0" aria-label="Step" aria-valuetext=said />
                <div class="actions" inner_html=forward().into_string()></div>
            </div>
            <div inner_html=step></div>
        </section>
    }
}

pub fn hear(stepping: Stepping, kind: &str, event: &Event) {
    let id = browser::id(event);
    let now = |look: fn(&Followed) -> usize| stepping.followed.with_untracked(look);
    match (kind, id.as_str()) {
        ("input", BYTES) => {
            let check = stepping.followed.with_untracked(|followed| followed.check);
            stepping.follow_other(browser::value(event), check);
        }
        ("change", KIND) => {
            let text = stepping.followed.with_untracked(|followed| followed.text.clone());
            let kind = browser::value(event);
            if let Some(check) = CHECKS.iter().find(|check| check.kind == kind) {
                stepping.follow_other(text, check);
            }
        }
        ("input", AT) => stepping.go(browser::value(event).parse().unwrap_or(0)),
        ("click", _) => {
            if let Some(to) = browser::attribute(event, "data-to") {
                let at = now(|followed| followed.at);
                stepping.go(match to.as_str() {
                    "first" => 0,
                    "back" => at.saturating_sub(1),
                    "forward" => at + 1,
                    "byte" => now(next_byte),
                    _ => usize::MAX,
                });
            } else if let Some(index) = browser::attribute(event, "data-at").and_then(|at| at.parse().ok()) {
                stepping.go(stepping.followed.with_untracked(|followed| followed.done_with(index)));
            }
        }
        _ => {}
    }
}

/// The step behind which the next byte is done with.
fn next_byte(followed: &Followed) -> usize {
    let byte = followed.step().byte;
    match followed.done_with(byte) {
        done if done > followed.at => done,
        _ => followed.done_with(byte + 1).max(followed.at),
    }
}

fn content() -> Markup {
    html! {
        label.title for=(BYTES) { "The bytes that the check is over, in hex" }
        div.row-of {
            input id=(BYTES) autocomplete="off" spellcheck="false";
            (list(KIND, "Check", None, CHECKS.iter().map(|check| (check.kind, title(check.kind)))))
        }
    }
}

fn title(kind: &str) -> &'static str {
    match kind {
        "crc-16/modbus" => "CRC of Modbus RTU (CRC-16/MODBUS)",
        "lrc" => "LRC of Modbus ASCII",
        _ => "FCS of PROFIBUS",
    }
}

fn back() -> Markup {
    html! {
        button.quiet type="button" data-to="first" { "Start" }
        button.quiet type="button" data-to="back" { "← Back" }
    }
}

fn forward() -> Markup {
    html! {
        button.quiet type="button" data-to="forward" { "Step →" }
        button.quiet type="button" data-to="byte" { "Whole byte" }
        button.quiet type="button" data-to="last" { "End" }
    }
}

/// The bytes with what the register holds behind each.
fn bytes(followed: &Followed) -> Markup {
    let width = followed.check.width;
    let step = followed.step();
    html! {
        @if followed.bytes.is_empty() {
            p { "There is no byte yet: expected hex, such as 01 03 00 C8 00 03." }
        }
        @if followed.bytes.len() > MOST {
            p.error { "Only the first " (MOST) " bytes are followed: no telegram has more." }
        }
        div.strip role="group" aria-label="Bytes" {
            @for (at, byte) in followed.bytes.iter().take(MOST).enumerate() {
                @let done = followed.steps[followed.done_with(at)].after;
                @let here = at == step.byte && step.deed != Deed::Start;
                div class=(if here { "group role-data lit" } else { "group role-data" }) {
                    span.name aria-hidden="true" { (hex_value(done.into(), width)) }
                    div.cells {
                        button type="button" data-at=(at) aria-pressed=(here)
                            aria-label={ (format_args!("{byte:02X}")) ", byte " (at) ", behind it " (hex_value(done.into(), width)) } {
                            (format_args!("{byte:02X}"))
                        }
                    }
                }
            }
        }
    }
}

/// What is done in this step, in a sentence.
fn said(followed: &Followed) -> String {
    let Step { deed, byte, before, after } = followed.step();
    let width = followed.check.width;
    let shown = |value: u16| hex_value(value.into(), width);
    let value = || hex_value(followed.bytes.get(byte).copied().unwrap_or_default().into(), 1);
    match deed {
        Deed::Start => format!("The register starts with {}.", shown(after)),
        Deed::Mix => format!("Byte {byte}, {}, is XORed into the low half of the register.", value()),
        Deed::Shift { bit, out: true } => format!(
            "Byte {byte}, bit {bit} of 8: the register goes one place to the right. A 1 falls out, so the \
             polynomial {} is XORed into it.",
            shown(POLYNOMIAL)
        ),
        Deed::Shift { bit, out: false } => format!(
            "Byte {byte}, bit {bit} of 8: the register goes one place to the right. A 0 falls out: that is all."
        ),
        Deed::Add => {
            let carry = if after < before { "; what is above FFh is dropped" } else { "" };
            format!("Byte {byte}, {}, is added{carry}.", value())
        }
        Deed::Complement => {
            "What is missing to 100h is taken: all bytes and the check add up to 0.".to_owned()
        }
    }
}

fn step(followed: &Followed) -> Markup {
    let Step { deed, byte, before, after } = followed.step();
    let width = followed.check.width;
    let value = u16::from(followed.bytes.get(byte).copied().unwrap_or_default());
    let end = followed.at == followed.last();
    html! {
        p.title { "Step " (followed.at) " of " (followed.last()) }
        h2 aria-live="polite" { (said(followed)) }
        table.register {
            tbody {
                @if deed != Deed::Start { (register("Before", before, width)) }
                @match deed {
                    Deed::Start | Deed::Complement => {}
                    Deed::Mix => { (register("Byte", value, width)) },
                    Deed::Add => { (register("Byte", value, width)) },
                    Deed::Shift { out, .. } => {
                        (shifted(before >> 1, out))
                        @if out { (register("Polynomial", POLYNOMIAL, width)) }
                    },
                }
                (register("After", after, width))
            }
        }
        @if end {
            @let wire = followed.check.wire(&followed.bytes[..followed.bytes.len().min(MOST)]);
            div.check.good {
                h3 { "The check is " (hex_value(after.into(), width)) }
                p {
                    @if followed.check.low_first {
                        "On the wire the low byte comes first: "
                        code { (format_args!("{:02X} {:02X}", wire >> 8, wire & 0xFF)) } "."
                    } @else {
                        "On the wire: " code { (format_args!("{wire:02X}")) } "."
                    }
                    " It is over " (count(followed.bytes.len().min(MOST), "byte")) "."
                }
            }
        }
    }
}

/// A register, a cell for each bit, highest first.
fn register(name: &str, value: u16, width: usize) -> Markup {
    row(name, value, width, html! { (hex_value(value.into(), width)) })
}

fn shifted(value: u16, out: bool) -> Markup {
    row("Shifted", value, 2, html! { (hex_value(value.into(), 2)) ", out falls " strong { (u8::from(out)) } })
}

fn row(name: &str, value: u16, width: usize, note: Markup) -> Markup {
    html! {
        tr {
            th scope="row" { (name) }
            td {
                span.bit-cells aria-hidden="true" {
                    @for bit in (0..8 * width).rev() {
                        @let set = value >> bit & 1;
                        span class=(if set == 1 { "one" } else { "zero" }) { (set) }
                    }
                }
            }
            td { (note) }
        }
    }
}

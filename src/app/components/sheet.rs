//! Every telegram on a sheet of paper: what it says, its bytes, its fields, what is wrong.

use leptos::prelude::*;
use maud::{Markup, html};

use super::drawn;
use super::strip::role_class;
use crate::app::state::{Decoded, State};
use buslens::field::{Direction, Field, Message, Severity, hex, leaves};
use buslens::tool::{Detail, Telegram, Verdict, annotated};

#[component]
pub fn Telegrams(state: State) -> impl IntoView {
    let sheet = drawn(move || state.decoded.with(sheet));
    view! { <article class="card sheet" inner_html=sheet></article> }
}

/// More telegrams are not printed: a file holds them all.
const MOST: usize = 200;

fn sheet(decoded: &Decoded) -> Markup {
    let report = &decoded.report;
    let total = report.telegrams.len();
    html! {
        header.sheet-head {
            div {
                p.title { "Buslens · telegrams" }
                p.plant id="plant" {}
                p { (annotated::summary(report)) }
            }
            @if let Some(device) = decoded.options.device { p { (device.label) } }
        }
        @if total == 0 { p { "There is no telegram here: paste some in Decode, then come back." } }
        @for index in 0..total.min(MOST) {
            @if let (Some(found), Some(detail)) = (report.telegrams.get(index), report.detail(index)) {
                (telegram(index, found, &detail))
                @if found.verdict == Verdict::Wrong { (causes(decoded, index, found)) }
            }
        }
        @if total > MOST { p { "And " (total - MOST) " telegrams more, which the files above hold." } }
    }
}

fn telegram(index: usize, telegram: &Telegram, detail: &Detail) -> Markup {
    let bytes = &telegram.line.bytes;
    let direction = telegram.guess.told().map_or("telegram", Direction::key);
    html! {
        section.telegram {
            p.title {
                (index + 1) " · " (telegram.choice.protocol.label) " " (direction)
                @if let Some(request) = telegram.answers { ", answers " (request + 1) }
                " · " (Message::bytes(bytes.len()))
                " · " (telegram.verdict.words())
            }
            h2 { (detail.meaning().sentence()) "." }
            @for problem in detail.problems() {
                p class=(if problem.severity == Severity::Error { "error" } else { "warning" }) {
                    @if problem.severity == Severity::Error { "Error: " } @else { "Warning: " }
                    (problem.message.sentence()) "."
                }
            }
            div.strip {
                @for leaf in leaves(&detail.fields).into_iter().filter(|leaf| !leaf.span.is_empty()) {
                    div class={ "group " (role_class(leaf.spec.role)) } {
                        span.name { (leaf.spec.short) }
                        span.run { (hex(leaf.span.of(bytes))) }
                    }
                }
            }
            table.rows {
                @for block in &detail.device.blocks { (row(&block.field, 0, bytes)) }
                @for field in &detail.fields { (row(field, 0, bytes)) }
            }
        }
    }
}

fn row(field: &Field, depth: usize, bytes: &[u8]) -> Markup {
    /// The strip has all of them.
    const SHOWN: usize = 8;
    let run = field.span.of(bytes);
    html! {
        tr data-depth=(depth) class=(role_class(field.spec.role)) {
            th scope="row" { (field.label().sentence()) }
            td { (hex(&run[..run.len().min(SHOWN)])) @if run.len() > SHOWN { " …" } }
            td { (field.value_text()) }
            td { @if let Some(meaning) = field.meaning() { (meaning) } }
        }
        @for child in &field.children { (row(child, depth + 1, bytes)) }
    }
}

/// What may have happened to a telegram whose check failed.
fn causes(decoded: &Decoded, index: usize, telegram: &Telegram) -> Markup {
    let causes = decoded.report.explanations(index);
    html! {
        @if !causes.is_empty() {
            div.causes {
                p.title { "What may have happened to telegram " (index + 1) }
                ol {
                    @for cause in causes {
                        li {
                            (cause.hypothesis.text(&telegram.line.bytes).sentence())
                            " (fits by chance: " (cause.hypothesis.odds()) "). It would then say: " (cause.said) "."
                        }
                    }
                }
            }
        }
    }
}

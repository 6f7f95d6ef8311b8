//! One telegram of the log with all its details, as the other views show them.

use maud::{Markup, html};

use crate::app::address::fragment;
use crate::app::components::{check, detail, fields, strip};
use crate::app::state::Shown;
use buslens::field::{Direction, Message, Span, hex};
use buslens::tool::link::Link;
use buslens::tool::log::{Entry, Log, Role, Source};

use super::rows::milliseconds;

/// The telegram at `index`.
pub fn telegram(log: &Log, source: &dyn Source, index: usize) -> Markup {
    let Some(entry) = log.entries().get(index) else { return html! {} };
    if entry.role == Role::Discarded {
        return discarded(log, entry, index);
    }
    let partner = entry.partner();
    let (report, place) = log.report_of(source, index);
    let Some(shown) = Shown::of(&report, place, index, log.entries().len()) else { return html! {} };
    let texts: Vec<String> = report.telegrams.iter().map(|telegram| hex(&telegram.line.bytes)).collect();
    let mut options = log.options().clone();
    options.protocol = Some(entry.protocol());
    let link = Link { telegram: place, ..Link::to(texts.join("\n"), options) };
    let direction = entry.direction.key();
    html! {
        p.title {
            "Telegram " (index + 1) " · " (entry.protocol().label) " " (direction)
            @if let Some(partner) = partner {
                " · "
                button.link type="button" data-entry=(partner) {
                    @if entry.direction == Direction::Response { "answers " } @else { "answered by " } (partner + 1)
                }
                @if let Some(latency) = log.latency(entry) { " after " (milliseconds(latency)) }
            }
            @if let Some(time) = entry.time() { " · " (buslens::tool::log::time_text(time)) }
            @if entry.line > 0 { " · line " (entry.line) }
        }
        h2 { (shown.detail.meaning().sentence()) "." }
        @if let Some(said) = about(entry) { p.kind { (said) "." } }
        (lines(log, source, entry, &shown.telegram.line.places))
        (detail::problems(&shown))
        div.bar {
            p.count { (Message::bytes(entry.length.into())) }
            div.actions {
                a.quiet href={ "./#" (fragment(&link)) } { "Open in Decode" }
                button.quiet type="button" data-copy=(hex(log.bytes(entry))) { "Copy as hex" }
            }
        }
        div.strip { @for piece in strip::strip(&shown) { (maud::PreEscaped(piece)) } }
        @let device = fields::device(&shown);
        @if !device.is_empty() {
            h3.device { (log.options().device.map_or("", |device| device.label)) }
            (rows_of("Device", device))
        }
        (rows_of("Fields", fields::fields(&shown)))
        (check::check(&shown, log.options()))
    }
}

fn rows_of(label: &str, rows: Vec<String>) -> Markup {
    html! {
        table.fields role="table" aria-label=(label) {
            tbody role="rowgroup" { @for row in rows { (maud::PreEscaped(row)) } }
        }
    }
}

/// What its place in the conversation says.
fn about(entry: &Entry) -> Option<&'static str> {
    Some(match entry.role {
        Role::Echo => "An echo: the request before it, heard by its own sender on the same wires",
        Role::Retry => "A retry: the same request before it got no answer",
        Role::Copy => "The log has it twice; this copy is not counted",
        Role::Broadcast => "Nobody answers it",
        Role::Late => "It came after other requests were sent",
        Role::Unasked => "Nobody asked for it, as far as the log goes",
        _ if entry.unanswered() => "Nobody answered it",
        _ => return None,
    })
}

/// The lines of the log that it was read from, with its bytes marked.
fn lines(log: &Log, source: &dyn Source, entry: &Entry, places: &[Span]) -> Markup {
    const LONGEST: usize = 4096;
    let (Some(first), Some(last)) = (places.first(), places.last()) else { return html! {} };
    if entry.line == 0 {
        return html! {};
    }
    let base = entry.offset as usize;
    let length = (last.to.max(first.to) - base).min(LONGEST);
    let mut text = log.piece_at(source, entry.offset, length + 200);
    // The rest of its last line belongs to it.
    let end =
        text.get(length..).and_then(|rest| rest.find(['\n', '\r'])).map_or(text.len(), |at| length + at);
    text.truncate(end);
    let mut pieces: Vec<(&str, bool)> = Vec::new();
    let mut at = 0;
    for place in places {
        let (from, to) = (place.from.saturating_sub(base), place.to.saturating_sub(base));
        let (Some(between), Some(byte)) = (text.get(at..from), text.get(from..to)) else { break };
        pieces.extend([(between, false), (byte, true)]);
        at = to;
    }
    pieces.push((text.get(at..).unwrap_or_default(), false));
    html! {
        pre.source tabindex="0" aria-label="In the log" {
            @for (piece, byte) in pieces {
                @if byte { mark { (piece) } } @else { (piece) }
            }
        }
    }
}

fn discarded(log: &Log, entry: &Entry, index: usize) -> Markup {
    const SHOWN: usize = 2000;
    let bytes = log.bytes(entry);
    html! {
        p.title { "Between the telegrams, number " (index + 1) @if entry.line > 0 { " · line " (entry.line) } @else { " · byte " (entry.offset) } }
        h2 { (Message::bytes(bytes.len())) " that belong to no telegram." }
        p.kind { "No telegram with a right check begins here: noise, a telegram whose beginning was lost, or another protocol." }
        pre.source tabindex="0" { (hex(&bytes[..bytes.len().min(SHOWN)])) @if bytes.len() > SHOWN { " …" } }
        div.actions {
            a.quiet href={ "./#" (fragment(&Link::to(hex(&bytes[..bytes.len().min(300)]), log.options().clone()))) } { "Open in Decode" }
            button.quiet type="button" data-copy=(hex(bytes)) { "Copy as hex" }
        }
    }
}

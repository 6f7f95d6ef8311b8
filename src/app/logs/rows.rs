//! The list's rows.

use std::collections::BTreeMap;

use maud::{Markup, html};

use buslens::field::Direction;
use buslens::tool::Verdict;
use buslens::tool::log::{Entry, Log, Role, Source};

/// The rows of the telegrams `indices`, the first of them at place `first` of a list of `total`, with
/// what was noted on telegrams by their numbers.
pub fn rows(
    log: &Log,
    source: &dyn Source,
    notes: &BTreeMap<usize, String>,
    indices: &[u32],
    (first, total): (usize, usize),
) -> Markup {
    let entries = log.entries();
    // A response says more when its request is known.
    let telegrams = indices.iter().map(|index| *index as usize);
    let read = log.with_partners(telegrams.filter(|index| entries[*index].role != Role::Discarded));
    let report = log.report(source, &read);
    let said = |index: usize| {
        let place = read.binary_search(&index).ok()?;
        Some(report.detail(place)?.said.sentence())
    };
    html! {
        @for (place, index) in (first..).zip(indices) {
            @let index = *index as usize;
            @let note = notes.get(&(index + 1)).map(String::as_str);
            (row(log, index, note, (place, total), said(index)))
        }
    }
}

fn row(
    log: &Log,
    index: usize,
    note: Option<&str>,
    (place, total): (usize, usize),
    said: Option<String>,
) -> Markup {
    let entry = &log.entries()[index];
    let discarded = entry.role == Role::Discarded;
    let (arrow, direction) = match (discarded, entry.direction) {
        (true, _) => ("·", "no telegram"),
        (_, Direction::Request) => ("→", "request"),
        (_, Direction::Response) => ("←", "response"),
    };
    let (mark, class) = match entry.verdict {
        _ if discarded => ("–", "open"),
        Verdict::Right => ("✓", "good"),
        Verdict::Wrong => ("✗", "error"),
        Verdict::Unchecked => ("…", "open"),
        Verdict::NoCheck => ("–", "open"),
    };
    let check = if discarded { "no telegram" } else { entry.verdict.words() };
    html! {
        div.row role="option" id={ "telegram-" (place) } data-place=(place) data-index=(index)
            aria-setsize=(total) aria-posinset=(place + 1) {
            span.number { (index + 1) }
            span.time { @if let Some(time) = entry.time() { (clock(time)) } }
            span.direction title=(direction) {
                span aria-hidden="true" { (arrow) }
                span.unseen { (direction) }
            }
            span.unit { @if let Some(unit) = entry.unit.filter(|_| !discarded) { (unit) } }
            span.said {
                @if let Some(note) = note { span.badge.note title="Your note" { "✎ " (note) } " " }
                @if let Some(badge) = badge(entry) { span class={ "badge " (badge.1) } { (badge.0) } " " }
                @match said {
                    Some(said) => (said),
                    None => { (buslens::field::Message::bytes(entry.length.into())) " discarded: " code { (buslens::field::hex(&log.bytes(entry)[..usize::from(entry.length).min(24)])) } }
                }
            }
            span.latency { @if entry.direction == Direction::Response { @if let Some(latency) = log.latency(entry) { (milliseconds(latency)) } } }
            span class={ "check " (class) } title=(check) {
                span aria-hidden="true" { (mark) }
                span.unseen { (check) }
            }
        }
    }
}

/// What is special about a telegram, in a word, and its class.
fn badge(entry: &Entry) -> Option<(&'static str, &'static str)> {
    Some(match entry.role {
        Role::Echo => ("echo", "open"),
        Role::Retry => ("retry", "warning"),
        Role::Copy => ("twice", "open"),
        Role::Broadcast => ("to all", "open"),
        Role::Late => ("late", "warning"),
        Role::Unasked => ("unasked", "warning"),
        _ if entry.unanswered() => ("unanswered", "error"),
        _ if entry.refuses() => ("exception", "warning"),
        _ => return None,
    })
}

/// The time of day without its date, which the summary tells.
fn clock(time: i64) -> String {
    let text = buslens::tool::log::time_text(time);
    match text.split_once(' ') {
        Some((_, clock)) if !clock.starts_with('(') => clock.to_owned(),
        _ => text,
    }
}

/// "31.4 ms".
pub fn milliseconds(micros: u32) -> String {
    match micros {
        0..10_000 => format!("{:.1} ms", f64::from(micros) / 1e3),
        10_000..10_000_000 => format!("{:.0} ms", f64::from(micros) / 1e3),
        _ => format!("{:.0} s", f64::from(micros) / 1e6),
    }
}

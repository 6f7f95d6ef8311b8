//! Where telegrams are pasted: the text, marks in it, and the line that says how it was read.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::{Element, Event, HtmlTextAreaElement};

use super::{drawn, header, marks, settings};
use crate::app::browser::{self, FILE, INPUT};
use crate::app::state::State;
use buslens::field::{Severity, Span, count};
use buslens::tool::{Remark, Report};

#[component]
pub fn Input(state: State) -> impl IntoView {
    let marks = drawn(move || {
        let lit = state.lit();
        state.decoded.with(|decoded| marks::marks(decoded, lit))
    });
    let reading = drawn(move || state.decoded.with(|decoded| reading(&decoded.text, &decoded.report)));
    view! {
        <section class="card input" aria-label="Input">
            <label for=INPUT class="title">"Paste telegrams as hex, one in a line"</label>
            <div class="editor">
                <div id=MARKS class="marks" aria-hidden="true" inner_html=marks></div>
                <textarea
                    id=INPUT
                    spellcheck="false"
                    autocomplete="off"
                    autocapitalize="off"
                    rows="6"
                    placeholder="01 03 00 C8 00 03 84 35"
                ></textarea>
            </div>
            <settings::Settings />
            <div class="reading" inner_html=reading></div>
            <p id="status" role="status" class="unseen"></p>
        </section>
    }
}

pub fn hear(state: State, kind: &str, event: &Event) {
    if kind == "click"
        && browser::closest(event, "button.place").is_some()
        && let Some(span) = browser::span(event)
    {
        state.decoded.with_untracked(|decoded| mark(&decoded.text, span));
    }
    if kind == "click" && browser::attribute(event, "data-logs").is_some() {
        state.decoded.with_untracked(|decoded| browser::remember(browser::LOG, &decoded.text));
        browser::go_to(header::LOGS);
    }
    match kind {
        "paste" if !browser::is_field(event) => {
            if let Some(text) = browser::pasted(event) {
                state.load(&text);
            }
        }
        // Without this the browser would leave the page for the file.
        "dragover" => event.prevent_default(),
        "drop" => match browser::pasted(event) {
            // Text that is moved within a field is the browser's to move.
            Some(_) if browser::is_field(event) => {}
            Some(text) => {
                event.prevent_default();
                state.load(&text);
            }
            None => {
                event.prevent_default();
                open(state, event);
            }
        },
        "change" if browser::id(event) == FILE => open(state, event),
        _ => {}
    }
    let Some(area) = browser::element::<HtmlTextAreaElement>(INPUT) else { return };
    if browser::id(event) != INPUT {
        return;
    }
    match kind {
        "input" => {
            let text = area.value();
            let cursor = cursor(&area, &text);
            state.type_text(text, cursor);
            scroll(&area);
        }
        "click" | "keyup" => {
            let cursor = state.decoded.with_untracked(|decoded| cursor(&area, &decoded.text));
            state.follow_cursor(cursor);
        }
        "scroll" => scroll(&area),
        _ => {}
    }
}

/// Puts a file in place of the input.
fn open(state: State, event: &Event) {
    browser::read_file(event, move |_, text| state.load(&text));
}

const MARKS: &str = "marks";

/// Keeps the marks behind their text.
fn scroll(area: &HtmlTextAreaElement) {
    if let Some(marks) = browser::element::<Element>(MARKS) {
        marks.set_scroll_top(area.scroll_top());
    }
}

/// The cursor's place in bytes of the area's text.
fn cursor(area: &HtmlTextAreaElement, text: &str) -> usize {
    let at = area.selection_start().ok().flatten().unwrap_or_default();
    byte_offset(text, at as usize)
}

/// Selects a piece of the text, so that one sees it and can type over it.
fn mark(text: &str, span: Span) {
    let Some(area) = browser::element::<HtmlTextAreaElement>(INPUT) else { return };
    browser::focus(&area);
    let _ = area.set_selection_range(utf16_offset(text, span.from), utf16_offset(text, span.to));
}

/// The line that says how the text was read, and what in it was not understood.
fn reading(text: &str, report: &Report) -> Markup {
    let summary = report.summary();
    let Some(style) = report.style else {
        return html! {
            p {
                @if text.trim().is_empty() {
                    "Spaces, commas, 0x, \\x, h, brackets and arrays of C, Python and Rust are fine."
                } @else {
                    strong.error { "No bytes found." } " Expected hex, such as 01 03 00 C8 00 03 84 35."
                }
            }
            (remarks(text, report))
        };
    };
    html! {
        p {
            "Read as " strong { (style.name()) } ", " (protocol_name(report)) ": " (count(summary.telegrams, "telegram"))
            @if summary.pairs > 0 { ", " (summary.pairs) " answered" }
            @if summary.check_failed > 0 {
                ", " strong.error { (count(summary.check_failed, "check")) " failed" }
            } @else if summary.checked == summary.telegrams {
                ", " strong.good { @if summary.telegrams == 1 { "check right" } @else { "all checks right" } }
            }
            @if summary.unchecked > 0 { ", " (summary.unchecked) " too short to check" }
            "."
            @if summary.lines_not_understood > 0 {
                " " strong.error { (count(summary.lines_not_understood, "line")) } " without bytes."
            }
        }
        @if looks_like_log(report) {
            p { "Is this a log of another program? " button.link type="button" data-logs="" { "Read it in Logs" } }
        }
        (remarks(text, report))
    }
}

/// Whether most lines have something besides bytes in them.
fn looks_like_log(report: &Report) -> bool {
    let lines = report.lines().count();
    let odd =
        report.lines().filter(|line| line.remarks.iter().any(|remark| remark.code == "not-hex")).count();
    lines > 1 && odd * 2 > lines
}

/// The protocol of all telegrams, if they have the same.
fn protocol_name(report: &Report) -> &'static str {
    let mut labels = report.telegrams.iter().map(|telegram| telegram.choice.protocol.label);
    match labels.next() {
        Some(first) if labels.all(|label| label == first) => first,
        _ => "several protocols",
    }
}

/// What is wrong in the text, each with a button to its place.
fn remarks(text: &str, report: &Report) -> Markup {
    /// More are not read by anybody.
    const SHOWN: usize = 5;
    let mut total = 0;
    let mut first: Vec<&Remark> = Vec::new();
    for remark in report.lines().flat_map(|line| &line.remarks) {
        total += 1;
        let at = first.partition_point(|other| other.span.from < remark.span.from);
        if at < SHOWN {
            first.insert(at, remark);
            first.truncate(SHOWN);
        }
    }
    html! {
        @if total > 0 {
            ul.remarks {
                @for remark in first {
                    @let (line, column) = place(text, remark.span.from);
                    li class=(if remark.severity == Severity::Error { "error" } else { "warning" }) {
                        button.place type="button" data-span=(browser::span_text(remark.span)) {
                            "Line " (line) ", character " (column)
                        }
                        " " (remark.message.sentence()) "."
                    }
                }
                @if total > SHOWN { li.more { "and " (total - SHOWN) " more" } }
            }
        }
    }
}

/// Line and character of the byte `at`, both from 1.
fn place(text: &str, at: usize) -> (usize, usize) {
    let before = text.get(..at).unwrap_or(text);
    let line = before.rsplit('\n').next().unwrap_or_default();
    (before.matches('\n').count() + 1, line.chars().count() + 1)
}

/// The browser counts UTF-16 units, we count bytes.
fn utf16_offset(text: &str, at: usize) -> u32 {
    text.get(..at).unwrap_or(text).encode_utf16().count() as u32
}

/// The byte of the text at which the browser counts `at` units.
pub fn byte_offset(text: &str, at: usize) -> usize {
    let mut units = 0;
    let reached = text.char_indices().find(|(_, c)| {
        let reached = units >= at;
        units += c.len_utf16();
        reached
    });
    reached.map_or(text.len(), |(at, _)| at)
}

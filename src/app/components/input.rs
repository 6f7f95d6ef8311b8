//! Where telegrams are pasted: the text, marks in it, and the line that says how it was read.

use gloo_timers::callback::Timeout;
use leptos::html::{Details, Div};
use leptos::prelude::*;

use super::examples::Examples;
use crate::app::browser;
use crate::app::state::State;
use crate::field::{Direction, Severity, Span};
use crate::tool::Remark;

#[component]
pub fn Input() -> impl IntoView {
    let state = State::here();
    let area = state.area;
    let marks = NodeRef::<Div>::new();
    let menu = NodeRef::<Details>::new();
    let scroll = move || {
        if let (Some(area), Some(marks)) = (area.get_untracked(), marks.get_untracked()) {
            marks.set_scroll_top(area.scroll_top());
        }
    };
    // The telegram at the cursor is the one that is shown.
    let follow_cursor = move || {
        let Some(at) = area.get_untracked().and_then(|area| area.selection_start().ok().flatten()) else {
            return;
        };
        let at = state.text.with_untracked(|text| byte_offset(text, at as usize));
        let found = state.report.with_untracked(|report| {
            report.telegrams.iter().position(|telegram| at <= telegram.line.span.to)
        });
        if let Some(index) = found {
            state.selected.set(index);
        }
    };
    let close_menu = move || {
        if let Some(menu) = menu.get_untracked() {
            menu.set_open(false);
        }
    };
    let select = move |span: Span| {
        let Some(area) = area.get_untracked() else { return };
        let (from, to) =
            state.text.with_untracked(|text| (utf16_offset(text, span.from), utf16_offset(text, span.to)));
        let _ = area.focus();
        let _ = area.set_selection_range(from, to);
    };
    view! {
        <section class="card input" aria-label="Input">
            <label for="input" class="title">"Paste telegrams as hex, one in a line"</label>
            <div class="editor">
                <div class="marks" aria-hidden="true" node_ref=marks>{move || marked(state)}</div>
                <textarea
                    id="input"
                    node_ref=area
                    spellcheck="false"
                    autocomplete="off"
                    autocapitalize="off"
                    rows="6"
                    placeholder="01 03 00 C8 00 03 84 35"
                    aria-describedby="reading"
                    prop:value=move || state.text.get()
                    on:input:target=move |event| {
                        state.text.set(event.target().value());
                        follow_cursor();
                        scroll();
                    }
                    on:click=move |_| follow_cursor()
                    on:keyup=move |_| follow_cursor()
                    on:scroll=move |_| scroll()
                ></textarea>
            </div>
            <div class="settings">
                <label>
                    <span>"Direction"</span>
                    <select
                        id="direction"
                        prop:value=move || state.direction.get().map_or("auto", Direction::key)
                        on:change:target=move |event| {
                            state.direction.set(match event.target().value().as_str() {
                                "request" => Some(Direction::Request),
                                "response" => Some(Direction::Response),
                                _ => None,
                            });
                        }
                    >
                        <option value="auto">"As the bytes tell"</option>
                        <option value="request">"All are requests"</option>
                        <option value="response">"All are responses"</option>
                    </select>
                </label>
                <details
                    class="menu"
                    node_ref=menu
                    on:keydown=move |event| {
                        if event.key() == "Escape" {
                            close_menu();
                            browser::focus("examples");
                        }
                    }
                >
                    <summary id="examples">"Examples"</summary>
                    <Examples choose=move |example| {
                        close_menu();
                        state.load(example.text);
                    } />
                </details>
                <button
                    type="button"
                    class="quiet"
                    disabled=move || state.text.with(String::is_empty)
                    on:click=move |_| state.load("")
                >
                    "Clear"
                </button>
            </div>
            <p id="reading" class="reading">{move || reading(state)}</p>
            <Remarks select />
            <Announcement />
        </section>
    }
}

/// What is wrong in the text, each with a button to its place.
#[component]
fn Remarks(select: impl Fn(Span) + Copy + Send + Sync + 'static) -> impl IntoView {
    /// More are not read by anybody.
    const SHOWN: usize = 5;
    let state = State::here();
    move || {
        let (remarks, total) = state.report.with(|report| {
            let lines =
                report.not_understood.iter().chain(report.telegrams.iter().map(|telegram| &telegram.line));
            let mut remarks: Vec<(usize, Remark)> = Vec::new();
            let mut total = 0;
            for line in lines {
                total += line.remarks.len();
                let room = SHOWN - remarks.len();
                remarks.extend(line.remarks.iter().take(room).map(|remark| (line.span.from, remark.clone())));
            }
            (remarks, total)
        });
        if total == 0 {
            return None;
        }
        let rest = total - remarks.len();
        let rows = remarks
            .into_iter()
            .map(|(_, remark)| {
                let span = remark.span;
                let (line, column) = state.text.with_untracked(|text| place(text, span.from));
                let class = if remark.severity == Severity::Error { "error" } else { "warning" };
                view! {
                    <li class=class>
                        <button type="button" class="place" on:click=move |_| select(span)>
                            {format!("Line {line}, character {column}")}
                        </button>
                        " "
                        {remark.message.sentence()}
                        "."
                    </li>
                }
            })
            .collect_view();
        Some(view! {
            <ul class="remarks">
                {rows}
                {(rest > 0).then(|| view! { <li class="more">{format!("and {rest} more")}</li> })}
            </ul>
        })
    }
}

/// Says the reading to those who do not see it, once typing pauses.
#[component]
fn Announcement() -> impl IntoView {
    const PAUSE: u32 = 700;
    let state = State::here();
    let said = RwSignal::new(String::new());
    let waiting = StoredValue::new_local(None::<Timeout>);
    Effect::new(move |_| {
        let text = reading_text(state);
        waiting.set_value(Some(Timeout::new(PAUSE, move || said.set(text))));
    });
    view! { <p role="status" class="unseen">{said}</p> }
}

fn reading_text(state: State) -> String {
    let summary = state.report.with(|report| report.summary());
    let problems = state.report.with(|report| report.style).map_or("", |style| style.name());
    match summary.telegrams {
        0 if state.text.with(|text| text.trim().is_empty()) => String::new(),
        0 => "No bytes found.".to_owned(),
        n => {
            let failed = match summary.check_failed {
                0 => String::new(),
                n => format!(", {n} failed {}", if n == 1 { "check" } else { "checks" }),
            };
            format!("{}{failed}, read as {problems}.", count(n, "telegram"))
        }
    }
}

/// The line that says how the text was read.
fn reading(state: State) -> AnyView {
    let (summary, style) = state.report.with(|report| (report.summary(), report.style));
    let Some(style) = style else {
        return match state.text.with(|text| text.trim().is_empty()) {
            true => view! { "Spaces, commas, 0x, \\x, h, brackets and arrays of C, Python and Rust are fine." }.into_any(),
            false => view! { <strong class="error">"No bytes found."</strong>" Expected hex, such as 01 03 00 C8 00 03 84 35." }
                .into_any(),
        };
    };
    let unchecked =
        state.report.with(|report| report.telegrams.iter().filter(|t| t.line.bytes.len() < 4).count());
    view! {
        "Read as "
        <strong>{style.name()}</strong>
        ", Modbus RTU: "
        {count(summary.telegrams, "telegram")}
        {(summary.pairs > 0).then(|| format!(", {} answered", summary.pairs))}
        {(summary.check_failed > 0)
            .then(|| {
                view! { ", "<strong class="error">{count(summary.check_failed, "check")}" failed"</strong> }
            })}
        {(summary.check_failed == 0 && unchecked == 0)
            .then(|| view! { ", "<strong class="good">{if summary.telegrams == 1 { "check right" } else { "all checks right" }}</strong> })}
        {(unchecked > 0).then(|| format!(", {unchecked} too short to check"))}
        "."
        {(summary.lines_not_understood > 0)
            .then(|| {
                view! { " "<strong class="error">{count(summary.lines_not_understood, "line")}</strong>" without bytes." }
            })}
    }
    .into_any()
}

fn count(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

/// The text once more, behind the input, with what is wrong in it and what is lit up marked.
fn marked(state: State) -> AnyView {
    /// Beyond this, laying out the text anew at each move of the pointer would be felt.
    const LONGEST_LIT: usize = 20_000;
    /// Marks beyond these are out of sight anyhow.
    const MOST: usize = 500;
    let mut spans: Vec<(Span, &'static str)> = state.report.with(|report| {
        let lines =
            report.not_understood.iter().chain(report.telegrams.iter().map(|telegram| &telegram.line));
        let remarks = lines.flat_map(|line| &line.remarks);
        let errors = remarks.filter(|remark| remark.severity == Severity::Error);
        errors.map(|remark| (remark.span, "bad")).take(MOST).collect()
    });
    let length = state.text.with(String::len);
    if length <= LONGEST_LIT
        && let (Some(lit), Some(shown)) = (state.lit(), state.shown.get())
    {
        spans.extend(lit.of(&shown.telegram.line.places).iter().map(|place| (*place, "lit")));
    }
    spans.sort_by_key(|(span, _)| span.from);
    state.text.with(|text| {
        let mut pieces = Vec::with_capacity(2 * spans.len() + 1);
        let mut at = 0;
        for (span, class) in spans {
            if at <= span.from && span.to <= text.len() {
                pieces.push(text[at..span.from].to_owned().into_any());
                pieces.push(
                    view! { <mark class=class>{text[span.from..span.to].to_owned()}</mark> }.into_any(),
                );
                at = span.to;
            }
        }
        // A text area shows the empty line after a last line end; a block only does with more behind.
        pieces.push(format!("{}\u{200B}", &text[at..]).into_any());
        pieces.into_any()
    })
}

/// Line and character of the byte `at`, both from 1.
fn place(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at.min(text.len())];
    let line_start = before.rfind('\n').map_or(0, |end| end + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// The browser counts UTF-16 units, we count bytes.
fn utf16_offset(text: &str, at: usize) -> u32 {
    text[..at.min(text.len())].encode_utf16().count() as u32
}

fn byte_offset(text: &str, at: usize) -> usize {
    let mut units = 0;
    text.char_indices()
        .find(|(_, c)| {
            let reached = units >= at;
            units += c.len_utf16();
            reached
        })
        .map_or(text.len(), |(at, _)| at)
}

//! The input: the text, marks in it, and beside each line what it says.

use leptos::ev::{Event, KeyboardEvent};
use leptos::html;
use leptos::prelude::*;

use super::ReadState;
use crate::components::icon::{Glyph, Icon};
use crate::components::roving;
use crate::components::state_badge::StateBadge;
use buslens::field::{Direction, Severity, Span};
use buslens::tool::log::{State, brief};
use buslens::tool::{Certainty, Remark, Report};

/// Beyond this many bytes, laying out the text anew at each move of the pointer would be felt.
const LONGEST_LIT: usize = 20_000;
/// Marks beyond these are out of sight anyhow.
const MOST_MARKS: usize = 500;
/// What more lines say is not worth being read here.
const MOST_LINES: usize = 60;

#[component]
pub fn Editor() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let area = NodeRef::<html::Textarea>::new();
    let marks = NodeRef::<html::Div>::new();
    let cursor = move || {
        let Some(area) = area.get_untracked() else { return 0 };
        let at = area.selection_start().ok().flatten().unwrap_or_default();
        byte_offset(&area.value(), at as usize)
    };
    let typed = move |event: Event| read.type_text(event_target_value(&event), cursor());
    let moved = move || read.follow_cursor(cursor());
    // The tabulator that led here moved no cursor, nor do keys that are held down with others.
    let key_moved = move |event: KeyboardEvent| {
        let key = event.key();
        if key.starts_with("Arrow") || matches!(key.as_str(), "Home" | "End" | "PageUp" | "PageDown") {
            moved();
        }
    };
    // The marks stay behind their text.
    let scrolled = move |_| {
        if let (Some(area), Some(marks)) = (area.get_untracked(), marks.get_untracked()) {
            marks.set_scroll_left(area.scroll_left());
            marks.set_scroll_top(area.scroll_top());
        }
    };
    let select = Callback::new(move |span: Span| {
        let Some(area) = area.get_untracked() else { return };
        let text = area.value();
        let _ = area.focus();
        let _ = area.set_selection_range(utf16_offset(&text, span.from), utf16_offset(&text, span.to));
    });
    let rows = move || read.with_text(|text| text.split('\n').count().clamp(2, 200));
    let columns =
        move || read.with_text(|text| text.lines().map(str::len).max().unwrap_or_default().clamp(40, 120));
    view! {
        <div
            class="editor"
            class:empty=move || read.report().telegrams.is_empty()
            style:--columns=move || columns().to_string()
        >
            <div class="written">
                <div class="marks" aria-hidden="true" node_ref=marks>
                    <Marks />
                </div>
                <textarea
                    node_ref=area
                    aria-label="Telegrams, logs, or the mail they came in"
                    placeholder="Paste or type telegrams or a log, or drop a file anywhere"
                    spellcheck="false"
                    autocomplete="off"
                    autocapitalize="off"
                    rows=rows
                    prop:value=move || read.text()
                    on:input=typed
                    on:click=move |_| moved()
                    on:keyup=key_moved
                    on:scroll=scrolled
                ></textarea>
            </div>
            <Said />
        </div>
        <Remarks select />
    }
}

/// What each line says, beside it.
#[component]
fn Said() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let lines = Memo::new(move |_| said(&read.report()));
    let list = NodeRef::<html::Ol>::new();
    // The one that Tab leads to: of the telegram that is shown, or of that in whose line it stands.
    let stop = Memo::new(move |_| {
        let shown = read.index();
        lines.with(|lines| lines.iter().rfind(|line| line.index <= shown).map(|line| line.index))
    });
    let keys = move |event: KeyboardEvent| {
        let to = list.get_untracked().and_then(|list| roving::follow(&event, &list, "button"));
        let to = to.and_then(|to| lines.with_untracked(|lines| lines.get(to).map(|line| line.index)));
        to.into_iter().for_each(|index| read.select(index));
    };
    let line = move |line: SaidLine| {
        let index = line.index;
        let arrow = match line.direction {
            Some(Direction::Request) => "→",
            Some(Direction::Response) => "←",
            None => "↔",
        };
        let words = line.direction.map_or("direction open", Direction::key);
        view! {
            <li style:--line=line.line.to_string()>
                <button
                    type="button"
                    tabindex=move || if stop.get() == Some(index) { "0" } else { "-1" }
                    aria-pressed=move || (read.index() == index).to_string()
                    on:click=move |_| read.select(index)
                >
                    <span class="arrow" aria-hidden="true">{arrow}</span>
                    <span class="unseen">{words}": "</span>
                    <span class="said">{line.said}</span>
                    <StateBadge state=line.state latency=None />
                </button>
            </li>
        }
    };
    view! {
        <ol class="said-lines" aria-label="What the lines say" node_ref=list on:keydown=keys>
            <For each=move || lines.get() key=|line| line.clone() children=line />
        </ol>
    }
}

#[derive(Clone, PartialEq, Eq, Hash)]
struct SaidLine {
    index: usize,
    /// From 0.
    line: usize,
    direction: Option<Direction>,
    said: String,
    state: State,
}

fn said(report: &Report) -> Vec<SaidLine> {
    let mut lines: Vec<SaidLine> = Vec::new();
    for (index, telegram) in report.telegrams.iter().enumerate() {
        let line = telegram.line.number.saturating_sub(1);
        if lines.len() == MOST_LINES {
            break;
        }
        // Of several telegrams in a line, there is room for the first.
        if lines.last().is_some_and(|last| last.line == line) {
            continue;
        }
        let Some(detail) = report.detail(index) else { continue };
        lines.push(SaidLine {
            index,
            line,
            direction: (telegram.guess.certainty != Certainty::Open).then_some(telegram.guess.direction),
            said: brief(&detail.said),
            state: report.state(index),
        });
    }
    lines
}

/// The text once more, to stand behind the input: invisible but for its marks. What cannot be read is
/// marked as bad, the bytes that are pointed at or chosen as lit.
#[component]
fn Marks() -> impl IntoView {
    let read = expect_context::<ReadState>();
    move || {
        let lit = read.lights.pointed().or(read.lights.chosen().map(|chosen| chosen.span));
        let report = read.report();
        read.with_settled(|text| {
            let shown = report.telegrams.get(read.index()).map(|telegram| telegram.line.places.as_slice());
            let lit = match (lit, text.len()) {
                (Some(lit), ..=LONGEST_LIT) => lit.of(shown.unwrap_or_default()),
                _ => &[],
            };
            pieces(text, &report, lit)
                .into_iter()
                .map(|(before, marked, class)| view! { {before}<mark class=class>{marked}</mark> })
                .collect_view()
        })
    }
}

/// The marks in their order, each with what stands between it and the one before.
fn pieces(text: &str, report: &Report, lit: &[Span]) -> Vec<(String, String, &'static str)> {
    let remarks = report.lines().flat_map(|line| &line.remarks);
    let bad = remarks.filter(|remark| remark.severity == Severity::Error).map(|remark| remark.span);
    let mut spans: Vec<(Span, &str)> = Vec::new();
    for (span, class) in
        bad.take(MOST_MARKS).map(|span| (span, "bad")).chain(lit.iter().map(|span| (*span, "lit")))
    {
        spans.insert(spans.partition_point(|(before, _)| before.from <= span.from), (span, class));
    }
    let mut end = 0;
    let mut pieces = Vec::new();
    for (span, class) in spans {
        // Of marks that overlap, the first is enough.
        let (Some(before), Some(marked)) = (text.get(end..span.from), text.get(span.from..span.to)) else {
            continue;
        };
        pieces.push((before.to_owned(), marked.to_owned(), class));
        end = span.to;
    }
    pieces
}

/// What is wrong in the text, each with a button to its place.
#[component]
fn Remarks(select: Callback<Span>) -> impl IntoView {
    /// More are not read by anybody.
    const SHOWN: usize = 5;
    let read = expect_context::<ReadState>();
    move || {
        let report = read.report();
        let mut remarks: Vec<&Remark> = Vec::new();
        for remark in report.lines().flat_map(|line| &line.remarks) {
            remarks.insert(remarks.partition_point(|before| before.span.from <= remark.span.from), remark);
        }
        let total = remarks.len();
        let items: Vec<_> = read.with_settled(|text| {
            let item = |remark: &&Remark| {
                let (line, column) = place(text, remark.span.from);
                let (class, span) =
                    (if remark.severity == Severity::Error { "bad" } else { "warn" }, remark.span);
                view! {
                    <li class=class>
                        <Icon glyph=Glyph::Warning />
                        <button type="button" class="link" on:click=move |_| select.run(span)>
                            {format!("Line {line}, character {column}")}
                        </button>
                        <span>{remark.message.sentence()} "."</span>
                    </li>
                }
            };
            remarks.iter().take(SHOWN).map(item).collect()
        });
        (total > 0).then(|| {
            let more = (total > SHOWN)
                .then(|| view! { <li class="more">{format!("and {} more", total - SHOWN)}</li> });
            view! { <ul class="remarks">{items} {more}</ul> }
        })
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

#[cfg(test)]
mod tests {
    use super::*;
    use buslens::tool::{Options, decode};

    #[test]
    fn units_of_the_browser_are_bytes_of_ours() {
        let text = "ä𝄞x";
        assert_eq!([0, 1, 3, 4, 9].map(|at| byte_offset(text, at)), [0, 2, 6, 7, 7]);
        assert_eq!(utf16_offset(text, 6), 3);
        assert_eq!(place("ab\ncä", 4), (2, 2));
    }

    #[test]
    fn marks_stand_in_order_and_never_overlap() {
        let text = "01 03 0G C8\n01 03 00 C8 00 03 84 35";
        let report = decode(text, Options::default());
        let pieces = pieces(text, &report, &report.telegrams[1].line.places);
        let whole: String = pieces.iter().map(|(before, marked, _)| format!("{before}{marked}")).collect();
        assert!(text.starts_with(&whole), "{whole}");
        assert!(pieces.iter().any(|(_, _, class)| *class == "bad"));
    }

    #[test]
    fn each_line_says_what_it_is() {
        let report = decode("01 03 00 C8 00 01 05 F4\n01 83 02 C0 F1", Options::default());
        let lines = said(&report);
        assert_eq!(lines.iter().map(|line| line.line).collect::<Vec<_>>(), [0, 1]);
        assert_eq!(lines[1].state, State::Refused);
    }
}

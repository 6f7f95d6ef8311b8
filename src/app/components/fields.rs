//! The tree of fields as a table. Groups open and close; a row and its bytes light each other up.

use std::sync::Arc;

use leptos::prelude::*;

use super::strip::role_class;
use crate::app::browser;
use crate::app::state::{Shown, State};
use crate::field::{Field, Severity, Span, hex};

/// A field as a row.
struct Row {
    depth: usize,
    /// The row of the group that it lies in.
    parent: Option<usize>,
    span: Span,
    group: bool,
    class: String,
    label: String,
    note: &'static str,
    bytes: String,
    value: String,
    meaning: String,
}

#[component]
pub fn Fields(shown: Arc<Shown>) -> impl IntoView {
    let state = State::here();
    let mut rows = Vec::new();
    for field in &shown.detail.fields {
        collect(field, 0, None, shown.bytes(), &mut rows);
    }
    let total = rows.len();
    let spans: Arc<[Span]> = rows.iter().map(|row| row.span).collect();
    let span_at =
        Arc::new(move |event: &web_sys::Event| browser::number_at(event, "data-field").map(|row| spans[row]));
    let (point, choose, focus) = (span_at.clone(), span_at.clone(), span_at);
    let closed = RwSignal::new(vec![false; total]);
    let parents: Arc<[Option<usize>]> = rows.iter().map(|row| row.parent).collect();
    let hidden = {
        let parents = parents.clone();
        move |row: usize| {
            closed.with(|closed| {
                std::iter::successors(parents[row], |parent| parents[*parent]).any(|parent| closed[parent])
            })
        }
    };
    let visible = {
        let hidden = hidden.clone();
        move |row: usize| !untrack(|| hidden(row))
    };
    let at = RwSignal::new(0);
    let go = move |event: web_sys::KeyboardEvent| {
        let Some(row) = browser::number_at(&event, "data-field") else { return };
        let to = match event.key().as_str() {
            "ArrowDown" => (row + 1..total).find(|row| visible(*row)),
            "ArrowUp" => (0..row).rev().find(|row| visible(*row)),
            "Home" => Some(0),
            "End" => (0..total).rev().find(|row| visible(*row)),
            "ArrowLeft" => {
                closed.update(|closed| closed[row] = true);
                parents[row]
            }
            "ArrowRight" => {
                closed.update(|closed| closed[row] = false);
                None
            }
            "Escape" => {
                state.chosen.set(None);
                None
            }
            _ => return,
        };
        event.prevent_default();
        if let Some(to) = to {
            browser::focus(&format!("field-{to}"));
        }
    };
    let rows: Vec<_> = rows
        .into_iter()
        .enumerate()
        .map(|(index, row)| {
            let hidden = hidden.clone();
            view_row(state, index, row, at, closed, move || hidden(index))
        })
        .collect();
    view! {
        <table
            class="fields"
            role="table"
            aria-label="Fields"
            on:pointerover=move |event| state.pointed.set(point(&event))
            on:click=move |event| {
                if let Some(span) = choose(&event) {
                    state.chosen.set(Some(span));
                }
            }
            on:focusin=move |event| {
                if let Some(row) = browser::number_at(&event, "data-field") {
                    at.set(row);
                    state.chosen.set(focus(&event));
                }
            }
            on:keydown=go
        >
            <thead role="rowgroup">
                <tr role="row">
                    <th role="columnheader" scope="col">"Field"</th>
                    <th role="columnheader" scope="col">"Bytes"</th>
                    <th role="columnheader" scope="col">"Value"</th>
                    <th role="columnheader" scope="col">"Meaning"</th>
                </tr>
            </thead>
            <tbody role="rowgroup">{rows}</tbody>
        </table>
    }
}

fn view_row(
    state: State,
    index: usize,
    row: Row,
    at: RwSignal<usize>,
    closed: RwSignal<Vec<bool>>,
    hidden: impl Fn() -> bool + Send + 'static,
) -> impl IntoView {
    let span = row.span;
    let lit = move || state.lit().is_some_and(|lit| lit == span && !span.is_empty());
    let open = move || !closed.with(|closed| closed[index]);
    let expanded = row.group.then_some(move || open().to_string());
    view! {
        <tr role="row" class=row.class class:lit=lit data-field=index hidden=hidden>
            <th role="rowheader" scope="row" style:padding-inline-start=format!("{}rem", 0.5 + 1.25 * row.depth as f32)>
                <button
                    type="button"
                    id=format!("field-{index}")
                    class="field"
                    class:group=row.group
                    title=row.note
                    tabindex=move || if at.get() == index { "0" } else { "-1" }
                    aria-expanded=expanded
                    on:click=move |_| {
                        if row.group {
                            closed.update(|closed| closed[index] = !closed[index]);
                        }
                    }
                >
                    {row.label}
                </button>
            </th>
            <td role="cell" class="bytes">{row.bytes}</td>
            <td role="cell" class="value">{row.value}</td>
            <td role="cell" class="meaning">{row.meaning}</td>
        </tr>
    }
}

fn collect(field: &Field, depth: usize, parent: Option<usize>, bytes: &[u8], rows: &mut Vec<Row>) {
    /// More bytes do not fit into the column; the strip shows them.
    const SHOWN: usize = 12;
    let span = field.span;
    let mut shown = hex(&span.of(bytes)[..span.len().min(SHOWN)]);
    if span.len() > SHOWN {
        shown.push_str(" …");
    }
    let faulty = field.problems.iter().any(|problem| problem.severity == Severity::Error);
    let group = !field.children.is_empty();
    let index = rows.len();
    rows.push(Row {
        depth,
        parent,
        span,
        group,
        class: format!("{}{}", role_class(field.spec.role), if faulty { " faulty" } else { "" }),
        label: field.label().to_string(),
        note: field.spec.note,
        bytes: shown,
        value: field.value_text(),
        meaning: field.meaning().map(|meaning| meaning.to_string()).unwrap_or_default(),
    });
    for child in &field.children {
        collect(child, depth + 1, Some(index), bytes, rows);
    }
}

//! The telegrams as files, and the printer.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use crate::app::browser;
use crate::app::state::State;
use buslens::tool::{Report, annotated, csv, json};

#[component]
pub fn Exports() -> impl IntoView {
    view! { <section class="card exports" aria-label="Export" inner_html=content().into_string()></section> }
}

/// A kind of file.
struct File {
    name: &'static str,
    label: &'static str,
    note: &'static str,
    write: fn(&Report) -> String,
}

const FILES: [File; 4] = [
    File {
        name: "telegrams.txt",
        label: "Text",
        note: "for a mail or a ticket: every telegram with its fields",
        write: annotated::text,
    },
    File {
        name: "telegrams.csv",
        label: "CSV",
        note: "for a spreadsheet: a row for each telegram",
        write: csv::table,
    },
    File {
        name: "telegrams.jsonl",
        label: "JSON Lines",
        note: "for programs: an object for each telegram",
        write: |report| json::lines(report, false).unwrap_or_default(),
    },
    File {
        name: "telegrams-with-fields.jsonl",
        label: "JSON Lines with fields",
        note: "the same with the tree of fields",
        write: |report| json::lines(report, true).unwrap_or_default(),
    },
];

fn content() -> Markup {
    html! {
        div.bar {
            h2 { "Print or export" }
            div.actions {
                button.quiet type="button" data-print="" { "Print" }
                a.quiet href="." { "Back to Decode" }
            }
        }
        ul.files {
            @for file in &FILES {
                li {
                    div { strong { (file.label) } ": " (file.note) }
                    div.actions {
                        button.quiet type="button" data-save=(file.name) { "Save" span.unseen { " " (file.label) } }
                        button.quiet type="button" data-clip=(file.name) { "Copy" span.unseen { " " (file.label) } }
                    }
                }
            }
        }
        label.title for="heading" { "Heading of the sheet, such as plant and customer" }
        input id="heading" autocomplete="off";
    }
}

pub fn hear(state: State, kind: &str, event: &Event) {
    if kind == "input" && browser::id(event) == "heading" {
        browser::set_text("plant", &browser::value(event));
    }
    if kind != "click" {
        return;
    }
    let file = |name: Option<String>| {
        let file = FILES.iter().find(|file| Some(file.name) == name.as_deref())?;
        Some((file, state.decoded.with_untracked(|decoded| (file.write)(&decoded.report))))
    };
    if browser::attribute(event, "data-print").is_some() {
        browser::print();
    } else if let Some((file, text)) = file(browser::attribute(event, "data-save")) {
        browser::download(file.name, &text);
    } else if let Some((file, text)) = file(browser::attribute(event, "data-clip")) {
        browser::copy(&text);
        browser::say(&format!("{} copied.", file.label));
    }
}

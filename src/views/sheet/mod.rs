//! Sheet: what is read, made for paper and as files.

mod paper;

use leptos::prelude::*;
use leptos::task::spawn_local;

use crate::browser::file;
use crate::components::copy_button::copy;
use crate::components::icon::{Glyph, Icon};
use crate::components::menu::{Menu, MenuItem};
use crate::components::segments::Segments;
use crate::components::toast::Toasts;
use crate::views::read::ReadState;
use buslens::tool::{Report, annotated, csv, json};
use paper::Paper;

/// What a person wants on the paper.
#[derive(Clone, Copy)]
pub struct SheetState {
    /// Such as plant and customer.
    title: RwSignal<String>,
    spelled_out: RwSignal<SpelledOut>,
}

/// Which telegrams are there field by field, behind the table of all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpelledOut {
    Wrong,
    All,
    None,
}

impl SheetState {
    pub fn new() -> Self {
        Self { title: RwSignal::new(String::new()), spelled_out: RwSignal::new(SpelledOut::All) }
    }
}

#[component]
pub fn Sheet() -> impl IntoView {
    let state = expect_context::<SheetState>();
    let read = expect_context::<ReadState>();
    let report = Signal::derive(move || read.report());
    let options = vec![
        (SpelledOut::All, "Every telegram".to_owned()),
        (SpelledOut::Wrong, "Only what is wrong".to_owned()),
        (SpelledOut::None, "No fields".to_owned()),
    ];
    view! {
        <div class="sheet">
            <section class="tools" aria-label="Print or export">
                <h2 class="unseen">"Print or export"</h2>
                <label class="title">
                    <span>"Title"</span>
                    <input
                        class="input"
                        placeholder="For example plant and customer"
                        autocomplete="off"
                        prop:value=state.title
                        on:input=move |event| state.title.set(event_target_value(&event))
                    />
                </label>
                <div class="choice">
                    <span aria-hidden="true">"Field by field"</span>
                    <Segments
                        label="Field by field"
                        options
                        value=state.spelled_out
                        on_choose=Callback::new(move |chosen| state.spelled_out.set(chosen))
                    />
                </div>
                <div class="actions">
                    <button
                        type="button"
                        class="button main"
                        on:click=move |_| {
                            // A browser that cannot print does nothing.
                            let _ = window().print();
                        }
                    >
                        <Icon glyph=Glyph::Print />
                        "Print"
                    </button>
                    <Exports report />
                    <a class="button plain" href="#/read">
                        <Icon glyph=Glyph::Back />
                        "Back to Read"
                    </a>
                </div>
            </section>
            <Paper report title=state.title spelled_out=state.spelled_out />
        </div>
    }
}

/// A kind of file.
struct File {
    name: &'static str,
    label: &'static str,
    write: fn(&Report) -> String,
}

static FILES: [File; 4] = [
    File { name: "telegrams.txt", label: "Text, for a mail or a ticket", write: annotated::text },
    File { name: "telegrams.csv", label: "CSV, for a spreadsheet", write: csv::table },
    File {
        name: "telegrams.jsonl",
        label: "JSON Lines, for programs",
        // Text and numbers always make JSON.
        write: |report| json::lines(report, false).unwrap_or_default(),
    },
    File {
        name: "telegrams-with-fields.jsonl",
        label: "JSON Lines with every field",
        write: |report| json::lines(report, true).unwrap_or_default(),
    },
];

/// The telegrams as files, to be saved or copied.
#[component]
fn Exports(report: Signal<std::sync::Arc<Report>>) -> impl IntoView {
    let toasts = expect_context::<Toasts>();
    let text = move |file: &File| report.with_untracked(|report| (file.write)(report));
    let save = move |file: &'static File| {
        let choose = Callback::new(move |()| file::save(file.name, &text(file)));
        view! { <MenuItem on_choose=choose>{file.label}</MenuItem> }
    };
    let take = move |file: &'static File| {
        let choose = Callback::new(move |()| {
            let text = text(file);
            spawn_local(async move {
                if copy(toasts, text).await {
                    toasts.say("Copied.");
                }
            });
        });
        view! { <MenuItem on_choose=choose>{file.label}</MenuItem> }
    };
    view! {
        <Menu label="Save as" glyph=Glyph::Save>
            {FILES.iter().map(save).collect_view()}
        </Menu>
        <Menu label="Copy as" glyph=Glyph::Copy>
            {FILES.iter().map(take).collect_view()}
        </Menu>
    }
}

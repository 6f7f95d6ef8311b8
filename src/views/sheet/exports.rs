//! The telegrams as files, to be saved or copied.

use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use web_sys::js_sys::{Array, Uint8Array};

use crate::browser::file;
use crate::components::copy_button::copy;
use crate::components::icon::Glyph;
use crate::components::menu::{Menu, MenuItem, MenuLink};
use crate::components::toast::Toasts;
use crate::views::outgoing::PassOn;
use crate::views::read::ReadState;
use crate::worker::messages::{Export, Passed, Request};
use buslens::tool::log::{CaptureFile, Hidden, Log, Reading};
use buslens::tool::{Report, annotated, csv, json};

/// A kind of file that is text.
struct File {
    name: &'static str,
    label: &'static str,
    write: fn(&Report) -> String,
}

static FILES: [File; 4] = [
    File { name: "telegrams.txt", label: "Text: every telegram with its fields", write: annotated::text },
    File { name: "telegrams.csv", label: "CSV: a row for each telegram", write: csv::table },
    File { name: "telegrams.jsonl", label: "JSON Lines", write: |report| json::lines(report, false) },
    File {
        name: "telegrams.jsonl",
        label: "JSON Lines with fields",
        write: |report| json::lines(report, true),
    },
];

/// A log is written by whoever reads it, telegrams here.
#[component]
pub fn Exports(report: Signal<Arc<Report>>, is_log: Memo<bool>) -> impl IntoView {
    let read = expect_context::<ReadState>();
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
    let of_log = move |kind: Export| {
        let save = Callback::new(move |()| read.log.export(kind));
        view! { <MenuItem on_choose=save>{kind.label()}</MenuItem> }
    };
    // The text as a log of its own.
    let as_log = move |what: &dyn Fn(&Log, &[u8])| {
        let text = read.with_settled(|text| text.as_bytes().to_vec());
        if let Ok(log) = Log::read(&text, &Reading::default(), untrack(|| read.options())) {
            what(&log, &text);
        }
    };
    let capture = Callback::new(move |()| {
        as_log(&|log, text| {
            let mut capture = CaptureFile::default();
            let all: Vec<usize> = (0..log.entries().len()).collect();
            let parts = [capture.begin(), capture.telegrams(log, &text, &all, &Default::default())];
            let parts: Array = parts.iter().map(|part| Uint8Array::from(part.as_slice())).collect();
            let (name, kind) = Export::Capture.file();
            if let Some(blob) = file::blob(&parts, kind) {
                file::save_blob(name, &blob);
            }
        });
    });
    let pass_on = RwSignal::new(false);
    let ask = Callback::new(move |hidden: Hidden| {
        if is_log.get_untracked() {
            return read.log.ask(Request::PassOn(hidden));
        }
        as_log(&|log, text| {
            let redacted = log.redacted(&text, text.len() as u64, &hidden);
            let blob = file::blob(&Array::of1(&Uint8Array::from(redacted.file.as_slice())), "text/plain");
            read.log.passed.set(blob.map(|blob| (Passed::of(redacted), blob)));
        });
    });
    let name = Signal::derive(move || read.file_name().unwrap_or_else(|| "telegrams".to_owned()));
    view! {
        <Menu label="Save as" glyph=Glyph::Save>
            {move || {
                if is_log.get() {
                    Export::FILES.map(of_log).into_iter().collect_view().into_any()
                } else {
                    view! {
                        {FILES.iter().map(save).collect_view()}
                        <MenuItem on_choose=capture>{Export::Capture.label()}</MenuItem>
                    }
                    .into_any()
                }
            }}
            <MenuItem on_choose=Callback::new(move |()| pass_on.set(true))>"A log to pass on"</MenuItem>
            <MenuLink href="#/learn?place=practice.read">"A task for learners"</MenuLink>
        </Menu>
        <Show when=move || !is_log.get()>
            <Menu label="Copy as" glyph=Glyph::Copy>
                {FILES.iter().map(take).collect_view()}
            </Menu>
        </Show>
        <PassOn open=pass_on name ask passed=read.log.passed />
    }
}

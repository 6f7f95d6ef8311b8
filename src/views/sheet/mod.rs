//! Sheet: what is read, made for paper and as files.

mod exports;
mod paper;

use std::sync::Arc;

use leptos::prelude::*;

use crate::components::icon::{Glyph, Icon};
use crate::components::segments::Segments;
use crate::later::{Later, Part};
use crate::views::outgoing::Summary;
use crate::views::read::{Mode, ReadState};
use crate::worker::messages::Request;
use buslens::tool::digest::Digest;
use exports::Exports;
use paper::Paper;

/// What a person wants on the paper.
#[derive(Clone, Copy)]
pub struct SheetState {
    /// Such as plant and customer.
    title: RwSignal<String>,
    /// `None` until a person says so.
    spelled_out: RwSignal<Option<SpelledOut>>,
}

/// Which telegrams are there field by field, behind the first page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpelledOut {
    Wrong,
    All,
    None,
}

impl SheetState {
    pub fn new() -> Self {
        Self { title: RwSignal::new(String::new()), spelled_out: RwSignal::new(None) }
    }
}

#[component]
pub fn Sheet() -> impl IntoView {
    /// More of them, field by field, nobody reads on paper.
    const FEW: usize = 10;
    let state = expect_context::<SheetState>();
    let read = expect_context::<ReadState>();
    let report = Signal::derive(move || read.report());
    let is_log = Memo::new(move |_| read.mode() == Mode::Log);
    let options = vec![
        (SpelledOut::All, "Every telegram".to_owned()),
        (SpelledOut::Wrong, "Only what is wrong".to_owned()),
        (SpelledOut::None, "No fields".to_owned()),
    ];
    let count = Memo::new(move |_| report.with(|report| report.telegrams.len()));
    let spelled_out = Signal::derive(move || {
        let usual = if count.get() <= FEW { SpelledOut::All } else { SpelledOut::Wrong };
        state.spelled_out.get().unwrap_or(usual)
    });
    // Of a log its reader knows, once it has read it.
    let later = expect_context::<Later>();
    Effect::new(move || {
        if is_log.get() {
            later.load(Part::Log);
        }
        if is_log.get() && read.log.overview.with(Option::is_some) {
            read.log.ask(Request::Digest);
        }
    });
    let digest = Memo::new(move |_| {
        let digest = match is_log.get() {
            true => (*read.log.digest.get()?).clone(),
            false => report.with(|report| report.digest()),
        };
        Some(Arc::new(Digest { title: read.file_name().unwrap_or_default(), ..digest }))
    });
    let summary = RwSignal::new(false);
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
                <Show when=move || count.get() != 0>
                    <div class="choice">
                        <span aria-hidden="true">"Field by field"</span>
                        <Segments
                            label="Field by field"
                            options=options.clone()
                            value=spelled_out
                            on_choose=Callback::new(move |chosen| state.spelled_out.set(Some(chosen)))
                        />
                    </div>
                </Show>
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
                    <button type="button" class="button" on:click=move |_| summary.set(true)>
                        <Icon glyph=Glyph::Mail />
                        "Copy summary for a mail"
                    </button>
                    <Exports report is_log />
                    <a class="button plain" href="#/read">
                        <Icon glyph=Glyph::Back />
                        "Back to Read"
                    </a>
                </div>
            </section>
            <Summary open=summary digest />
            <Paper report digest is_log=is_log.into() title=state.title spelled_out />
        </div>
    }
}

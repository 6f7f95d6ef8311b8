//! What the page is about. Everything shown follows from the signals here.

use std::sync::Arc;

use leptos::html::Textarea;
use leptos::prelude::*;

use crate::app::browser;
use crate::field::{Direction, Field, Span, leaves};
use crate::tool::{Detail, Options, Report, Telegram, decode};

/// The page's state: what was typed and chosen, and what follows from that.
#[derive(Clone, Copy)]
pub struct State {
    /// The input as it was typed.
    pub text: RwSignal<String>,
    /// Where it was typed.
    pub area: NodeRef<Textarea>,
    /// Who speaks, where a person said so.
    pub direction: RwSignal<Option<Direction>>,
    /// Index of the telegram that is shown, as far as there are so many.
    pub selected: RwSignal<usize>,
    /// The bytes under the pointer.
    pub pointed: RwSignal<Option<Span>>,
    /// The bytes chosen by tap, click or keyboard.
    pub chosen: RwSignal<Option<Span>>,
    pub report: Memo<Arc<Report>>,
    /// The telegram that is shown.
    pub shown: Memo<Option<Arc<Shown>>>,
}

/// A telegram with all its details.
#[derive(PartialEq)]
pub struct Shown {
    pub index: usize,
    /// How many telegrams there are.
    pub of: usize,
    pub telegram: Telegram,
    pub detail: Detail,
}

impl Shown {
    pub fn bytes(&self) -> &[u8] {
        &self.telegram.line.bytes
    }

    /// The leaves that hold bytes.
    pub fn leaves(&self) -> Vec<&Field> {
        let mut leaves = leaves(&self.detail.fields);
        leaves.retain(|leaf| !leaf.span.is_empty());
        leaves
    }
}

impl State {
    pub fn new() -> Self {
        let text = RwSignal::new(String::new());
        let direction = RwSignal::new(None);
        let selected = RwSignal::new(0);
        let pointed = RwSignal::new(None);
        let chosen = RwSignal::new(None);
        let report = Memo::new(move |_| {
            Arc::new(text.with(|text| decode(text, Options { direction: direction.get() })))
        });
        let shown = Memo::new(move |_| {
            report.with(|report| {
                let last = report.telegrams.len().checked_sub(1)?;
                let index = selected.get().min(last);
                let telegram = report.telegrams[index].clone();
                Some(Arc::new(Shown { index, of: last + 1, telegram, detail: report.detail(index)? }))
            })
        });
        // Other bytes: what was chosen among the old ones means nothing any more.
        Effect::new(move |_| {
            shown.track();
            pointed.set(None);
            chosen.set(None);
        });
        Self { text, area: NodeRef::new(), direction, selected, pointed, chosen, report, shown }
    }

    /// The page's state, from anywhere below the page.
    pub fn here() -> Self {
        expect_context()
    }

    /// The bytes that are lit up: those under the pointer, else those chosen.
    pub fn lit(&self) -> Option<Span> {
        self.pointed.get().or_else(|| self.chosen.get())
    }

    /// Puts `text` in place of the input; the browser's undo takes it back.
    pub fn load(&self, text: &str) {
        self.selected.set(0);
        self.direction.set(None);
        if let Some(area) = self.area.get_untracked() {
            browser::replace_undoably(&area, text);
        }
        self.text.set(text.to_owned());
    }
}

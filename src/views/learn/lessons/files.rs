//! Files: progress, and lessons of one's own.

use leptos::prelude::*;

use super::state::{MOST_MISTAKES, Refused};
use crate::browser::file;
use crate::components::icon::{Glyph, Icon};
use crate::components::open_file::OpenFile;
use crate::views::learn::LearnState;

#[component]
pub fn Files() -> impl IntoView {
    let state = expect_context::<LearnState>().lessons;
    let nothing = move || state.progress.with(|progress| progress.is_empty());
    view! {
        <section class="files" aria-label="Files">
            <p class="note">
                "Trainers write lessons of their own as plain text, or translate these: save one from its foot, change it, and open it here. "
                {move || state.not_kept.get().map(|why| why.sentence())}
            </p>
            <div class="actions">
                <OpenFile
                    label="Open a lesson or saved progress"
                    accept=".txt,text/plain"
                    on_open=Callback::new(move |file| state.open(file))
                />
                <button
                    type="button"
                    class="button"
                    disabled=move || nothing()
                    on:click=move |_| {
                        file::save("buslens-lessons.txt", &state.progress.with_untracked(|it| it.write()))
                    }
                >
                    <Icon glyph=Glyph::Save />
                    "Save my progress"
                </button>
                <button type="button" class="button" disabled=move || nothing() on:click=move |_| state.forget()>
                    <Icon glyph=Glyph::Undo />
                    "Begin anew"
                </button>
            </div>
        </section>
    }
}

/// Why a file is no lesson.
#[component]
pub fn Refusal() -> impl IntoView {
    let state = expect_context::<LearnState>().lessons;
    let shown = move |Refused { name, mistakes }: Refused| {
        let more = mistakes.len().saturating_sub(MOST_MISTAKES);
        let rows: Vec<_> = mistakes
            .into_iter()
            .take(MOST_MISTAKES)
            .map(|mistake| {
                view! {
                    <li>
                        <b>"Line " {mistake.line}</b>
                        <span>{mistake.said}</span>
                    </li>
                }
            })
            .collect();
        view! {
            <section class="mistakes" role="alert">
                <p>
                    <Icon glyph=Glyph::Warning />
                    <b>{name} " is not opened as a lesson yet."</b>
                    <button
                        type="button"
                        class="button low icon-only plain"
                        aria-label="Close"
                        on:click=move |_| state.refused.set(None)
                    >
                        <Icon glyph=Glyph::Close />
                    </button>
                </p>
                <ol>{rows}</ol>
                {(more > 0).then(|| view! { <p class="note">{format!("And {more} more.")}</p> })}
            </section>
        }
    };
    move || state.refused.get().map(shown)
}

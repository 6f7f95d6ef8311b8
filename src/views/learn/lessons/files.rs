//! Files: progress, and lessons of one's own.

use leptos::prelude::*;

use crate::browser::file;
use crate::components::button::Button;
use crate::components::icon::Glyph;
use crate::components::open_file::OpenFile;
use crate::views::learn::LearnState;
use crate::views::learn::mistakes::Mistakes;

#[component]
pub fn Files() -> impl IntoView {
    let state = expect_context::<LearnState>().lessons;
    let nothing = Signal::derive(move || state.progress.with(|progress| progress.is_empty()));
    let save = move |()| file::save("buslens-lessons.txt", &state.progress.with_untracked(|it| it.write()));
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
                <Button glyph=Glyph::Save label="Save my progress" disabled=nothing on_press=save />
                <Button glyph=Glyph::Undo label="Begin anew" disabled=nothing on_press=move |()| state.forget() />
            </div>
        </section>
    }
}

/// Why a file is no lesson.
#[component]
pub fn Refusal() -> impl IntoView {
    let refused = expect_context::<LearnState>().lessons.refused;
    let on_close = Callback::new(move |()| refused.set(None));
    move || refused.get().map(|refused| view! { <Mistakes refused on_close /> })
}

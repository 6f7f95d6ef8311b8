//! Lessons: one idea a step, lit in real telegrams, with something to do.

mod contents;
mod exercise;
mod files;
mod line;
mod log;
mod sides;
mod state;
mod step;
mod switches;
mod walk;
mod words;

use leptos::prelude::*;

use super::{LearnState, Part};
use contents::{Contents, Overview};
use exercise::Exercise;
use files::Refusal;
use state::Here;
pub use state::LessonsState;
use step::StepText;

#[component]
pub fn Lessons() -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let state = learn.lessons;
    let place = Memo::new(move |_| learn.place(Part::Lessons));
    let shown = move || match state.find(&place.get()) {
        Some(here) => view! { <Open here /> }.into_any(),
        None => view! { <Overview /> }.into_any(),
    };
    view! {
        <section class="lessons" aria-label="Lessons">
            <Refusal />
            {shown}
        </section>
    }
}

/// A lesson: the list of all, the step, and its task.
#[component]
fn Open(here: Here) -> impl IntoView {
    view! {
        <div class="lesson">
            <Contents here=here.clone() />
            <StepText here=here.clone() />
            <Exercise here />
        </div>
    }
}

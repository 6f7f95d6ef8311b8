//! Lessons: one idea a step, lit in real telegrams, with something to do.

mod contents;
mod exercise;
mod files;
mod line;
mod log;
mod onward;
mod sides;
mod state;
mod step;
mod switches;
mod walk;

use leptos::prelude::*;

use super::{LearnState, Part};
use crate::components::roving;
use contents::{Contents, Overview};
use exercise::Exercise;
use files::Refusal;
use onward::Around;
use state::Here;
pub use state::LessonsState;
use step::StepText;

#[component]
pub fn Lessons() -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let state = learn.lessons;
    let place = Memo::new(move |_| learn.place(Part::Lessons));
    // Another step begins at its top, also for who reads with the ears.
    Effect::new(move |before: Option<()>| {
        place.track();
        if before.is_some() {
            request_animation_frame(|| {
                window().scroll_to_with_x_and_y(0.0, 0.0);
                if let Some(body) = document().body() {
                    roving::focus(&body, ".lessons h2", 0);
                }
            });
        }
    });
    let shown = move || match state.find(&place.get()) {
        Some(here) => view! { <Open here /> }.into_any(),
        None => view! { <Overview /> }.into_any(),
    };
    view! {
        <section class="lessons" aria-label="Lessons">
            <Refusal />
            {move || shown()}
        </section>
    }
}

/// A lesson: the list of all, the step, and its task.
#[component]
fn Open(here: Here) -> impl IntoView {
    // Without anything lit, the task is what the step is about.
    let bare = here.step().is_some_and(|step| step.telegrams.is_empty() && step.log.is_empty());
    view! {
        <div class="lesson" class:bare=bare>
            <Contents here=here.clone() />
            <StepText here=here.clone() />
            <Exercise here=here.clone() />
            <Around here />
        </div>
    }
}

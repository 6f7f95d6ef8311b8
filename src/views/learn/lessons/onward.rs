//! The ways on from a step: to the next one, back, past its task, and the lesson as a file.

use leptos::prelude::*;

use super::state::{Here, link_to};
use crate::browser::file;
use crate::components::button::{Button, ButtonLink};
use crate::components::icon::Glyph;
use crate::views::learn::LearnState;

/// A link that looks like a button: the one way on, or one of several.
pub fn way(to: String, main: bool, label: String) -> AnyView {
    let class = if main { "button main" } else { "button" };
    view! { <ButtonLink class glyph=Glyph::Forward label to /> }.into_any()
}

/// To the next step, or to the next lesson.
#[component]
pub fn Onward(here: Here) -> impl IntoView {
    let state = expect_context::<LearnState>().lessons;
    let lesson = here.course.lesson;
    if here.step + 1 < lesson.steps.len() {
        return way(link_to(&lesson, here.step + 1), true, "Next step".to_owned());
    }
    let all = untrack(|| state.courses());
    let next = all.iter().skip_while(|it| it.lesson.key != lesson.key).nth(1);
    let on = match next {
        Some(next) => way(link_to(&next.lesson, 0), true, format!("Next lesson: {}", next.lesson.title)),
        None => way("#/learn?place=lessons".to_owned(), false, "All lessons".to_owned()),
    };
    view! {
        <p>{format!("That was “{}”.", lesson.title)}</p>
        {on}
    }
    .into_any()
}

/// Back, past the task, and the lesson as a file.
#[component]
pub fn Around(here: Here) -> impl IntoView {
    let course = here.course;
    let lesson = course.lesson.clone();
    let back = here
        .step
        .checked_sub(1)
        .map(|step| view! { <ButtonLink glyph=Glyph::Back label="Back" to=link_to(&lesson, step) /> });
    let next = (here.step + 1 < lesson.steps.len())
        .then(|| way(link_to(&lesson, here.step + 1), false, "Skip this task".to_owned()));
    let save = move |()| file::save(&format!("{}.txt", course.lesson.key), &course.text);
    view! {
        <footer class="around">
            {back} {next}
            <Button class="button plain low" glyph=Glyph::Save label="Save this lesson as a file" on_press=save />
        </footer>
    }
}

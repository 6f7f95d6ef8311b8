//! The list of lessons: beside a step, and as the first page.

use leptos::prelude::*;

use super::files::Files;
use super::onward::way;
use super::state::{Course, Here, LessonsState, link_to};
use crate::components::button::Button;
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;

fn state() -> LessonsState {
    expect_context::<LearnState>().lessons
}

/// The lessons under their groups, both in their order, each as `entry` draws it.
fn groups(state: LessonsState, entry: &dyn Fn(usize, Course) -> AnyView) -> Vec<AnyView> {
    let mut groups: Vec<(String, Vec<AnyView>)> = Vec::new();
    for (course, number) in state.courses().into_iter().zip(1..) {
        let name = match course.lesson.group.as_str() {
            "" => "Your own".to_owned(),
            group => group.to_owned(),
        };
        let entry = entry(number, course);
        match groups.iter_mut().find(|(group, _)| *group == name) {
            Some((_, entries)) => entries.push(entry),
            None => groups.push((name, vec![entry])),
        }
    }
    let group = |(name, entries): (String, Vec<AnyView>)| {
        view! {
            <section>
                <h3>{name}</h3>
                <ol>{entries}</ol>
            </section>
        }
    };
    groups.into_iter().map(|it| group(it).into_any()).collect()
}

/// The number of a lesson, or a tick where it is done.
#[component]
fn Sign(number: usize, course: Course) -> impl IntoView {
    let state = state();
    let done = Memo::new(move |_| state.count(&course.lesson) == course.lesson.steps.len());
    view! {
        <span class="sign" class:done=move || done.get()>
            {move || {
                if done.get() {
                    view! {
                        <Icon glyph=Glyph::Tick />
                        <span class="unseen">"Done: "</span>
                    }
                        .into_any()
                } else {
                    view! { {number} }.into_any()
                }
            }}
        </span>
    }
}

/// All lessons, beside the one that is open. Where there is no room for them, "Lessons" leads to the first page.
#[component]
pub fn Contents(here: Here) -> impl IntoView {
    let state = state();
    let open = here.course.lesson.key.clone();
    let entry = move |number: usize, course: Course| {
        let here = (course.lesson.key == open).then_some("page");
        let to = link_to(&course.lesson, untrack(|| state.next(&course.lesson)));
        let title = course.lesson.title.clone();
        view! {
            <li>
                <a href=to aria-current=here>
                    <Sign number course />
                    {title}
                </a>
            </li>
        }
        .into_any()
    };
    view! {
        <nav class="contents" aria-label="All lessons">
            {move || groups(state, &entry)}
        </nav>
    }
}

/// The first page.
#[component]
pub fn Overview() -> impl IntoView {
    let state = state();
    let all = move || state.courses();
    let steps = move || {
        let all = all();
        let done: usize = all.iter().map(|course| state.count(&course.lesson)).sum();
        (done, all.iter().map(|course| course.lesson.steps.len()).sum::<usize>())
    };
    // Who comes for the first time begins at the beginning; others go on.
    let go_on = move || {
        let all = all();
        let unfinished = |course: &&Course| state.count(&course.lesson) < course.lesson.steps.len();
        let begun = all.iter().filter(unfinished).find(|course| state.count(&course.lesson) > 0);
        let next = begun.or_else(|| all.iter().find(unfinished)).cloned()?;
        let step = state.next(&next.lesson);
        let label = if steps().0 == 0 { "Begin with" } else { "Go on with" };
        Some(way(link_to(&next.lesson, step), true, format!("{label} “{}”", next.lesson.title)))
    };
    let so_far = move || match steps() {
        (0, _) => {
            "Take them in any order; each lasts a few minutes. All you do stays in this browser.".to_owned()
        }
        (done, all) if done == all => format!("All {all} steps are done."),
        (done, all) => format!("{done} of {all} steps are done."),
    };
    let entry = move |number: usize, course: Course| {
        let lesson = course.lesson.clone();
        let to = link_to(&lesson, untrack(|| state.next(&lesson)));
        let (title, about) = (lesson.title.clone(), lesson.about.clone());
        let removable = course.own.then(|| {
            let course = course.clone();
            view! {
                <Button
                    class="button low plain icon-only"
                    glyph=Glyph::Close
                    label=format!("Remove “{title}”")
                    on_press=move |()| state.remove(&course)
                />
            }
        });
        let far = move || match (state.count(&lesson), lesson.steps.len()) {
            (0, _) => format!("{} min", lesson.minutes.max(1)),
            (done, steps) if done == steps => "done".to_owned(),
            (done, steps) => format!("{done} of {steps}"),
        };
        view! {
            <li>
                <a href=to>
                    <Sign number course />
                    <b>{title}</b>
                    <span class="about">{about}</span>
                    <span class="far">{move || far()}</span>
                </a>
                {removable}
            </li>
        }
        .into_any()
    };
    view! {
        <div class="overview">
            <header>
                <h2 tabindex="-1">"Field buses, byte by byte"</h2>
                <p>
                    "Short lessons on real telegrams. In each you first look, then fill in, then build, then mend one that is damaged. "
                    {move || so_far()}
                </p>
                {move || go_on()}
            </header>
            {move || groups(state, &entry)}
            <Files />
        </div>
    }
}

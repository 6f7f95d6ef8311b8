//! Practice: tasks without end, made from a seed, and sets of tasks that somebody prepared.

mod bar;
mod done;
mod given;
mod paper;
mod parts;
mod prepare;
mod question;
mod results;
mod series;
mod start;
mod state;
mod wall;

use leptos::ev::DragEvent;
use leptos::prelude::*;
use leptos::task::spawn_local;
use web_sys::File;

use super::LearnState;
use super::state::Part;
use crate::browser::file;
use buslens_trainer::practice::NoRound;
use series::{Shared, Source};
pub use state::PracticeState;
use state::{LONGEST_FILE, Screen, Where};

#[component]
pub fn Practice() -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let place = Memo::new(move |_| learn.place(Part::Practice));
    let shown = move || match Where::of(&place.get()) {
        Ok(Where::Start) => start::start(""),
        Ok(Where::Prepare) => prepare::prepare(false),
        Ok(Where::FromRead) => prepare::prepare(true),
        Ok(Where::Results) => results::results(),
        Ok(Where::In(source, screen)) => match learn.practice.series(&source) {
            Some(series) => screen_of(series, screen),
            None if matches!(source, Source::Set(_)) => start::start(
                "This link is to a set of tasks that is too large for a link: open its file first, then the link.",
            ),
            None => start::start(DAMAGED),
        },
        Err(NoRound::Newer) => {
            start::start("This link is of a newer version of the page: reload the page, and open it again.")
        }
        Err(NoRound::Damaged) => start::start(DAMAGED),
    };
    // A set is opened; anything else may become a task.
    let dropped = move |event: DragEvent| {
        let dropped = event.data_transfer().and_then(|data| parts::files(data.files()).next());
        let Some(dropped) = dropped else { return };
        event.prevent_default();
        event.stop_propagation();
        open_file(learn, dropped, true);
    };
    view! {
        <section class="practice" aria-label="Practice" on:drop=dropped>
            {move || shown()}
        </section>
    }
}

const DAMAGED: &str = "This link is incomplete or damaged. Ask for it again, or begin a round here.";

fn screen_of(series: Shared, screen: Screen) -> AnyView {
    let last = series.tasks.len().saturating_sub(1);
    match screen {
        Screen::Question(index) => question::question(series, index.min(last)),
        Screen::Done => done::done(series),
        Screen::Paper => paper::paper(series),
        Screen::Wall(index) => wall::wall(series, index.min(last)),
    }
}

/// Goes elsewhere in Practice.
fn go(learn: LearnState, to: Where) {
    learn.practice.moved.set_value(true);
    learn.go_to(Part::Practice, to.place());
}

/// Opens a file with a set. What is none may become a task, where `of_own`.
fn open_file(learn: LearnState, opened: File, of_own: bool) {
    spawn_local(async move {
        match file::text(&opened, LONGEST_FILE).await {
            Ok(text) if of_own && !text.trim_start_matches('\u{feff}').trim_start().starts_with("# ") => {
                learn.practice.own.set(text);
                go(learn, Where::Prepare);
            }
            Ok(text) => open_text(learn, &opened.name(), &text),
            Err(why) => learn.practice.say(why.sentence()),
        }
    });
}

/// Opens the text of a set, and shows its first task.
fn open_text(learn: LearnState, name: &str, text: &str) {
    match learn.practice.open_text(name, text) {
        Some(source) => go(learn, Where::In(source, Screen::Question(0))),
        // What is wrong with it is said there.
        None => go(learn, Where::Start),
    }
}

//! Practice: tasks without end, made from a seed.

mod given;
mod paper;
mod question;
mod results;
mod start;
mod state;
mod wall;

use leptos::prelude::*;

use super::LearnState;
use super::state::Part;
use buslens_trainer::practice::NoRound;
use paper::Paper;
use question::{Done, Question};
use results::Results;
use start::Start;
pub use state::PracticeState;
use state::Where;
use wall::Wall;

#[component]
pub fn Practice() -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let place = Memo::new(move |_| learn.place(Part::Practice));
    let shown = move || match Where::of(&place.get()) {
        Ok(Where::Start) => view! { <Start refused="" /> }.into_any(),
        Ok(Where::Question(round, index)) => view! { <Question round index /> }.into_any(),
        Ok(Where::Done(round)) => view! { <Done round /> }.into_any(),
        Ok(Where::Paper(round)) => view! { <Paper round /> }.into_any(),
        Ok(Where::Wall(round, index)) => view! { <Wall round index /> }.into_any(),
        Ok(Where::Results) => view! { <Results /> }.into_any(),
        Err(NoRound::Newer) => {
            let refused = "This link is of a newer version of the page: reload the page, and open it again.";
            view! { <Start refused /> }.into_any()
        }
        Err(NoRound::Damaged) => {
            let refused =
                "This link to a round is incomplete or damaged. Ask for it again, or begin a round here.";
            view! { <Start refused /> }.into_any()
        }
    };
    view! {
        <section class="practice" aria-label="Practice">
            {shown}
        </section>
    }
}

/// Goes elsewhere in Practice.
fn go(learn: LearnState, to: Where) {
    learn.practice.moved.set_value(true);
    learn.go_to(Part::Practice, to.place());
}

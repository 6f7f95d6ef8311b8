//! Learn: lessons, tasks without end, and everything to look up, on the components of the other views.

mod answer;
mod attempt;
mod gallery;
mod lessons;
mod mistakes;
mod practice;
mod reference;
mod search;
mod state;
mod words;

use leptos::prelude::*;

use crate::components::segments::Segments;
use gallery::Gallery;
use lessons::Lessons;
use practice::Practice;
use reference::Reference;
pub use state::LearnState;
use state::Part;

#[component]
pub fn Learn() -> impl IntoView {
    let state = expect_context::<LearnState>();
    let parts = Part::ALL.map(|part| (part, part.label().to_owned())).to_vec();
    let part = Signal::derive(move || state.part());
    let shown = move || match part.get() {
        Part::Lessons => view! { <Lessons /> }.into_any(),
        Part::Practice => view! { <Practice /> }.into_any(),
        Part::Gallery => view! { <Gallery /> }.into_any(),
        Part::Reference => view! { <Reference /> }.into_any(),
    };
    view! {
        <div class="learn">
            <h2 class="unseen">"Learn"</h2>
            <Segments label="Part of Learn" options=parts value=part on_choose=Callback::new(move |part| state.turn_to(part)) />
            {move || shown()}
        </div>
    }
}

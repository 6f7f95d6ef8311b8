//! Which round or set this is, its tasks, and what can be done with it.

use leptos::prelude::*;

use super::go;
use super::parts::{button, to_start};
use super::series::Shared;
use super::state::{Screen, Where};
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;
use crate::views::learn::attempt::Outcome;

/// `index` is the task that is shown, if one is.
pub fn bar(series: &Shared, index: Option<usize>) -> AnyView {
    let learn = expect_context::<LearnState>();
    let counted = series.clone();
    let outcomes = Memo::new(move |_| learn.practice.outcomes(&counted));
    let to = {
        let source = series.source.clone();
        move |screen| go(learn, Where::In(source.clone(), screen))
    };
    let (wall, paper) = (to.clone(), to.clone());
    let dot = |at: usize| {
        let to = to.clone();
        let outcome = Memo::new(move |_| outcomes.with(|all| all.get(at).copied().unwrap_or_default()));
        let class = move || match outcome.get() {
            Outcome::Open => "dot",
            Outcome::First => "dot good",
            Outcome::Later => "dot good late",
            Outcome::Shown => "dot shown",
        };
        let ticked = move || matches!(outcome.get(), Outcome::First | Outcome::Later);
        view! {
            <li>
                <button
                    type="button"
                    class=move || class()
                    aria-label=move || format!("Question {}, {}", at + 1, outcome.get().words())
                    aria-current=(index == Some(at)).then_some("step")
                    on:click=move |_| to(Screen::Question(at))
                >
                    {move || ticked().then(|| view! { <Icon glyph=Glyph::Tick /> })}
                    {move || (!ticked()).then_some(at + 1)}
                </button>
            </li>
        }
    };
    let dots = (series.tasks.len() > 1).then(|| (0..series.tasks.len()).map(dot).collect::<Vec<_>>());
    let seed = series.seed.map(|seed| view! { <code>{seed.to_string()}</code> });
    view! {
        <nav class="round" aria-label="This round">
            {to_start(learn)}
            <p>
                <strong>{series.title.clone()}</strong>
                {series.level.clone()}
                <span class="soft">{seed.is_some().then_some(" seed ")} {seed}</span>
            </p>
            <ol>{dots}</ol>
            <div class="acts">
                {button("button plain low", None, "On the wall", move || wall(Screen::Wall(index.unwrap_or(0))))}
                {button("button plain low", Glyph::Print, "Handout", move || paper(Screen::Paper))}
            </div>
        </nav>
    }
    .into_any()
}

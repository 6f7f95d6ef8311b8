//! Which round or set this is, its tasks, and what can be done with it.

use leptos::prelude::*;

use super::go;
use super::parts::to_start;
use super::series::Shared;
use super::state::{Screen, Where};
use crate::components::button::Button;
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;
use crate::views::learn::attempt::Outcome;

/// `index` is the task that is shown, if one is.
pub fn bar(series: &Shared, index: Option<usize>) -> AnyView {
    let learn = expect_context::<LearnState>();
    let counted = series.clone();
    let outcomes = Memo::new(move |_| learn.practice.outcomes(&counted));
    let source = series.source.clone();
    let to = Callback::new(move |screen| go(learn, Where::In(source.clone(), screen)));
    let wall = move |()| to.run(Screen::Wall(index.unwrap_or(0)));
    let paper = move |()| to.run(Screen::Paper);
    let dot = |at: usize| {
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
                    class=class
                    aria-label=move || format!("Question {}, {}", at + 1, outcome.get().words())
                    aria-current=(index == Some(at)).then_some("step")
                    on:click=move |_| to.run(Screen::Question(at))
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
                <Button class="button plain low" label="On the wall" on_press=wall />
                <Button class="button plain low" glyph=Glyph::Print label="Handout" on_press=paper />
            </div>
        </nav>
    }
    .into_any()
}

//! What came of a round or a set.

use leptos::prelude::*;

use super::bar::bar;
use super::go;
use super::series::{Shared, Source};
use super::state::{Screen, Where};
use crate::browser::file;
use crate::components::button::Button;
use crate::components::copy_button::CopyButton;
use crate::components::icon::Glyph;
use crate::views::learn::LearnState;
use crate::views::learn::attempt::Outcome;
use buslens_trainer::practice::{LEVELS, Round};
use buslens_trainer::result::RoundResult;

pub fn done(series: Shared) -> AnyView {
    let learn = expect_context::<LearnState>();
    let state = learn.practice;
    let all = series.tasks.len();
    let counted = series.clone();
    let outcomes = Memo::new(move |_| state.outcomes(&counted));
    let count = move |wanted: Outcome| outcomes.with(|all| all.iter().filter(|it| **it == wanted).count());
    let right = move || count(Outcome::First);
    let headline = Signal::derive(move || match (count(Outcome::Open), right()) {
        (0, right) if right == all => format!("All {all} right at the first answer."),
        (0, right) => format!("{right} of {all} right at the first answer."),
        (open, _) => format!("{} of {all} answered so far.", all - open),
    });
    let more = Signal::derive(move || match count(Outcome::Later) {
        0 => String::new(),
        1 => "One more came right after another try.".to_owned(),
        later => format!("{later} more came right after another try."),
    });
    let result = series.result();
    let code = Signal::derive(move || {
        result.map_or(String::new(), |about| RoundResult { about, right: right() }.code())
    });
    let save = {
        let named = match series.seed {
            Some(seed) => format!("{}, seed {seed}", series.name()),
            None => series.name(),
        };
        Callback::new(move |()| {
            let code = code.get_untracked();
            let text = format!("# {named}: {} of {all}\n{code}\n", untrack(right));
            file::save(&format!("buslens-{code}.txt"), &text);
        })
    };
    let coded = move || {
        (result.is_some() && count(Outcome::Open) == 0).then(|| {
            view! {
                <div class="code">
                    <p>"Your result as a code, for your trainer"</p>
                    <output>{code}</output>
                    <div class="acts">
                        <CopyButton text=code label="Copy" />
                        <Button glyph=Glyph::Save label="Save as a file" on_press=save />
                    </div>
                </div>
            }
            .into_any()
        })
    };
    let first = move |round: Round| go(learn, Where::In(Source::Round(round), Screen::Question(0)));
    let onward = match series.source {
        Source::Round(round) => {
            let next = Round { seed: round.seed.next(), ..round };
            let harder = Round { level: round.level + 1, ..next };
            let label = format!("On to level {}", harder.level);
            let harder = (round.level < *LEVELS.end())
                .then(|| view! { <Button label on_press=move |()| first(harder) /> });
            view! {
                <Button class="button main" glyph=Glyph::Forward label="Another round" on_press=move |()| first(next) />
                {harder}
            }
            .into_any()
        }
        _ => {
            let start = move |()| go(learn, Where::Start);
            view! { <Button class="button main" label="To all kinds" on_press=start /> }.into_any()
        }
    };
    let source = series.source.clone();
    let again = move |()| {
        state.forget(&source);
        go(learn, Where::In(source.clone(), Screen::Question(0)));
    };
    view! {
        {bar(&series, None)}
        <article class="done">
            <h3 class="headline">{headline}</h3>
            <p class="intro">{more}</p>
            {move || coded()}
            <div class="steps">{onward} <Button class="button plain" glyph=Glyph::Undo label="The same once more" on_press=again /></div>
        </article>
    }
    .into_any()
}

//! What there is to practise.

use std::sync::Arc;

use leptos::prelude::*;
use web_sys::js_sys::Math;

use super::series::{Series, Source};
use super::state::{Screen, Where};
use super::{go, open_file};
use crate::components::button::Button;
use crate::components::icon::{Glyph, Icon};
use crate::components::open_file::OpenFile;
use crate::views::learn::LearnState;
use crate::views::learn::mistakes::Mistakes;
use buslens::field::count;
use buslens_trainer::practice::{Kind, LEVELS, QUESTIONS, Round, Seed};

/// A seed by chance.
pub fn any_seed() -> Seed {
    Seed::new((Math::random() * f64::from(Seed::COUNT)) as u64)
}

/// `refused` says why a link is not followed; it may be empty.
pub fn start(refused: &'static str) -> AnyView {
    let learn = expect_context::<LearnState>();
    let state = learn.practice;
    let typed = RwSignal::new(String::new());
    let seed = Memo::new(move |_| typed.with(|typed| Seed::of(typed)));
    let misfit = move || typed.with(|typed| !typed.trim().is_empty()) && seed.get().is_none();
    let begin = Callback::new(move |(kind, level)| {
        if !untrack(misfit) {
            let seed = seed.get_untracked().unwrap_or_else(any_seed);
            go(learn, Where::In(Source::Round(Round { kind, level, seed }), Screen::Question(0)));
        }
    });
    let kinds = Kind::ALL.map(|kind| kind_card(learn, kind, begin)).into_iter().collect_view();
    let wrong = move || state.refused.get().map(|refused| view! { <Mistakes refused /> });
    let sets = move || {
        let all: Vec<AnyView> = state.sets.get().into_iter().map(|text| set_card(learn, text)).collect();
        (!all.is_empty()).then(|| {
            view! {
                <section class="sets">
                    <h3>"Sets that were opened here"</h3>
                    <ul>{all}</ul>
                </section>
            }
            .into_any()
        })
    };
    let seed_note = move || match misfit() {
        true => "A seed has four letters or digits, without I, L, O and U.",
        false => "The same seed asks the same questions.",
    };
    view! {
        {(!refused.is_empty()).then(|| view! { <p class="refused" role="alert">{refused}</p> })}
        {move || wrong()}
        <header class="start">
            <div>
                <h3 class="headline">"Practice"</h3>
                <p class="intro">
                    {format!(
                        "Questions without end about the telegrams that Buslens knows, {QUESTIONS} in a round. Each has three hints, and a wrong answer is told what is off.",
                    )}
                </p>
            </div>
            <label class="seed">
                <span>"Seed, if you were given one"</span>
                <input
                    class="input mono"
                    maxlength="6"
                    autocomplete="off"
                    spellcheck="false"
                    placeholder="any"
                    aria-invalid=move || misfit().to_string()
                    aria-describedby="seed-note"
                    prop:value=typed
                    on:input=move |event| typed.set(event_target_value(&event))
                />
                <span class="note" id="seed-note">{move || seed_note()}</span>
            </label>
        </header>
        {move || sets()}
        <ul class="kind-cards">{kinds}</ul>
        <section class="trainers">
            <h3>"For trainers"</h3>
            <p>
                "Begin a round to get its link: it asks the same questions on every machine. In the round you can print a handout with its answer key, put it on the wall, or take it as a file for Moodle. Two seeds of a level are equally hard. A set has the tasks that you choose, and telegrams and logs of your own plant among them."
            </p>
            <div class="acts">
                <Button glyph=Glyph::Edit label="Prepare a set of tasks" on_press=move |()| go(learn, Where::Prepare) />
                <OpenFile label="Open a set" accept=".txt,text/plain" on_open=Callback::new(move |file| open_file(learn, file, false)) />
                <Button glyph=Glyph::Tick label="Results of a group" on_press=move |()| go(learn, Where::Results) />
            </div>
        </section>
    }
    .into_any()
}

/// A set that was opened before.
fn set_card(learn: LearnState, text: Arc<str>) -> AnyView {
    let series = Series::of_set(&text);
    let (title, tasks, source) = (series.title, series.tasks.len(), series.source);
    let own = source.clone();
    let done = learn.practice.answered(move |other| *other == own);
    let about = match done {
        0 => count(tasks, "question").to_string(),
        done => format!("{done} of {} answered", count(tasks, "question")),
    };
    let remove = format!("Remove {title}");
    view! {
        <li>
            <button
                type="button"
                class="level"
                on:click=move |_| go(learn, Where::In(source.clone(), Screen::Question(0)))
            >
                <strong>{title}</strong>
                <span>{about}</span>
                <Icon glyph=Glyph::ChevronRight />
            </button>
            <Button class="button plain icon-only" glyph=Glyph::Close label=remove on_press=move |()| learn.practice.remove(&text) />
        </li>
    }
    .into_any()
}

fn kind_card(learn: LearnState, kind: Kind, begin: Callback<(Kind, u8)>) -> AnyView {
    let level = |level: u8| {
        let of_level = move |source: &Source| matches!(source, Source::Round(it) if (it.kind, it.level) == (kind, level));
        let answered = learn.practice.answered(of_level);
        let answered = (answered > 0)
            .then(|| view! { <small>{format!("{} answered", count(answered, "question"))}</small> });
        view! {
            <li>
                <button type="button" class="level" on:click=move |_| begin.run((kind, level))>
                    <strong>{format!("Level {level}")}</strong>
                    <span>{kind.level_note(level)}</span>
                    {answered}
                    <Icon glyph=Glyph::ChevronRight />
                </button>
            </li>
        }
    };
    view! {
        <li>
            <article class="kind-card">
                <h3>{kind.label()}</h3>
                <p>{kind.note()}</p>
                <ol>{LEVELS.map(level).collect_view()}</ol>
            </article>
        </li>
    }
    .into_any()
}

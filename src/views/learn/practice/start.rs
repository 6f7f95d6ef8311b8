//! What there is to practise.

use leptos::prelude::*;
use web_sys::js_sys::Math;

use super::go;
use super::own::OWN;
use super::state::Where;
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;
use crate::views::learn::state::Part;
use buslens::field::count;
use buslens_trainer::practice::{Kind, LEVELS, QUESTIONS, Round, Seed};

/// A seed by chance.
pub fn any_seed() -> Seed {
    Seed::new((Math::random() * f64::from(Seed::COUNT)) as u64)
}

#[component]
pub fn Start(
    /// Why a link is not followed; may be empty.
    refused: &'static str,
) -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let typed = RwSignal::new(String::new());
    let seed = Memo::new(move |_| typed.with(|typed| Seed::of(typed)));
    let misfit = move || typed.with(|typed| !typed.trim().is_empty()) && seed.get().is_none();
    let begin = move |kind, level| {
        if misfit() {
            return;
        }
        let seed = seed.get_untracked().unwrap_or_else(any_seed);
        go(learn, Where::Question(Round { kind, level, seed }, 0));
    };
    let kinds = Kind::ALL
        .map(|kind| view! { <KindCard kind begin=Callback::new(move |level| begin(kind, level)) /> });
    view! {
        {(!refused.is_empty()).then(|| view! { <p class="refused" role="alert">{refused}</p> })}
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
                <span class="note" id="seed-note">
                    {move || {
                        if misfit() {
                            "A seed has four letters or digits, without I, L, O and U."
                        } else {
                            "The same seed asks the same questions."
                        }
                    }}
                </span>
            </label>
        </header>
        <ul class="kind-cards">{kinds.map(|kind| view! { <li>{kind}</li> }).collect_view()}</ul>
        <section class="trainers">
            <h3>"For trainers"</h3>
            <p>
                "Begin a round to get its link: it asks the same questions on every machine. In the round you can print a handout with its answer key, put it on the wall, or take it as a file for Moodle. Two seeds of a level are equally hard."
            </p>
            <div class="acts">
                <button type="button" class="button" on:click=move |_| learn.go_to(Part::Practice, OWN.to_owned())>
                    <Icon glyph=Glyph::Edit />
                    "Hide a fault in a telegram of your own"
                </button>
                <button type="button" class="button" on:click=move |_| go(learn, Where::Results)>
                    <Icon glyph=Glyph::Open />
                    "Results of a group"
                </button>
            </div>
        </section>
    }
}

#[component]
fn KindCard(kind: Kind, begin: Callback<u8>) -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let level = move |level: u8| {
        let answered = Memo::new(move |_| {
            learn.practice.answered(move |round| (round.kind, round.level) == (kind, level))
        });
        view! {
            <li>
                <button type="button" class="level" on:click=move |_| begin.run(level)>
                    <strong>{format!("Level {level}")}</strong>
                    <span>{kind.level_note(level)}</span>
                    <Show when=move || answered.get() != 0>
                        <small>{move || format!("{} answered", count(answered.get(), "question"))}</small>
                    </Show>
                    <Icon glyph=Glyph::ChevronRight />
                </button>
            </li>
        }
    };
    view! {
        <article class="kind-card">
            <h3>{kind.label()}</h3>
            <p>{kind.note()}</p>
            <ol>{LEVELS.map(level).collect_view()}</ol>
        </article>
    }
}

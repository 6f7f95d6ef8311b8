//! A question: what is given, the answer, what there is to say to it, and the next one.

use leptos::ev::SubmitEvent;
use leptos::html;
use leptos::prelude::*;

use super::given::{GivenPart, in_read, named};
use super::go;
use super::state::{Attempt, Key, Outcome, Where};
use crate::browser::file;
use crate::components::byte_strip::{ByteStrip, Lights};
use crate::components::copy_button::CopyButton;
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;
use buslens_trainer::notation::Notation;
use buslens_trainer::practice::{LEVELS, QUESTIONS, Round};
use buslens_trainer::result::{About, RoundResult};
use buslens_trainer::{Answer, Blank, Choice, Expected, Task, Telegram, Verdict, grade, letter};

#[component]
pub fn Question(round: Round, index: usize) -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let Some(task) = round.questions().into_iter().nth(index) else { return ().into_any() };
    let (label, next) = match index + 1 < QUESTIONS {
        true => ("Next question", Where::Question(round, index + 1)),
        false => ("What came of it", Where::Done(round)),
    };
    view! {
        <RoundBar round index=Some(index) />
        <Asked task key=(round.place(), index) label on_next=Callback::new(move |()| go(learn, next)) />
    }
    .into_any()
}

/// A task: what is given, the answer, what there is to say to it, hints, and what comes next.
#[component]
pub fn Asked(task: Task, key: Key, label: &'static str, on_next: Callback<()>) -> impl IntoView {
    let state = expect_context::<LearnState>().practice;
    let key = StoredValue::new(key);
    let attempt = Memo::new(move |_| key.with_value(|key| state.attempt(key)));
    let told = Memo::new(move |_| attempt.with(|attempt| attempt.outcome != Outcome::Open));
    let headline = NodeRef::<html::H3>::new();
    Effect::new(move |_| {
        if let Some(headline) = headline.get()
            && state.moved.try_update_value(std::mem::take) == Some(true)
        {
            let _ = headline.focus();
        }
    });
    let lights = Lights::new();
    let alone =
        task.given.len() == 1 && !matches!(task.expected, Expected::Byte { .. } | Expected::Blanks { .. });
    let last = task.given.len().saturating_sub(1);
    let given = task.given.iter().cloned().enumerate().map(|(at, given)| {
        // A byte is chosen in the last one.
        let lights = if at == last { lights } else { Lights::new() };
        view! { <GivenPart given alone lights told /> }
    });
    let given = given.collect_view();
    let question = task.question.clone();
    let task = StoredValue::new(task);
    view! {
        <article class="question">
            <div class="ask">
                <h3 class="headline" tabindex="-1" node_ref=headline>
                    {question}
                </h3>
                {given}
                <AnswerForm key attempt task lights />
                <Said attempt task />
                <div class="steps">
                    <Show when=move || told.get() fallback=move || view! { <Help key attempt task /> }>
                        <button type="button" class="button main" on:click=move |_| on_next.run(())>
                            {label}
                            <Icon glyph=Glyph::Forward />
                        </button>
                    </Show>
                </div>
            </div>
            <Hints attempt task />
        </article>
    }
}

/// Which round this is, its questions, and what can be done with it.
#[component]
pub fn RoundBar(
    round: Round,
    /// The question that is shown.
    index: Option<usize>,
) -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let outcomes = Memo::new(move |_| learn.practice.outcomes(round));
    let dot = move |at: usize| {
        let outcome = Memo::new(move |_| outcomes.get()[at]);
        let class = move || match outcome.get() {
            Outcome::Open => "dot",
            Outcome::First => "dot good",
            Outcome::Later => "dot good late",
            Outcome::Shown => "dot shown",
        };
        view! {
            <li>
                <button
                    type="button"
                    class=class
                    aria-label=move || format!("Question {}, {}", at + 1, outcome.get().words())
                    aria-current=(index == Some(at)).then_some("step")
                    on:click=move |_| go(learn, Where::Question(round, at))
                >
                    {move || match outcome.get() {
                        Outcome::First | Outcome::Later => view! { <Icon glyph=Glyph::Tick /> }.into_any(),
                        _ => (at + 1).into_any(),
                    }}
                </button>
            </li>
        }
    };
    view! {
        <nav class="round" aria-label="This round">
            <button type="button" class="button plain low" on:click=move |_| go(learn, Where::Start)>
                <Icon glyph=Glyph::Back />
                "All kinds"
            </button>
            <p>
                <strong>{round.kind.label()}</strong>
                {format!(", level {}", round.level)}
                <span class="soft">
                    " seed "
                    <code>{round.seed.to_string()}</code>
                </span>
            </p>
            <ol>{(0..QUESTIONS).map(dot).collect_view()}</ol>
            <div class="acts">
                <button type="button" class="button plain low" on:click=move |_| go(learn, Where::Wall(round, index.unwrap_or(0)))>
                    "On the wall"
                </button>
                <button type="button" class="button plain low" on:click=move |_| go(learn, Where::Paper(round))>
                    <Icon glyph=Glyph::Print />
                    "Handout"
                </button>
            </div>
        </nav>
    }
}

/// What somebody answers.
#[component]
fn AnswerForm(
    key: StoredValue<Key>,
    attempt: Memo<Attempt>,
    task: StoredValue<Task>,
    lights: Lights,
) -> impl IntoView {
    let state = expect_context::<LearnState>().practice;
    let change = move |change: &dyn Fn(&mut Attempt)| key.with_value(|key| state.change(key, change));
    let done = Memo::new(move |_| attempt.with(|attempt| attempt.outcome != Outcome::Open));
    let enter = move |answer: Answer| {
        change(&|attempt| {
            // What was said is about another answer.
            if attempt.answer.as_ref() != Some(&answer) {
                attempt.verdict = None;
            }
            attempt.answer = Some(answer.clone());
        });
    };
    let check = move |event: SubmitEvent| {
        event.prevent_default();
        let answer = attempt.with_untracked(|attempt| attempt.answer.clone());
        let answer = answer.unwrap_or(Answer::Text(String::new()));
        let verdict = task.with_value(|task| grade(task, &answer));
        change(&|attempt| take(attempt, verdict.clone()));
    };
    // A byte is chosen in the strip.
    if task.with_value(|task| matches!(task.expected, Expected::Byte { .. })) {
        Effect::new(move |before: Option<Option<usize>>| {
            let at = lights.chosen.get().map(|chosen| chosen.at);
            if let Some(at) = at.filter(|_| before.flatten() != at && !done.get_untracked()) {
                enter(Answer::Byte(at));
            }
            at
        });
    }
    let text = Signal::derive(move || match attempt.with(|attempt| attempt.answer.clone()) {
        Some(Answer::Text(text)) => text,
        _ => String::new(),
    });
    let on_type = Callback::new(move |text| enter(Answer::Text(text)));
    let input = task.with_value(|task| match &task.expected {
        Expected::Telegram(_) => {
            let label = "The bytes, in hex; with the checksum or without".to_owned();
            view! { <Typed label how="" class="typed" text done on_type /> }.into_any()
        }
        Expected::Number(number) => {
            let how = match number.notation {
                Notation::Hex => "in hex",
                Notation::Binary => "in binary",
                _ => "in decimal; 0xC8 and C8h are read as hex",
            };
            let label = number.label.clone();
            view! { <Typed label how class="typed short" text done on_type /> }.into_any()
        }
        Expected::Choice { choices, .. } => {
            view! { <Choices choices=choices.clone() attempt on_choose=Callback::new(move |at| enter(Answer::Choice(at))) /> }
            .into_any()
        }
        Expected::Byte { telegram, .. } => {
            let bytes = telegram.bytes.clone();
            let chosen = move || match attempt.with(|attempt| attempt.answer.clone()) {
                Some(Answer::Byte(at)) => {
                    format!("Byte {at}, {:02X}", bytes.get(at).copied().unwrap_or_default())
                }
                _ => "none yet: click one above, or go to it with the arrow keys and press Enter".to_owned(),
            };
            view! { <p class="chosen-one">"Chosen: " <strong>{chosen}</strong></p> }.into_any()
        }
        Expected::Blanks { telegram, blanks } => {
            view! { <Blanks telegram=telegram.clone() blanks=blanks.clone() attempt on_type=Callback::new(move |texts| enter(Answer::Blanks(texts))) /> }
            .into_any()
        }
    });
    view! {
        <form class="answer" on:submit=check>
            {input}
            <Show when=move || !done.get()>
                <button type="submit" class="button main">"Check the answer"</button>
            </Show>
        </form>
    }
}

/// An answer that is typed.
#[component]
fn Typed(
    label: String,
    /// How it is written.
    how: &'static str,
    class: &'static str,
    text: Signal<String>,
    done: Memo<bool>,
    on_type: Callback<String>,
) -> impl IntoView {
    let how = (!how.is_empty()).then(|| view! { <small class="soft">{format!(" {how}")}</small> });
    view! {
        <label class=class>
            <span>{label} {how}</span>
            <input
                class="input mono"
                autocomplete="off"
                spellcheck="false"
                prop:value=text
                prop:readOnly=done
                on:input=move |event| on_type.run(event_target_value(&event))
            />
        </label>
    }
}

/// Takes what was said to an answer.
fn take(attempt: &mut Attempt, verdict: Verdict) {
    match verdict {
        Verdict::Right(_) if attempt.wrong == 0 => attempt.outcome = Outcome::First,
        Verdict::Right(_) => attempt.outcome = Outcome::Later,
        Verdict::Wrong(_) => attempt.wrong += 1,
        Verdict::Unread(_) => {}
    }
    attempt.verdict = Some(verdict);
}

#[component]
fn Choices(choices: Vec<Choice>, attempt: Memo<Attempt>, on_choose: Callback<usize>) -> impl IntoView {
    let chosen = move || match attempt.with(|attempt| attempt.answer.clone()) {
        Some(Answer::Choice(at)) => Some(at),
        _ => None,
    };
    let done = move || attempt.with(|attempt| attempt.outcome != Outcome::Open);
    let choice = move |(at, choice): (usize, Choice)| {
        let right = move || done() && chosen() == Some(at);
        view! {
            <label class="choice" class:right=right>
                <input
                    type="radio"
                    name="choice"
                    prop:checked=move || chosen() == Some(at)
                    prop:disabled=done
                    on:change=move |_| on_choose.run(at)
                />
                <span class="soft">{format!("{})", letter(at))}</span>
                <span>{choice.text}</span>
            </label>
        }
    };
    view! {
        <fieldset class="choices">
            <legend class="unseen">"Choices"</legend>
            {choices.into_iter().enumerate().map(choice).collect_view()}
        </fieldset>
    }
}

/// A telegram some of whose fields are to be filled in.
#[component]
fn Blanks(
    telegram: Telegram,
    blanks: Vec<Blank>,
    attempt: Memo<Attempt>,
    on_type: Callback<Vec<String>>,
) -> impl IntoView {
    let count = blanks.len();
    let texts = move || match attempt.with(|attempt| attempt.answer.clone()) {
        Some(Answer::Blanks(texts)) => texts,
        _ => vec![String::new(); count],
    };
    let done = move || attempt.with(|attempt| attempt.outcome != Outcome::Open);
    let wrong = move |label: &str| {
        attempt.with(|attempt| {
            attempt.verdict.as_ref().is_some_and(|it| it.remarks().iter().any(|remark| remark.field == label))
        })
    };
    let mut items = Vec::new();
    let mut at = 0;
    while at < telegram.bytes.len() {
        let Some((index, blank)) = blanks.iter().enumerate().find(|(_, blank)| blank.span.from == at) else {
            items.push(
                view! { <li class="given-byte"><code>{format!("{:02X}", telegram.bytes[at])}</code></li> }
                    .into_any(),
            );
            at += 1;
            continue;
        };
        let label = blank.label.clone();
        let width = blank.span.len();
        let invalid = {
            let label = label.clone();
            move || wrong(&label).to_string()
        };
        items.push(
            view! {
                <li class="blank">
                    <label>
                        <span>{label}</span>
                        <input
                            class="input mono"
                            style:width=format!("{}ch", 3 * width + 4)
                            placeholder=vec!["__"; width].join(" ")
                            autocomplete="off"
                            spellcheck="false"
                            aria-invalid=invalid
                            prop:value=move || texts().get(index).cloned().unwrap_or_default()
                            prop:readOnly=done
                            on:input=move |event| {
                                let mut all = texts();
                                all.resize(count, String::new());
                                all[index] = event_target_value(&event);
                                on_type.run(all);
                            }
                        />
                    </label>
                </li>
            }
            .into_any(),
        );
        at = blank.span.to;
    }
    view! {
        <div class="blanks">
            <p class="note">"Fill in the blanks, in hex."</p>
            <ol>{items}</ol>
        </div>
    }
}

/// What there is to say to the answer.
#[component]
fn Said(attempt: Memo<Attempt>, task: StoredValue<Task>) -> impl IntoView {
    let said = move || {
        let Attempt { verdict, outcome, .. } = attempt.get();
        let told = matches!(outcome, Outcome::First | Outcome::Later | Outcome::Shown);
        let verdict = match (verdict, outcome) {
            (_, Outcome::Shown) => {
                let answer = task.with_value(|task| task.expected.text());
                view! { <p class="said shown"><strong>"The answer: "</strong><span>{answer}</span></p> }
                    .into_any()
            }
            (Some(Verdict::Right(note)), _) => {
                let note = note.map(|note| format!(" {}.", note.sentence()));
                view! {
                    <p class="said right">
                        <Icon glyph=Glyph::Tick />
                        <strong>"Right."</strong>
                        {note}
                    </p>
                }
                .into_any()
            }
            (Some(Verdict::Wrong(remarks)), _) => {
                let remarks = remarks
                    .into_iter()
                    .map(|remark| view! { <li>{remark.text.sentence()} "."</li> })
                    .collect_view();
                view! { <div class="said wrong"><strong>"Not yet."</strong><ul>{remarks}</ul></div> }
                    .into_any()
            }
            (Some(Verdict::Unread(message)), _) => {
                view! { <p class="said unread">{message.sentence()} "."</p> }.into_any()
            }
            (None, Outcome::First | Outcome::Later) => {
                let answer = task.with_value(|task| task.expected.text());
                view! { <p class="said right"><Icon glyph=Glyph::Tick /><strong>"Answered: "</strong>{answer}</p> }.into_any()
            }
            (None, _) => ().into_any(),
        };
        let more = told.then(|| view! { <Told task /> });
        view! {
            {verdict}
            {more}
        }
    };
    view! { <div class="saying" role="status">{said}</div> }
}

/// How the answer comes about, once it is found.
#[component]
fn Told(task: StoredValue<Task>) -> impl IntoView {
    let (working, answer, link) = task.with_value(|task| {
        let answer = match &task.expected {
            Expected::Telegram(telegram) | Expected::Blanks { telegram, .. } => Some(telegram.clone()),
            Expected::Byte { right, .. } => Some(right.clone()),
            Expected::Number(_) | Expected::Choice { .. } => None,
        };
        let whole = answer.as_ref().filter(|_| !matches!(task.expected, Expected::Byte { .. }));
        (task.working.clone(), answer.clone(), in_read(&task.given, whole))
    });
    let strip = answer.map(|telegram| {
        let said = format!("{}.", telegram.said());
        let blocks = named(&telegram);
        view! {
            <figure class="given">
                <figcaption>{said}</figcaption>
                <ByteStrip blocks=Signal::derive(move || blocks.clone()) lights=Lights::new() size="small" label="The right telegram. Arrow keys go from byte to byte." />
            </figure>
        }
    });
    view! {
        {strip}
        <details class="fold">
            <summary>"How it comes about"</summary>
            <ol class="working">
                {working.into_iter().map(|step| view! { <li>{step}</li> }).collect_view()}
            </ol>
        </details>
        {link.map(|link| view! { <p><a href=link>"Open it in Read"</a></p> })}
    }
}

/// The next hint, and at last the answer.
#[component]
fn Help(key: StoredValue<Key>, attempt: Memo<Attempt>, task: StoredValue<Task>) -> impl IntoView {
    let state = expect_context::<LearnState>().practice;
    let change = move |change: fn(&mut Attempt)| key.with_value(|key| state.change(key, change));
    let all = task.with_value(|task| task.hints.len());
    let shown = move || attempt.with(|attempt| attempt.hints);
    view! {
        <Show when=move || shown() < all>
            <button
                type="button"
                class="button"
                on:click=move |_| change(|attempt| attempt.hints += 1)
            >
                <Icon glyph=Glyph::Help />
                {move || format!("Hint {} of {all}", shown() + 1)}
            </button>
        </Show>
        <Show when=move || shown() == all || attempt.with(|attempt| attempt.wrong > 2)>
            <button
                type="button"
                class="button plain"
                on:click=move |_| change(|attempt| attempt.outcome = Outcome::Shown)
            >
                "Show the answer"
            </button>
        </Show>
    }
}

#[component]
fn Hints(attempt: Memo<Attempt>, task: StoredValue<Task>) -> impl IntoView {
    let hints = move || {
        let count = attempt.with(|attempt| attempt.hints);
        let shown = task.with_value(|task| task.hints.iter().take(count).cloned().collect::<Vec<_>>());
        shown.into_iter().map(|hint| view! { <li>{hint}</li> }).collect_view()
    };
    view! {
        <section class="hints" aria-live="polite" aria-label="Hints">
            <Show when=move || attempt.with(|attempt| attempt.hints != 0)>
                <h3>"Hints"</h3>
            </Show>
            <ol>{hints}</ol>
        </section>
    }
}

/// What came of a round.
#[component]
pub fn Done(round: Round) -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let state = learn.practice;
    let outcomes = Memo::new(move |_| state.outcomes(round));
    let counted = move |wanted: Outcome| outcomes.get().iter().filter(|it| **it == wanted).count();
    let right = move || counted(Outcome::First);
    let open = move || counted(Outcome::Open);
    let code = Memo::new(move |_| RoundResult { about: About::Round(round), right: right() }.code());
    let headline = move || match (open(), right()) {
        (0, QUESTIONS) => format!("All {QUESTIONS} right at the first answer."),
        (0, right) => format!("{right} of {QUESTIONS} right at the first answer."),
        (open, _) => format!("{} of {QUESTIONS} answered so far.", QUESTIONS - open),
    };
    let more = move || match counted(Outcome::Later) {
        0 => String::new(),
        1 => "One more came right after another try.".to_owned(),
        later => format!("{later} more came right after another try."),
    };
    let harder = (round.level < *LEVELS.end()).then(|| Round {
        level: round.level + 1,
        seed: round.seed.next(),
        ..round
    });
    let next = Round { seed: round.seed.next(), ..round };
    let saved = move |_| {
        let text = format!(
            "# {}, level {}, seed {}: {} of {QUESTIONS}\n{}\n",
            round.kind.label(),
            round.level,
            round.seed,
            right(),
            code.get_untracked()
        );
        file::save(&format!("buslens-{}.txt", code.get_untracked()), &text);
    };
    view! {
        <RoundBar round index=None />
        <article class="done">
            <h3 class="headline">{headline}</h3>
            <p class="intro">{more}</p>
            <Show when=move || open() == 0>
                <div class="code">
                    <p>"Your result as a code, for your trainer"</p>
                    <output>{code}</output>
                    <div class="acts">
                        <CopyButton text=code label="Copy" />
                        <button type="button" class="button" on:click=saved>
                            <Icon glyph=Glyph::Save />
                            "Save as a file"
                        </button>
                    </div>
                </div>
            </Show>
            <div class="steps">
                <button type="button" class="button main" on:click=move |_| go(learn, Where::Question(next, 0))>
                    "Another round"
                    <Icon glyph=Glyph::Forward />
                </button>
                {harder
                    .map(|harder| {
                        view! {
                            <button type="button" class="button" on:click=move |_| go(learn, Where::Question(harder, 0))>
                                {format!("On to level {}", harder.level)}
                            </button>
                        }
                    })}
                <button
                    type="button"
                    class="button plain"
                    on:click=move |_| {
                        state.forget(round);
                        go(learn, Where::Question(round, 0));
                    }
                >
                    <Icon glyph=Glyph::Undo />
                    "The same once more"
                </button>
            </div>
        </article>
    }
}

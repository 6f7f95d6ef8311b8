//! A question: what is given, the answer, what there is to say to it, and the next one.

use leptos::ev::SubmitEvent;
use leptos::html;
use leptos::prelude::*;

use super::bar::bar;
use super::given::{GivenPart, in_read, named, plain};
use super::go;
use super::series::Shared;
use super::state::{Key, Screen, Where};
use crate::components::button::Button;
use crate::components::byte_strip::{Block, ByteStrip, Lights};
use crate::components::icon::Glyph;
use crate::views::learn::LearnState;
use crate::views::learn::answer::{Answering, Blanks, Choices, Help, Hints, Typed, said};
use crate::views::learn::attempt::{Attempt, Outcome};
use buslens::field::Span;
use buslens_trainer::notation::Notation;
use buslens_trainer::{Answer, Blank, Expected, Task, Telegram, grade};

pub fn question(series: Shared, index: usize) -> AnyView {
    let learn = expect_context::<LearnState>();
    let Some(task) = series.tasks.get(index).cloned() else { return ().into_any() };
    let (label, next) = match index + 1 < series.tasks.len() {
        true => ("Next question", Screen::Question(index + 1)),
        false => ("What came of it", Screen::Done),
    };
    let (source, key) = (series.source.clone(), (series.source.place(), index));
    let on_next = Callback::new(move |()| go(learn, Where::In(source.clone(), next)));
    let about = (index == 0 && !series.about.is_empty())
        .then(|| view! { <p class="intro">{series.about.clone()}</p> });
    let title = series.titles.get(index).map(|title| view! { <p class="tag">{title.clone()}</p> });
    view! {
        {bar(&series, Some(index))}
        {about}
        {title}
        <Asked task key label on_next />
    }
    .into_any()
}

/// A task: what is given, the answer, what there is to say to it, hints, and what comes next.
#[component]
fn Asked(task: Task, key: Key, label: &'static str, on_next: Callback<()>) -> impl IntoView {
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
    let hints = task.hints.clone();
    let task = StoredValue::new(task);
    let on_change =
        Callback::new(move |changed: Attempt| key.with_value(|key| state.change(key, |it| *it = changed)));
    let answering = Answering { attempt, on_change };
    let show = move |()| answering.change(|attempt| attempt.outcome = Outcome::Shown);
    view! {
        <article class="question">
            <div class="ask">
                <h3 class="headline" tabindex="-1" node_ref=headline>
                    {question}
                </h3>
                {given}
                <AnswerForm answering task lights />
                <Said attempt task />
                <div class="steps">
                    <Help answering count=hints.len() label="Show the answer" on_answer=Callback::new(show) />
                    <Button
                        class="button main"
                        glyph=Glyph::Forward
                        label
                        hidden=Signal::derive(move || !told.get())
                        on_press=on_next
                    />
                </div>
            </div>
            <Hints answering hints />
        </article>
    }
}

/// What somebody answers.
#[component]
fn AnswerForm(answering: Answering, task: StoredValue<Task>, lights: Lights) -> impl IntoView {
    let attempt = answering.attempt;
    let check = move |event: SubmitEvent| {
        event.prevent_default();
        answering.change(|attempt| {
            let answer = attempt.answer.clone().unwrap_or(Answer::Text(String::new()));
            let verdict = task.with_value(|task| grade(task, &answer));
            if verdict.is_right() {
                attempt.outcome = if attempt.wrong == 0 { Outcome::First } else { Outcome::Later };
            }
            attempt.take(verdict);
        });
    };
    let input = task.with_value(|task| match &task.expected {
        Expected::Telegram(_) => {
            view! { <Typed answering label="The bytes, in hex; with the checksum or without" /> }.into_any()
        }
        Expected::Number(number) => {
            let how = match number.notation {
                Notation::Hex => "in hex",
                Notation::Binary => "in binary",
                _ => "in decimal; 0xC8 and C8h are read as hex",
            };
            view! { <Typed answering label=number.label.clone() how short=true /> }.into_any()
        }
        Expected::Choice { choices, .. } => {
            let texts = choices.iter().map(|choice| choice.text.clone()).collect::<Vec<_>>();
            view! { <Choices answering texts /> }.into_any()
        }
        Expected::Byte { telegram, .. } => {
            // A byte is chosen in the strip.
            answering.take_byte(lights);
            let bytes = telegram.bytes.clone();
            let chosen = move || match attempt.get().answer {
                Some(Answer::Byte(at)) => {
                    format!("Byte {at}, {:02X}", bytes.get(at).copied().unwrap_or_default())
                }
                _ => "none yet: click one above, or go to it with the arrow keys and press Enter".to_owned(),
            };
            view! { <p class="chosen-one">"Chosen: " <strong>{move || chosen()}</strong></p> }.into_any()
        }
        Expected::Blanks { telegram, blanks } => {
            let spans: Vec<Span> = blanks.iter().map(|blank| blank.span).collect();
            view! { <Blanks answering blocks=with_blanks(telegram, blanks) spans /> }.into_any()
        }
    });
    view! {
        <form class="answer" on:submit=check>
            {input}
            <button type="submit" class="button main" hidden=move || attempt.with(Attempt::is_closed)>
                "Check the answer"
            </button>
        </form>
    }
}

/// The bytes one by one, and the blanks by their names.
fn with_blanks(telegram: &Telegram, blanks: &[Blank]) -> Vec<Block> {
    let mut blocks = plain(&telegram.bytes);
    for Blank { label, span } in blanks {
        blocks.retain(|block| !span.contains(block.span.from));
        let at = blocks.partition_point(|block| block.span.from < span.from);
        blocks.insert(
            at,
            Block {
                name: label.clone(),
                label: label.clone(),
                caption: String::new(),
                class: "role-unknown",
                faulty: false,
                span: *span,
                bytes: Vec::new(),
            },
        );
    }
    blocks
}

/// What there is to say to the answer.
#[component]
fn Said(attempt: Memo<Attempt>, task: StoredValue<Task>) -> impl IntoView {
    let shown = move || {
        let Attempt { verdict, outcome, .. } = attempt.get();
        let answer = |class, label| {
            let answer = task.with_value(|task| task.expected.text());
            view! { <p class=class><strong>{label}</strong> <span>{answer}</span></p> }.into_any()
        };
        let verdict = match (verdict, outcome) {
            (_, Outcome::Shown) => answer("said shown", "The answer: "),
            (Some(verdict), _) => said(verdict, &|| ().into_any()),
            (None, Outcome::First | Outcome::Later) => answer("said right", "Answered: "),
            (None, _) => ().into_any(),
        };
        let more = (outcome != Outcome::Open).then(|| view! { <Told task /> });
        view! {
            {verdict}
            {more}
        }
    };
    view! { <div class="saying" role="status">{move || shown()}</div> }
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

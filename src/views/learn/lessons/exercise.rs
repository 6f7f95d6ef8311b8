//! What there is to do in a step: the question, a place for the answer, what was off in it, and hints.

use leptos::ev::SubmitEvent;
use leptos::prelude::*;

use super::onward::Onward;
use super::state::Here;
use super::switches::{Switches, number};
use crate::components::byte_strip::{Block, ByteStrip, Chosen, Lights, blocks};
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;
use crate::views::learn::answer::{Answering, Blanks, Choices, Help, Hints, Typed, said};
use crate::views::learn::attempt::Attempt;
use crate::views::learn::words::Words;
use buslens::field::{Span, hex};
use buslens::tool::steps::{CHECKS, bytes};
use buslens_trainer::lesson::{Ask, Exercise as Asked, Step};
use buslens_trainer::{Answer, Checksum, Telegram};

#[component]
pub fn Exercise(here: Here) -> impl IntoView {
    let state = expect_context::<LearnState>().lessons;
    let Some(step) = here.step().cloned() else { return ().into_any() };
    let Some(exercise) = step.exercise.clone() else {
        return view! { <aside class="task"><Onward here /></aside> }.into_any();
    };
    let place = here.place();
    let attempt = {
        let place = place.clone();
        Memo::new(move |_| state.attempt(&place))
    };
    let on_change = Callback::new(move |changed| state.change(&place, |attempt| *attempt = changed));
    let answering = Answering { attempt, on_change };
    let hints: Vec<String> = exercise.hints.iter().map(|hint| step.filled_in(hint)).collect();
    let (question, then) = (step.filled_in(&exercise.question), step.filled_in(&exercise.then));
    let right = exercise.answer(&step);
    let fill = move |()| right.iter().cloned().for_each(|right| answering.enter(right));
    // Who changed nothing hands in what was there.
    let start = exercise.start();
    let form = place_for(answering, &step, &exercise);
    let here = StoredValue::new(here);
    let submit = move |event: SubmitEvent| {
        event.prevent_default();
        let answer = attempt.with_untracked(|it| it.answer.clone());
        here.with_value(|here| state.grade(here, answer.unwrap_or_else(|| Answer::Text(start.clone()))));
    };
    let on = move || {
        view! {
            <p>
                <Words text=then.clone() />
            </p>
            <Onward here=here.get_value() />
        }
        .into_any()
    };
    let outcome = move || attempt.get().verdict.map(|verdict| said(verdict, &on));
    view! {
        <aside class="task" aria-labelledby="task-title">
            <div class="stays">
                <p class="tag">
                    <Icon glyph=Glyph::Edit />
                    "Your turn"
                </p>
                <h3 id="task-title">
                    <Words text=question />
                </h3>
                <form on:submit=submit>
                    {form}
                    <div role="status">{move || outcome()}</div>
                    <div class="actions">
                        <button type="submit" class="button" class:main=move || !attempt.with(Attempt::is_over)>
                            "Check my answer"
                        </button>
                        <Help answering count=hints.len() label="Fill in the answer" on_answer=Callback::new(fill) />
                    </div>
                </form>
                <Hints answering hints />
            </div>
        </aside>
    }
    .into_any()
}

/// Where the answer is given.
fn place_for(answering: Answering, step: &Step, exercise: &Asked) -> AnyView {
    let typed = |start: &str| {
        let (telegram, start) = (exercise.telegram(step), start.to_owned());
        view! {
            <Typed answering start=start.clone() label="The bytes, in hex" />
            {telegram.map(|telegram| view! { <Live answering telegram start /> })}
        }
        .into_any()
    };
    match &exercise.ask {
        Ask::Choose { choices, .. } => {
            let texts = choices.iter().map(|choice| choice.text.clone()).collect::<Vec<_>>();
            view! { <Choices answering texts /> }.into_any()
        }
        Ask::Number { .. } => view! { <Typed answering label="Your answer" short=true /> }.into_any(),
        Ask::Point { .. } => {
            let bytes = step.report().telegrams.pop().map_or(Vec::new(), |last| last.line.bytes);
            view! { <Pointed answering bytes /> }.into_any()
        }
        Ask::Blank { .. } => {
            let telegram = exercise.telegram(step);
            let detail = telegram.as_ref().and_then(Telegram::detail);
            let blocks = telegram.zip(detail).map(|(telegram, detail)| blocks(&detail, &telegram.bytes));
            let spans: Vec<Span> =
                exercise.blanks(step).into_iter().flatten().map(|blank| blank.span).collect();
            view! { <Blanks answering blocks=blocks.unwrap_or_default() spans /> }.into_any()
        }
        Ask::Build { .. } => typed(""),
        Ask::Repair { damaged, .. } => typed(damaged),
        Ask::Bits { from, to, reading } => {
            let width = from.len();
            let start = number(from);
            let value = Signal::derive(move || answering.text().map_or(start, |text| number(&bytes(&text))));
            let on_set = Callback::new(move |value: u32| {
                answering.enter(Answer::Text(hex(&value.to_be_bytes()[4 - width..])));
            });
            view! { <Switches value on_set width reading=*reading wanted=number(to) /> }.into_any()
        }
    }
}

/// What the bytes are as far as they are typed.
#[component]
fn Live(answering: Answering, telegram: Telegram, start: String) -> impl IntoView {
    let lights = Lights::new();
    let check = telegram.check().filter(|check| check.covered.to + check.width == telegram.bytes.len());
    let added = telegram.checksum == Checksum::Added;
    let typed = Memo::new(move |_| bytes(&answering.text().unwrap_or_else(|| start.clone())));
    // Its place is kept free until all before it is there.
    let checksum = Memo::new(move |_| {
        let check = check.filter(|check| added && typed.with(Vec::len) <= check.covered.to)?;
        let algorithm = CHECKS.iter().find(|it| it.kind == check.kind)?;
        Some(typed.with(|typed| algorithm.wire(typed).to_be_bytes()[8 - check.width..].to_vec()))
    });
    let shown = Memo::new(move |_| {
        let mut whole = typed.get();
        if whole.is_empty() {
            return Vec::new();
        }
        whole.extend(checksum.get().unwrap_or_default());
        let detail = telegram.with(whole.clone()).detail();
        detail.map_or(Vec::new(), |detail| blocks(&detail, &whole))
    });
    // What is off lights up.
    Effect::new(move |_| {
        let span = answering.attempt.with(|attempt| attempt.verdict.as_ref()?.remarks().first()?.span);
        lights.chosen.set(span.filter(|span| !span.is_empty()).map(|span| Chosen { span, at: span.from }));
    });
    view! {
        <Show when=move || !shown.with(Vec::is_empty)>
            <ByteStrip blocks=shown lights size="small" label="The bytes so far. Arrow keys go from byte to byte." />
            <Show when=move || checksum.with(Option::is_some)>
                <p class="note">"The checksum is added by the page."</p>
            </Show>
        </Show>
    }
}

/// Bytes without a word, one of which is to be found.
#[component]
fn Pointed(answering: Answering, bytes: Vec<u8>) -> impl IntoView {
    let lights = Lights::new();
    answering.take_byte(lights);
    let cell = |(at, byte): (usize, u8)| Block {
        name: String::new(),
        label: String::new(),
        caption: String::new(),
        class: "role-head",
        faulty: false,
        span: Span::new(at, at + 1),
        bytes: vec![byte],
    };
    let cells: Vec<Block> = bytes.into_iter().enumerate().map(cell).collect();
    view! { <ByteStrip blocks=cells lights size="bare" label="Choose a byte. Arrow keys go from byte to byte." /> }
}

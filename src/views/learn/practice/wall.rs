//! A question for everybody in the room: large, and one field at a time by arrow key.

use leptos::ev::{self, KeyboardEvent};
use leptos::html;
use leptos::prelude::*;

use super::given::{bare, named};
use super::go;
use super::state::Where;
use crate::browser::typing::is_typed_into;
use crate::components::byte_strip::{Block, ByteStrip, Lights};
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;
use buslens_trainer::practice::{QUESTIONS, Round};
use buslens_trainer::{Expected, Given, Task, Telegram, letter};

#[component]
pub fn Wall(round: Round, index: usize) -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let Some(task) = round.questions().into_iter().nth(index) else { return ().into_any() };
    let telegram = shown(&task).map(|telegram| (telegram.clone(), named(&telegram)));
    // A log or a choice has its answer as the only step.
    let steps = telegram.as_ref().map_or(0, |(_, blocks)| blocks.len()) + 1;
    let step = RwSignal::new(0_usize);
    let turn = move |by: isize| step.update(|step| *step = step.saturating_add_signed(by).min(steps));
    let keys = move |event: KeyboardEvent| {
        if event.alt_key() || event.ctrl_key() || event.meta_key() || is_typed_into(event.target()) {
            return;
        }
        match event.key().as_str() {
            "ArrowRight" | "ArrowDown" | "PageDown" | " " => turn(1),
            "ArrowLeft" | "ArrowUp" | "PageUp" => turn(-1),
            "Escape" => go(learn, Where::Question(round, index)),
            _ => return,
        }
        event.prevent_default();
    };
    let listener = window_event_listener(ev::keydown, keys);
    on_cleanup(move || listener.remove());
    let headline = NodeRef::<html::H3>::new();
    let strip = telegram.map(|(telegram, blocks)| {
        let blocks = Memo::new(move |_| opened(&telegram, &blocks, step.get()));
        view! { <ByteStrip blocks lights=Lights::new() size="large" label="The telegram" /> }
    });
    let text = task.given.iter().find_map(|given| match given {
        Given::Text(text) => Some(view! { <pre class="log-lines mono" tabindex="0">{text.clone()}</pre> }),
        Given::Telegram(_) => None,
    });
    let before = task.given.iter().rev().skip(1).find_map(|given| match given {
        Given::Telegram(telegram) => Some(view! { <p class="mono before">{telegram.hex()}</p> }),
        Given::Text(_) => None,
    });
    let choices = match &task.expected {
        Expected::Choice { choices, .. } => {
            let all = choices.iter().enumerate();
            let all = all
                .map(|(at, it)| view! { <li>{format!("{}) {}", letter(at), it.text)}</li> })
                .collect_view();
            Some(view! { <ul class="wall-choices">{all}</ul> })
        }
        _ => None,
    };
    let answer = task.expected.text();
    view! {
        <article class="wall">
            <h3 node_ref=headline>{task.question.clone()}</h3>
            {text}
            {before}
            {strip}
            {choices}
            <p class="wall-answer" aria-live="polite">
                {move || if step.get() == steps { answer.clone() } else { String::new() }}
            </p>
            <div class="tools">
                <button type="button" class="button" prop:disabled=move || step.get() == 0 on:click=move |_| turn(-1)>
                    <Icon glyph=Glyph::Back />
                    "Back"
                </button>
                <button type="button" class="button main" prop:disabled=move || step.get() == steps on:click=move |_| turn(1)>
                    {move || if step.get() + 1 >= steps { "Answer" } else { "Next field" }}
                    <Icon glyph=Glyph::Forward />
                </button>
                <span class="soft">"Arrow keys do the same."</span>
                <span class="rest"></span>
                {(index + 1 < QUESTIONS)
                    .then(|| {
                        view! {
                            <button type="button" class="button plain" on:click=move |_| go(learn, Where::Wall(round, index + 1))>
                                "Next question"
                            </button>
                        }
                    })}
                <button type="button" class="button plain" on:click=move |_| go(learn, Where::Question(round, index))>
                    <Icon glyph=Glyph::Close />
                    "Leave the wall"
                </button>
            </div>
        </article>
    }
    .into_any()
}

/// The telegram that is taken apart: the last one that is given, or the one that is to be made.
fn shown(task: &Task) -> Option<Telegram> {
    match &task.expected {
        Expected::Telegram(telegram)
        | Expected::Blanks { telegram, .. }
        | Expected::Byte { telegram, .. } => Some(telegram.clone()),
        _ => task.given.iter().rev().find_map(|given| match given {
            Given::Telegram(telegram) => Some(telegram.clone()),
            Given::Text(_) => None,
        }),
    }
}

/// The first fields with their names, the others as bare bytes; blanks and telegrams that are to be made have
/// none of theirs yet.
fn opened(telegram: &Telegram, blocks: &[Block], step: usize) -> Vec<Block> {
    let open = blocks.iter().take(step).cloned();
    let closed = blocks.iter().skip(step).flat_map(|block| {
        (block.span.from..block.span.to)
            .map(|at| bare(at, telegram.bytes.get(at).copied().unwrap_or_default()))
    });
    open.chain(closed).collect()
}

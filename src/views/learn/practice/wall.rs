//! A question for everybody in the room: large, and one field at a time by arrow key.

use leptos::ev::{self, KeyboardEvent};
use leptos::prelude::*;

use super::given::{bare, named};
use super::go;
use super::series::Shared;
use super::state::{Screen, Where};
use crate::browser::typing::is_typed_into;
use crate::components::button::Button;
use crate::components::byte_strip::{Block, ByteStrip, Lights};
use crate::components::icon::Glyph;
use crate::views::learn::LearnState;
use buslens_trainer::{Expected, Given, Task, Telegram, letter};

pub fn wall(series: Shared, index: usize) -> AnyView {
    let learn = expect_context::<LearnState>();
    let Some(task) = series.tasks.get(index).cloned() else { return ().into_any() };
    let source = series.source.clone();
    let to = Callback::new(move |screen| go(learn, Where::In(source.clone(), screen)));
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
            "Escape" => to.run(Screen::Question(index)),
            _ => return,
        }
        event.prevent_default();
    };
    let listener = window_event_listener(ev::keydown, keys);
    on_cleanup(move || listener.remove());
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
    let said = move || if step.get() == steps { answer.clone() } else { String::new() };
    let label = Signal::derive(move || {
        let label = if step.get() + 1 >= steps { "Answer" } else { "Next field" };
        label.to_owned()
    });
    let [first, last] = [0, steps].map(|end| Signal::derive(move || step.get() == end));
    let next = move |()| to.run(Screen::Wall(index + 1));
    let next = (index + 1 < series.tasks.len())
        .then(|| view! { <Button class="button plain" label="Next question" on_press=next /> });
    view! {
        <article class="wall">
            <h3>{task.question.clone()}</h3>
            {text}
            {before}
            {strip}
            {choices}
            <p class="wall-answer" aria-live="polite">
                {move || said()}
            </p>
            <div class="tools">
                <Button glyph=Glyph::Back label="Back" disabled=first on_press=move |()| turn(-1) />
                <Button class="button main" glyph=Glyph::Forward label disabled=last on_press=move |()| turn(1) />
                <span class="soft">"Arrow keys do the same."</span>
                <span class="rest"></span>
                {next}
                <Button class="button plain" glyph=Glyph::Close label="Leave the wall" on_press=move |()| to.run(Screen::Question(index)) />
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

//! A round for paper: the handout, and the answer key on a sheet of its own.

use leptos::prelude::*;

use super::given::caption;
use super::go;
use super::state::Where;
use crate::browser::file;
use crate::components::icon::{Glyph, Icon};
use crate::components::segments::Segments;
use crate::views::learn::LearnState;
use buslens::field::hex;
use buslens_trainer::practice::Round;
use buslens_trainer::{Expected, Given, Task, course, letter};

/// Which sheets are shown, and printed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sheets {
    Both,
    Handout,
    Key,
}

#[component]
pub fn Paper(round: Round) -> impl IntoView {
    let learn = expect_context::<LearnState>();
    let sheets = RwSignal::new(Sheets::Both);
    let tasks = StoredValue::new(round.questions());
    let options = vec![
        (Sheets::Both, "Both".to_owned()),
        (Sheets::Handout, "Handout".to_owned()),
        (Sheets::Key, "Answer key".to_owned()),
    ];
    let title = format!("{}, level {}", round.kind.label(), round.level);
    let name = format!("buslens-{}-{}-{}", round.kind.key(), round.level, round.seed);
    let moodle = {
        let (name, title) = (name.clone(), title.clone());
        move |_| {
            let text = tasks.with_value(|tasks| course::moodle_xml(&title, &round.place(), tasks));
            file::save(&format!("{name}.xml"), &text);
        }
    };
    let gift = {
        let title = title.clone();
        move |_| {
            let text = tasks.with_value(|tasks| course::gift(&title, &round.place(), tasks));
            file::save(&format!("{name}.txt"), &text);
        }
    };
    let foot = format!("Buslens practice {} · seed {}", round.place(), round.seed);
    let handout = {
        let (title, foot) = (title.clone(), foot.clone());
        move || {
            let questions = tasks.with_value(|tasks| tasks.iter().enumerate().map(question).collect_view());
            view! {
                <article class="paper handout" aria-label="Handout">
                    <header>
                        <h3>{title.clone()}</h3>
                        <p class="who"><span>"Name"</span><span>"Date"</span></p>
                    </header>
                    <ol>{questions}</ol>
                    <footer>{foot.clone()}</footer>
                </article>
            }
        }
    };
    let key = move || {
        let answers = tasks.with_value(|tasks| tasks.iter().map(answer).collect_view());
        view! {
            <article class="paper key" aria-label="Answer key">
                <header>
                    <h3>{format!("Answer key: {title}")}</h3>
                </header>
                <ol>{answers}</ol>
                <footer>{foot.clone()}</footer>
            </article>
        }
    };
    view! {
        <div class="tools">
            <button type="button" class="button plain" on:click=move |_| go(learn, Where::Question(round, 0))>
                <Icon glyph=Glyph::Back />
                "Back to the questions"
            </button>
            <Segments label="Sheets" options=options value=sheets on_choose=Callback::new(move |chosen| sheets.set(chosen)) />
            <button
                type="button"
                class="button main"
                on:click=move |_| {
                    // A browser that cannot print does nothing.
                    let _ = window().print();
                }
            >
                <Icon glyph=Glyph::Print />
                "Print"
            </button>
            <button type="button" class="button" on:click=moodle>
                <Icon glyph=Glyph::Save />
                "Moodle XML"
            </button>
            <button type="button" class="button" on:click=gift>
                <Icon glyph=Glyph::Save />
                "GIFT"
            </button>
        </div>
        <Show when=move || sheets.get() != Sheets::Key>{handout.clone()}</Show>
        <Show when=move || sheets.get() != Sheets::Handout>{key.clone()}</Show>
    }
}

/// A question with room to write.
fn question((index, task): (usize, &Task)) -> impl IntoView + use<> {
    // What is to be completed is another one.
    let alone = task.given.len() == 1 && !matches!(task.expected, Expected::Blanks { .. });
    let given = task.given.iter().map(|given| match given {
        Given::Text(text) => view! { <pre class="mono">{text.clone()}</pre> }.into_any(),
        Given::Telegram(telegram) => {
            let cells: Vec<String> = telegram.bytes.iter().map(|byte| format!("{byte:02X}")).collect();
            view! {
                <figure>
                    <figcaption>{caption(telegram, alone)}</figcaption>
                    <Grid cells />
                </figure>
            }
            .into_any()
        }
    });
    let given = given.collect_view();
    let room = match &task.expected {
        // As many as are needed would tell something.
        Expected::Telegram(telegram) => {
            let cells = vec![String::new(); telegram.bytes.len().next_multiple_of(8)];
            view! { <Grid cells /> }.into_any()
        }
        Expected::Number(number) => {
            view! { <p class="line"><span>{number.label.clone()}</span></p> }.into_any()
        }
        Expected::Choice { choices, .. } => {
            let choices = choices.iter().enumerate();
            let choices = choices
                .map(|(at, choice)| view! { <li>{format!("{}) {}", letter(at), choice.text)}</li> })
                .collect_view();
            view! { <ul class="boxes">{choices}</ul> }.into_any()
        }
        Expected::Byte { .. } => view! { <p class="line"><span>"Byte"</span></p> }.into_any(),
        Expected::Blanks { telegram, blanks } => {
            let cell = |(at, byte): (usize, &u8)| match blanks.iter().any(|blank| blank.span.contains(at)) {
                true => String::new(),
                false => format!("{byte:02X}"),
            };
            let cells: Vec<String> = telegram.bytes.iter().enumerate().map(cell).collect();
            view! { <Grid cells /> }.into_any()
        }
    };
    view! {
        <li>
            <p class="asked">{format!("{}. {}", index + 1, task.question)}</p>
            {given}
            {room}
            <p class="space" aria-hidden="true"></p>
        </li>
    }
}

/// Bytes, or room for them, with their numbers.
#[component]
fn Grid(cells: Vec<String>) -> impl IntoView {
    let cell = |(at, text): (usize, String)| {
        let empty = text.is_empty();
        view! {
            <li class:empty=empty>
                <code>{text}</code>
                <small>{at}</small>
            </li>
        }
    };
    view! { <ul class="grid">{cells.into_iter().enumerate().map(cell).collect_view()}</ul> }
}

fn answer(task: &Task) -> impl IntoView + use<> {
    let given = task.given.iter().map(|given| match given {
        Given::Text(_) => "A log".to_owned(),
        Given::Telegram(telegram) => hex(&telegram.bytes),
    });
    let given = given.collect::<Vec<_>>().join(" / ");
    let working = task.working.iter().map(|step| view! { <li>{step.clone()}</li> }).collect_view();
    view! {
        <li>
            <p class="asked">{task.question.clone()}</p>
            {(!given.is_empty()).then(|| view! { <p class="mono soft">{given}</p> })}
            <p class="right">{task.expected.text()}</p>
            <ol>{working}</ol>
        </li>
    }
}

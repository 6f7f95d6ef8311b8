//! A round for paper: the handout, and the answer key on a sheet of its own.

use leptos::prelude::*;

use super::given::caption;
use super::go;
use super::series::{Series, Shared};
use super::state::{Screen, Where};
use crate::browser::file;
use crate::components::button::Button;
use crate::components::icon::Glyph;
use crate::components::segments::Segments;
use crate::views::learn::LearnState;
use buslens::field::hex;
use buslens_trainer::{Expected, Given, Task, course, letter};

/// Which sheets are shown, and printed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sheets {
    Both,
    Handout,
    Key,
}

pub fn paper(series: Shared) -> AnyView {
    let learn = expect_context::<LearnState>();
    let sheets = RwSignal::new(Sheets::Both);
    let options = vec![
        (Sheets::Both, "Both".to_owned()),
        (Sheets::Handout, "Handout".to_owned()),
        (Sheets::Key, "Answer key".to_owned()),
    ];
    let saved = |ending: &'static str, write: fn(&str, &str, &[Task]) -> String| {
        let series = series.clone();
        move |()| {
            let text = write(&series.name(), &series.source.place(), &series.tasks);
            file::save(&format!("{}.{ending}", series.file()), &text);
        }
    };
    let (moodle, gift) = (saved("xml", course::moodle_xml), saved("txt", course::gift));
    let source = series.source.clone();
    let back = move |()| go(learn, Where::In(source.clone(), Screen::Question(0)));
    // A browser that cannot print does nothing.
    let print = |()| drop(window().print());
    let shown = move || {
        let sheets = sheets.get();
        let rows = |row: fn(&Series, usize, &Task) -> AnyView| {
            series.tasks.iter().enumerate().map(|(at, task)| row(&series, at, task)).collect::<Vec<_>>()
        };
        let sheet = |class: &'static str, name: &'static str, title: String, who: Option<AnyView>, rows| {
            view! {
                <article class=class aria-label=name>
                    <header>
                        <h3>{title}</h3>
                        {who}
                    </header>
                    <ol>{rows}</ol>
                    <footer>{series.foot()}</footer>
                </article>
            }
            .into_any()
        };
        let handout = (sheets != Sheets::Key).then(|| {
            let who = view! { <p class="who"><span>"Name"</span><span>"Date"</span></p> }.into_any();
            sheet("paper handout", "Handout", series.name(), Some(who), rows(question))
        });
        let key = (sheets != Sheets::Handout).then(|| {
            let title = format!("Answer key: {}", series.name());
            sheet("paper key", "Answer key", title, None, rows(answer))
        });
        [handout, key].into_iter().flatten().collect::<Vec<AnyView>>()
    };
    view! {
        <div class="tools">
            <Button class="button plain" glyph=Glyph::Back label="Back to the questions" on_press=back />
            <Segments label="Sheets" options=options value=sheets on_choose=Callback::new(move |chosen| sheets.set(chosen)) />
            <Button class="button main" glyph=Glyph::Print label="Print" on_press=print />
            <Button glyph=Glyph::Save label="Moodle XML" on_press=moodle />
            <Button glyph=Glyph::Save label="GIFT" on_press=gift />
        </div>
        {move || shown()}
    }
    .into_any()
}

/// What a task is called, before what it asks.
fn called(series: &Series, at: usize) -> Option<impl IntoView + use<>> {
    series.titles.get(at).map(|title| view! { <p class="called">{title.clone()}</p> })
}

/// A question with room to write.
fn question(series: &Series, index: usize, task: &Task) -> AnyView {
    // What is to be completed is another one.
    let alone = task.given.len() == 1 && !matches!(task.expected, Expected::Blanks { .. });
    let given = task.given.iter().map(|given| match given {
        Given::Text(text) => view! { <pre class="mono">{text.clone()}</pre> }.into_any(),
        Given::Telegram(telegram) => {
            let cells: Vec<String> = telegram.bytes.iter().map(|byte| format!("{byte:02X}")).collect();
            view! {
                <figure>
                    <figcaption>{caption(telegram, alone)}</figcaption>
                    {grid(cells)}
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
            grid(cells)
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
            grid(cells)
        }
    };
    view! {
        <li>
            {called(series, index)}
            <p class="asked">{format!("{}. {}", index + 1, task.question)}</p>
            {given}
            {room}
            <p class="space" aria-hidden="true"></p>
        </li>
    }
    .into_any()
}

/// Bytes, or room for them, with their numbers.
fn grid(cells: Vec<String>) -> AnyView {
    let cell = |(at, text): (usize, String)| {
        let empty = text.is_empty();
        view! {
            <li class:empty=empty>
                <code>{text}</code>
                <small>{at}</small>
            </li>
        }
    };
    view! { <ul class="grid">{cells.into_iter().enumerate().map(cell).collect_view()}</ul> }.into_any()
}

fn answer(series: &Series, index: usize, task: &Task) -> AnyView {
    let given = task.given.iter().map(|given| match given {
        Given::Text(_) => "A log".to_owned(),
        Given::Telegram(telegram) => hex(&telegram.bytes),
    });
    let given = given.collect::<Vec<_>>().join(" / ");
    let working = task.working.iter().map(|step| view! { <li>{step.clone()}</li> }).collect_view();
    view! {
        <li>
            {called(series, index)}
            <p class="asked">{task.question.clone()}</p>
            {(!given.is_empty()).then(|| view! { <p class="mono soft">{given}</p> })}
            <p class="right">{task.expected.text()}</p>
            <ol>{working}</ol>
        </li>
    }
    .into_any()
}

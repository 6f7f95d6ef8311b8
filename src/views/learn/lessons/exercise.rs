//! What there is to do in a step: the question, a place for the answer, what was off in it, and hints.

use std::sync::Arc;

use leptos::ev::SubmitEvent;
use leptos::prelude::*;

use super::state::{Attempt, Here, LessonsState, link_to};
use super::switches::{Switches, number};
use super::words::Words;
use crate::components::byte_strip::{Block, ByteStrip, Chosen, Lights, blocks};
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;
use buslens::field::{Span, hex};
use buslens::tool::steps::{CHECKS, bytes};
use buslens_trainer::lesson::{Ask, Exercise as Asked};
use buslens_trainer::{Answer, Remark, Telegram, Verdict};

/// What the parts of a task know.
#[derive(Clone, Copy)]
struct Task {
    here: StoredValue<Here>,
    state: LessonsState,
    attempt: Memo<Attempt>,
}

impl Task {
    fn place(self) -> String {
        self.here.with_value(Here::place)
    }

    /// Somebody answers something else: what was said of the last answer is over.
    fn answer(self, answer: Answer) {
        self.state.change(&self.place(), |attempt| {
            attempt.answer = Some(answer);
            attempt.verdict = None;
        });
    }

    fn grade(self) {
        let here = self.here.get_value();
        let answer = self.attempt.with_untracked(|it| it.answer.clone());
        // Who changed nothing hands in what was there.
        let start =
            || here.step().and_then(|step| step.exercise.as_ref()).map_or(String::new(), Asked::start);
        let answer = answer.unwrap_or_else(|| Answer::Text(start()));
        self.state.grade(&here, answer);
    }

    /// What was typed.
    fn text(self) -> Option<String> {
        self.attempt.with(|attempt| match &attempt.answer {
            Some(Answer::Text(text)) => Some(text.clone()),
            _ => None,
        })
    }
}

#[component]
pub fn Exercise(here: Here) -> impl IntoView {
    let state = expect_context::<LearnState>().lessons;
    let Some(step) = here.step().cloned() else { return ().into_any() };
    let Some(exercise) = step.exercise.clone() else {
        return view! { <aside class="task"><Onward here /></aside> }.into_any();
    };
    let place = here.place();
    let attempt = Memo::new(move |_| state.attempt(&place));
    let task = Task { here: StoredValue::new(here.clone()), state, attempt };
    let report = step.report();
    let fill = |text: &str| step.filled(text, &report).unwrap_or_else(|_| text.to_owned());
    let (question, then) = (fill(&exercise.question), fill(&exercise.then));
    let hints: Vec<String> = exercise.hints.iter().map(|hint| fill(hint)).collect();
    let submit = move |event: SubmitEvent| {
        event.prevent_default();
        task.grade();
    };
    let answer = view! { <Place task exercise=exercise.clone() /> };
    let right = exercise.answer(&step);
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
                    {answer}
                    <Outcome task then here />
                    <div class="actions">
                        <button type="submit" class="button main">
                            "Check my answer"
                        </button>
                        <HintButton task count=hints.len() right />
                    </div>
                </form>
                <Hints task hints />
            </div>
        </aside>
    }
    .into_any()
}

/// Where the answer is given.
#[component]
fn Place(task: Task, exercise: Asked) -> impl IntoView {
    let telegram = task.here.with_value(|here| here.step().and_then(|step| exercise.telegram(step)));
    match exercise.ask.clone() {
        Ask::Choose { choices, .. } => {
            let texts: Vec<String> = choices.into_iter().map(|choice| choice.text).collect();
            view! { <Choices task texts /> }.into_any()
        }
        Ask::Number { .. } => view! { <Typed task start="" label="Your answer" /> }.into_any(),
        Ask::Point { .. } => view! { <Pointed task /> }.into_any(),
        Ask::Blank { .. } => {
            let spans = task.here.with_value(|here| here.step().and_then(|step| exercise.blanks(step)));
            let spans: Vec<Span> = spans.into_iter().flatten().map(|blank| blank.span).collect();
            telegram.map(|telegram| view! { <Blanks task telegram spans /> }).into_any()
        }
        Ask::Build { .. } => telegram
            .map(|telegram| {
                view! {
                    <Typed task start="" label="The bytes, in hex" />
                    <Live task telegram start="" />
                }
            })
            .into_any(),
        Ask::Repair { damaged, .. } => telegram
            .map(|telegram| {
                view! {
                    <Typed task start=damaged.clone() label="The bytes, in hex" />
                    <Live task telegram start=damaged />
                }
            })
            .into_any(),
        Ask::Bits { from, to, reading } => {
            let width = from.len();
            let start = number(&from);
            let value = Signal::derive(move || task.text().map_or(start, |text| number(&bytes(&text))));
            let on_set = Callback::new(move |value: u32| {
                task.answer(Answer::Text(hex(&value.to_be_bytes()[4 - width..])));
            });
            view! { <Switches value on_set width reading wanted=number(&to) /> }.into_any()
        }
    }
}

/// Sentences, one of which is right.
#[component]
fn Choices(task: Task, texts: Vec<String>) -> impl IntoView {
    let chosen = move || {
        task.attempt.with(|attempt| match attempt.answer {
            Some(Answer::Choice(index)) => Some(index),
            _ => None,
        })
    };
    let graded = move || task.attempt.with(|it| it.verdict.as_ref().map(Verdict::is_right));
    let choice = move |(index, text): (usize, String)| {
        let here = move || chosen() == Some(index);
        view! {
            <div class:right=move || here() && graded() == Some(true) class:off=move || here() && graded() == Some(false)>
                <label>
                    <input
                        type="radio"
                        name="choice"
                        prop:checked=here
                        on:change=move |_| task.answer(Answer::Choice(index))
                    />
                    <span>
                        <Words text />
                    </span>
                </label>
            </div>
        }
    };
    view! {
        <div class="choices" role="radiogroup" aria-labelledby="task-title">
            {texts.into_iter().enumerate().map(choice).collect_view()}
        </div>
    }
}

/// A number or bytes, typed.
#[component]
fn Typed(task: Task, #[prop(into)] start: String, label: &'static str) -> impl IntoView {
    let off =
        move || task.attempt.with(|it| matches!(it.verdict, Some(Verdict::Wrong(_) | Verdict::Unread(_))));
    let value = move || task.text().unwrap_or_else(|| start.clone());
    view! {
        <label class="typed">
            <span class="name">{label}</span>
            <input
                class="input mono"
                autocomplete="off"
                autocapitalize="off"
                spellcheck="false"
                aria-invalid=move || off().to_string()
                prop:value=value
                on:input=move |event| task.answer(Answer::Text(event_target_value(&event)))
            />
        </label>
    }
}

/// What the bytes are as far as they are typed.
#[component]
fn Live(task: Task, telegram: Telegram, #[prop(into)] start: String) -> impl IntoView {
    let lights = Lights::new();
    let check = telegram.check().filter(|check| check.covered.to + check.width == telegram.bytes.len());
    let typed = Memo::new(move |_| bytes(&task.text().unwrap_or_else(|| start.clone())));
    // Its place is kept free until all before it is there.
    let added = Memo::new(move |_| {
        let check = check.filter(|check| typed.with(Vec::len) <= check.covered.to)?;
        let algorithm = CHECKS.iter().find(|it| it.kind == check.kind)?;
        Some(typed.with(|typed| algorithm.wire(typed).to_be_bytes()[8 - check.width..].to_vec()))
    });
    let shown = Memo::new(move |_| {
        let mut whole = typed.get();
        if whole.is_empty() {
            return Vec::new();
        }
        whole.extend(added.get().unwrap_or_default());
        let report = telegram.with(whole.clone()).report();
        let detail = report.telegrams.len().checked_sub(1).and_then(|last| report.detail(last));
        detail.map_or(Vec::new(), |detail| blocks(&detail, &whole))
    });
    // What is off lights up.
    Effect::new(move |_| {
        let span = task.attempt.with(|attempt| {
            attempt.verdict.as_ref().and_then(|verdict| verdict.remarks().first().and_then(|it| it.span))
        });
        lights.chosen.set(span.filter(|span| !span.is_empty()).map(|span| Chosen { span, at: span.from }));
    });
    view! {
        <Show when=move || !shown.with(Vec::is_empty)>
            <ByteStrip blocks=shown lights size="small" label="The bytes so far. Arrow keys go from byte to byte." />
            <Show when=move || added.with(Option::is_some)>
                <p class="note">"The checksum is added by the page."</p>
            </Show>
        </Show>
    }
}

/// Bytes without a word, one of which is to be found.
#[component]
fn Pointed(task: Task) -> impl IntoView {
    let lights = Lights::new();
    let cells: Vec<Block> = task.here.with_value(|here| {
        let bytes = here.step().and_then(|step| step.report().telegrams.pop()).map(|it| it.line.bytes);
        let cell = |(at, byte): (usize, u8)| Block {
            name: String::new(),
            label: String::new(),
            caption: String::new(),
            class: "role-head",
            faulty: false,
            span: Span::new(at, at + 1),
            bytes: vec![byte],
        };
        bytes.unwrap_or_default().into_iter().enumerate().map(cell).collect()
    });
    let before = task.attempt.with_untracked(|it| it.answer.clone());
    if let Some(Answer::Byte(at)) = before {
        lights.chosen.set(Some(Chosen { span: Span::new(at, at + 1), at }));
    }
    Effect::new(move |before: Option<Option<usize>>| {
        let at = lights.chosen.get().map(|chosen| chosen.at);
        if let (Some(at), Some(before)) = (at, before)
            && before != Some(at)
        {
            task.answer(Answer::Byte(at));
        }
        at
    });
    view! { <ByteStrip blocks=cells lights size="bare" label="Choose a byte. Arrow keys go from byte to byte." /> }
}

/// A telegram with fields left blank.
#[component]
fn Blanks(task: Task, telegram: Telegram, spans: Vec<Span>) -> impl IntoView {
    let count = spans.len();
    let typed = move |index: usize| {
        task.attempt.with(|attempt| match &attempt.answer {
            Some(Answer::Blanks(texts)) => texts.get(index).cloned().unwrap_or_default(),
            _ => String::new(),
        })
    };
    let enter = move |index: usize, text: String| {
        let mut texts: Vec<String> = (0..count).map(|index| untrack(|| typed(index))).collect();
        texts[index] = text;
        task.answer(Answer::Blanks(texts));
    };
    let off = move |span: Span| {
        task.attempt.with(|attempt| {
            let remarks = attempt.verdict.as_ref().map_or(&[][..], Verdict::remarks);
            remarks.iter().any(|remark| remark.span.is_some_and(|it| it.from < span.to && span.from < it.to))
        })
    };
    let fields = telegram.detail().map_or(Vec::new(), |detail| blocks(&detail, &telegram.bytes));
    let block = move |block: Block| {
        let Block { name, label, class, span, bytes, .. } = block;
        let blank = spans.iter().position(|blank| *blank == span);
        let cells = match blank {
            Some(index) => view! {
                <input
                    class="input mono"
                    style:--bytes=span.len().to_string()
                    autocomplete="off"
                    autocapitalize="off"
                    spellcheck="false"
                    aria-label=format!("{name}, {} in hex", buslens::field::count(span.len(), "byte"))
                    aria-invalid=move || off(span).to_string()
                    prop:value=move || typed(index)
                    on:input=move |event| enter(index, event_target_value(&event))
                />
            }
            .into_any(),
            None => view! { <span class="cells"><code>{hex(&bytes)}</code></span> }.into_any(),
        };
        view! {
            <li class=class>
                <span class="label">{label}</span>
                {cells}
            </li>
        }
    };
    view! { <ol class="byte-strip small blanks" aria-label="A telegram with blanks">{fields.into_iter().map(block).collect_view()}</ol> }
}

/// What there is to say to the answer.
#[component]
fn Outcome(task: Task, then: String, here: Here) -> impl IntoView {
    let (then, here) = (Arc::<str>::from(then), StoredValue::new(here));
    let remark = |remark: &Remark| {
        let (field, text) = (remark.field.clone(), remark.text.sentence());
        // A sentence that begins with the field need not be told whose it is.
        let named = !field.is_empty() && !text.to_ascii_lowercase().contains(&field.to_ascii_lowercase());
        let end = if text.ends_with(['.', '?', '!']) { "" } else { "." };
        view! {
            <li>
                {named.then(|| view! { <b>{field} ": "</b> })}
                <Words text=format!("{text}{end}") />
            </li>
        }
    };
    let shown = move || {
        let verdict = task.attempt.with(|attempt| attempt.verdict.clone())?;
        Some(match verdict {
            Verdict::Right(more) => view! {
                <div class="outcome right">
                    <p class="verdict good">
                        <Icon glyph=Glyph::Tick />
                        "Right"
                    </p>
                    {more.map(|more| view! { <p>{more.sentence()} "."</p> })}
                    <p><Words text=then.to_string() /></p>
                    <Onward here=here.get_value() />
                </div>
            }
            .into_any(),
            Verdict::Wrong(remarks) => view! {
                <div class="outcome off">
                    <p class="verdict warn">
                        <Icon glyph=Glyph::Undo />
                        "Not yet"
                    </p>
                    <ul>{remarks.iter().take(3).map(remark).collect_view()}</ul>
                </div>
            }
            .into_any(),
            Verdict::Unread(message) => view! {
                <div class="outcome off">
                    <p>{message.sentence()} "."</p>
                </div>
            }
            .into_any(),
        })
    };
    view! { <div role="status">{shown}</div> }
}

/// To the next step, or to the next lesson.
#[component]
fn Onward(here: Here) -> impl IntoView {
    let state = expect_context::<LearnState>().lessons;
    let lesson = here.course.lesson.clone();
    if here.step + 1 < lesson.steps.len() {
        return view! {
            <a class="button main" href=link_to(&lesson, here.step + 1)>
                "Next step"
                <Icon glyph=Glyph::Forward />
            </a>
        }
        .into_any();
    }
    let all = untrack(|| state.courses());
    let next = all.iter().skip_while(|it| it.lesson.key != lesson.key).nth(1).cloned();
    view! {
        <p>{format!("That was “{}”.", lesson.title)}</p>
        {match next {
            Some(next) => {
                view! {
                    <a class="button main" href=link_to(&next.lesson, 0)>
                        {format!("Next lesson: {}", next.lesson.title)}
                        <Icon glyph=Glyph::Forward />
                    </a>
                }
                    .into_any()
            }
            None => view! { <a class="button" href="#/learn?place=lessons">"All lessons"</a> }.into_any(),
        }}
    }
    .into_any()
}

/// Asks for one hint more, and in the end for the answer.
#[component]
fn HintButton(task: Task, count: usize, right: Option<Answer>) -> impl IntoView {
    let shown = move || task.attempt.with(|attempt| attempt.hints);
    let is_right = move || task.attempt.with(|it| it.verdict.as_ref().is_some_and(Verdict::is_right));
    let more = move |_| {
        if shown() < count {
            task.state.change(&task.place(), |attempt| attempt.hints += 1);
        } else if let Some(right) = right.clone() {
            task.answer(right);
        }
    };
    let label = move || match shown() {
        0 => "Give me a hint".to_owned(),
        shown if shown < count => format!("Another hint, {} of {count}", shown + 1),
        _ => "Fill in the answer".to_owned(),
    };
    view! {
        <button type="button" class="button" hidden=is_right on:click=more>
            <Icon glyph=Glyph::Hint />
            {label}
        </button>
    }
}

#[component]
fn Hints(task: Task, hints: Vec<String>) -> impl IntoView {
    let shown = Memo::new(move |_| task.attempt.with(|attempt| attempt.hints));
    let rows = move || {
        let hint = |text: &String| view! { <li><Icon glyph=Glyph::Hint /><span><Words text=text.clone() /></span></li> };
        hints.iter().take(shown.get()).map(hint).collect_view()
    };
    view! { <ol class="hints" aria-label="Hints" aria-live="polite">{rows}</ol> }
}

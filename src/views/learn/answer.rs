//! Where a task is answered, and what there is to say to the answer: the same in lessons and in practice.

use leptos::prelude::*;

use super::words::Words;
use crate::components::byte_strip::{Block, Chosen, Lights};
use crate::components::icon::{Glyph, Icon};
use buslens::field::{Span, count, hex};
use buslens_trainer::{Answer, Remark, Verdict, letter};

/// A task that somebody answers.
#[derive(Clone, Copy)]
pub struct Answering {
    pub answer: Signal<Option<Answer>>,
    pub verdict: Signal<Option<Verdict>>,
    /// It is over: nothing can be changed any more.
    pub done: Signal<bool>,
    pub on_answer: Callback<Answer>,
}

impl Answering {
    /// What was typed.
    pub fn text(self) -> Option<String> {
        self.answer.with(|answer| match answer {
            Some(Answer::Text(text)) => Some(text.clone()),
            _ => None,
        })
    }

    fn has_chosen(self, index: usize) -> bool {
        self.answer.with(|answer| *answer == Some(Answer::Choice(index)))
    }

    /// Whether the answer was checked, and found right or not.
    fn is_checked(self, right: bool) -> bool {
        self.verdict.with(|verdict| verdict.as_ref().is_some_and(|it| it.is_right() == right))
    }

    /// Whether something is off in these bytes.
    fn is_off(self, span: Span) -> bool {
        self.verdict.with(|verdict| {
            let remarks = verdict.as_ref().map_or(&[][..], Verdict::remarks);
            remarks.iter().any(|it| it.span.is_some_and(|it| it.from < span.to && span.from < it.to))
        })
    }

    /// Takes the byte that is chosen in a strip for the answer.
    pub fn take_byte(self, lights: Lights) {
        if let Some(Answer::Byte(at)) = self.answer.get_untracked() {
            lights.chosen.set(Some(Chosen { span: Span::new(at, at + 1), at }));
        }
        Effect::new(move |before: Option<Option<usize>>| {
            let at = lights.chosen.get().map(|chosen| chosen.at);
            if let (Some(byte), Some(before)) = (at, before)
                && before != at
                && !self.done.get_untracked()
            {
                self.on_answer.run(Answer::Byte(byte));
            }
            at
        });
    }
}

/// Sentences, one of which is right.
#[component]
pub fn Choices(answering: Answering, texts: Vec<String>) -> impl IntoView {
    let choice = move |(index, text): (usize, String)| {
        let chosen = move || answering.has_chosen(index);
        view! {
            <label
                class="choice"
                class:right=move || chosen() && answering.is_checked(true)
                class:off=move || chosen() && answering.is_checked(false)
            >
                <input
                    type="radio"
                    name="choice"
                    prop:checked=chosen
                    prop:disabled=answering.done
                    on:change=move |_| answering.on_answer.run(Answer::Choice(index))
                />
                <span class="soft">{letter(index)} ")"</span>
                <span>
                    <Words text />
                </span>
            </label>
        }
    };
    view! {
        <fieldset class="choices">
            <legend class="unseen">"Choices"</legend>
            {texts.into_iter().enumerate().map(choice).collect_view()}
        </fieldset>
    }
}

/// A field for hex and numbers.
#[component]
fn Input(
    answering: Answering,
    #[prop(into)] text: Signal<String>,
    #[prop(into)] off: Signal<bool>,
    on_type: Callback<String>,
    /// Where no label stands beside it.
    #[prop(optional)]
    name: Option<String>,
    /// How many bytes go in, where that is known.
    #[prop(optional)]
    bytes: Option<usize>,
) -> impl IntoView {
    view! {
        <input
            class="input mono"
            style:--bytes=bytes.map(|bytes| bytes.to_string())
            placeholder=bytes.map(|bytes| vec!["__"; bytes].join(" "))
            autocomplete="off"
            autocapitalize="off"
            spellcheck="false"
            aria-label=name
            aria-invalid=move || off.get().to_string()
            prop:value=text
            prop:readOnly=answering.done
            on:input=move |event| on_type.run(event_target_value(&event))
        />
    }
}

/// A number or bytes, typed.
#[component]
pub fn Typed(
    answering: Answering,
    #[prop(into)] label: String,
    /// How it is written.
    #[prop(optional)]
    how: &'static str,
    /// What stands there at first.
    #[prop(into, optional)]
    start: String,
    /// A number is no longer than this.
    #[prop(optional)]
    short: bool,
) -> impl IntoView {
    let text = Signal::derive(move || answering.text().unwrap_or_else(|| start.clone()));
    let off = Signal::derive(move || answering.is_checked(false));
    view! {
        <label class="typed" class:short=short>
            <span>{label} " " <small class="soft">{how}</small></span>
            <Input
                answering
                text
                off
                on_type=Callback::new(move |text| answering.on_answer.run(Answer::Text(text)))
            />
        </label>
    }
}

/// A telegram some of whose fields are to be filled in.
#[component]
pub fn Blanks(answering: Answering, blocks: Vec<Block>, spans: Vec<Span>) -> impl IntoView {
    let length = spans.len();
    let texts = move || {
        answering.answer.with(|answer| match answer {
            Some(Answer::Blanks(texts)) => texts.clone(),
            _ => vec![String::new(); length],
        })
    };
    let block = move |block: Block| {
        let Block { name, label, class, span, bytes, .. } = block;
        let blank = spans.iter().position(|blank| *blank == span);
        let cells = match blank {
            Some(index) => {
                let text = Signal::derive(move || texts().get(index).cloned().unwrap_or_default());
                let off = Signal::derive(move || answering.is_off(span));
                let enter = move |text| {
                    let mut all = untrack(texts);
                    all.resize(length, String::new());
                    all[index] = text;
                    answering.on_answer.run(Answer::Blanks(all));
                };
                let name = format!("{name}, {} in hex", count(span.len(), "byte"));
                view! { <Input answering text off name bytes=span.len() on_type=Callback::new(enter) /> }
                    .into_any()
            }
            None => view! { <code>{hex(&bytes)}</code> }.into_any(),
        };
        view! {
            <li class=class class:blank=blank.is_some()>
                <span class="label">{label}</span>
                {cells}
            </li>
        }
    };
    view! {
        <ol class="byte-strip small blanks" aria-label="A telegram with blanks">
            {blocks.into_iter().map(block).collect_view()}
        </ol>
    }
}

/// What there is to say to an answer, and to one that is right what else there is to know.
pub fn said(verdict: Verdict, then: impl FnOnce() -> AnyView) -> AnyView {
    let remark = |Remark { field, text, .. }: Remark| {
        let text = text.sentence();
        // A sentence that has the field in it need not be told whose it is.
        let named = !field.is_empty() && !text.to_ascii_lowercase().contains(&field.to_ascii_lowercase());
        let end = if text.ends_with(['.', '?', '!']) { "" } else { "." };
        let text = format!("{}{text}{end}", if named { format!("{field}: ") } else { String::new() });
        view! { <li><Words text /></li> }
    };
    match verdict {
        Verdict::Right(more) => view! {
            <div class="said right">
                <p class="verdict good">
                    <Icon glyph=Glyph::Tick />
                    "Right."
                </p>
                {more.map(|more| view! { <p>{more.sentence()} "."</p> })}
                {then()}
            </div>
        }
        .into_any(),
        Verdict::Wrong(remarks) => view! {
            <div class="said wrong">
                <p class="verdict warn">
                    <Icon glyph=Glyph::Undo />
                    "Not yet."
                </p>
                <ul>{remarks.into_iter().take(3).map(remark).collect_view()}</ul>
            </div>
        }
        .into_any(),
        Verdict::Unread(message) => view! {
            <div class="said unread">
                <p>{message.sentence()} "."</p>
            </div>
        }
        .into_any(),
    }
}

/// Hints, as far as they were asked for.
#[component]
pub fn Hints(hints: Vec<String>, #[prop(into)] shown: Signal<usize>) -> impl IntoView {
    let hint =
        |text: &String| view! { <li><Icon glyph=Glyph::Hint /><span><Words text=text.clone() /></span></li> };
    let rows = move || hints.iter().take(shown.get()).map(hint).collect_view();
    view! { <ol class="hints" aria-label="Hints" aria-live="polite">{rows}</ol> }
}

/// Asks for one hint more, and in the end for the answer.
#[component]
pub fn Help(
    count: usize,
    #[prop(into)] shown: Signal<usize>,
    /// The answer is offered, too.
    #[prop(into)]
    answer: Signal<bool>,
    /// What the answer is asked for by.
    label: &'static str,
    on_hint: Callback<()>,
    on_answer: Callback<()>,
) -> impl IntoView {
    let next = move || match shown.get() {
        0 => "Give me a hint".to_owned(),
        shown => format!("Another hint, {} of {count}", shown + 1),
    };
    let told = move || shown.get() >= count;
    view! {
        <button type="button" class="button" hidden=told on:click=move |_| on_hint.run(())>
            <Icon glyph=Glyph::Hint />
            {next}
        </button>
        <button type="button" class="button plain" hidden=move || !answer.get() on:click=move |_| on_answer.run(())>
            {label}
        </button>
    }
}

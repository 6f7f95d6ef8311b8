//! Where a task is answered, and what there is to say to the answer: the same in lessons and in practice.

use leptos::prelude::*;

use super::attempt::Attempt;
use super::words::Words;
use crate::components::button::Button;
use crate::components::byte_strip::{Block, Chosen, Lights};
use crate::components::icon::{Glyph, Icon};
use buslens::field::{Span, count, hex};
use buslens_trainer::{Answer, Remark, Verdict, letter};

/// A task that somebody answers.
#[derive(Clone, Copy)]
pub struct Answering {
    pub attempt: Memo<Attempt>,
    pub on_change: Callback<Attempt>,
}

impl Answering {
    pub fn change(self, change: impl FnOnce(&mut Attempt)) {
        let mut attempt = self.attempt.get_untracked();
        change(&mut attempt);
        self.on_change.run(attempt);
    }

    pub fn enter(self, answer: Answer) {
        self.change(|attempt| attempt.enter(answer));
    }

    /// What was typed.
    pub fn text(self) -> Option<String> {
        self.attempt.with(|attempt| attempt.text().map(str::to_owned))
    }

    /// Whether what is chosen was checked, and found right or not.
    fn is_checked(self, right: bool) -> bool {
        self.attempt.with(|attempt| attempt.is_checked(right))
    }

    fn is_closed(self) -> bool {
        self.attempt.with(Attempt::is_closed)
    }

    /// Whether something is off in these bytes.
    fn is_off(self, span: Span) -> bool {
        self.attempt.with(|attempt| {
            let remarks = attempt.verdict.as_ref().map_or(&[][..], Verdict::remarks);
            remarks.iter().any(|it| it.span.is_some_and(|it| it.from < span.to && span.from < it.to))
        })
    }

    /// Takes the byte that is chosen in a strip for the answer.
    pub fn take_byte(self, lights: Lights) {
        if let Some(Answer::Byte(at)) = self.attempt.with_untracked(|attempt| attempt.answer.clone()) {
            lights.chosen.set(Some(Chosen { span: Span::new(at, at + 1), at }));
        }
        Effect::new(move |before: Option<Option<usize>>| {
            let at = lights.chosen().map(|chosen| chosen.at);
            if let (Some(byte), Some(before)) = (at, before)
                && before != at
                && !self.attempt.with_untracked(Attempt::is_closed)
            {
                self.enter(Answer::Byte(byte));
            }
            at
        });
    }
}

/// Sentences, one of which is right.
#[component]
pub fn Choices(answering: Answering, texts: Vec<String>) -> AnyView {
    let choice = move |(index, text): (usize, String)| {
        let chosen = move || answering.attempt.with(|attempt| attempt.answer == Some(Answer::Choice(index)));
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
                    prop:disabled=move || answering.is_closed()
                    on:change=move |_| answering.enter(Answer::Choice(index))
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
    .into_any()
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
) -> AnyView {
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
            prop:readOnly=move || answering.is_closed()
            on:input=move |event| on_type.run(event_target_value(&event))
        />
    }
    .into_any()
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
) -> AnyView {
    let text = Signal::derive(move || answering.text().unwrap_or_else(|| start.clone()));
    let off = Signal::derive(move || answering.is_checked(false));
    view! {
        <label class="typed" class:short=short>
            <span>{label} " " <small class="soft">{how}</small></span>
            <Input
                answering
                text
                off
                on_type=Callback::new(move |text| answering.enter(Answer::Text(text)))
            />
        </label>
    }
    .into_any()
}

/// A telegram some of whose fields are to be filled in.
#[component]
pub fn Blanks(answering: Answering, blocks: Vec<Block>, spans: Vec<Span>) -> AnyView {
    let length = spans.len();
    let texts = move || {
        answering.attempt.with(|attempt| match &attempt.answer {
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
                    answering.enter(Answer::Blanks(all));
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
    .into_any()
}

/// What there is to say to an answer, and to one that is right what else there is to know.
pub fn said(verdict: Verdict, then: &dyn Fn() -> AnyView) -> AnyView {
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
pub fn Hints(answering: Answering, hints: Vec<String>) -> AnyView {
    let shown = Memo::new(move |_| answering.attempt.with(|attempt| attempt.hints));
    let hint =
        |text: &String| view! { <li><Icon glyph=Glyph::Hint /><span><Words text=text.clone() /></span></li> };
    let rows = move || hints.iter().take(shown.get()).map(hint).collect_view();
    view! { <ol class="hints" aria-label="Hints" aria-live="polite">{move || rows()}</ol> }.into_any()
}

/// Who gave so many wrong answers need not go through all hints.
const STUCK: usize = 3;

/// Asks for one hint more, and in the end for the answer.
#[component]
pub fn Help(
    answering: Answering,
    /// How many hints there are.
    count: usize,
    /// What the answer is asked for by.
    label: &'static str,
    on_answer: Callback<()>,
) -> AnyView {
    let hints =
        move || answering.attempt.with(|attempt| if attempt.is_over() { count } else { attempt.hints });
    let unasked = move || {
        let attempt = answering.attempt.get();
        attempt.is_over() || attempt.hints < count && attempt.wrong < STUCK
    };
    let next = move || match hints() {
        0 => "Give me a hint".to_owned(),
        shown => format!("Another hint, {} of {count}", shown + 1),
    };
    view! {
        <Button
            glyph=Glyph::Hint
            label=Signal::derive(next)
            hidden=Signal::derive(move || hints() >= count)
            on_press=move |()| answering.change(|attempt| attempt.hints += 1)
        />
        <Button class="button plain" label hidden=Signal::derive(unasked) on_press=on_answer />
    }
    .into_any()
}

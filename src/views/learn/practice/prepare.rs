//! Where a set of tasks is prepared: some from practice, some of one's own plant. The set is a text all the time,
//! and what is done here changes that.

use std::time::Duration;

use leptos::ev::SubmitEvent;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use web_sys::HtmlElement;

use super::open_text;
use super::parts::{lines, select, to_start};
use super::start::any_seed;
use crate::browser::file;
use crate::components::button::Button;
use crate::components::choose::choices;
use crate::components::fold::Fold;
use crate::components::icon::Glyph;
use crate::components::toast::Toasts;
use crate::views::learn::LearnState;
use crate::views::learn::mistakes::{Mistakes, Refused};
use crate::views::read::ReadState;
use buslens::tool::{PROFILES, Profile};
use buslens_trainer::fault::Fault;
use buslens_trainer::log::{Find, Log, Spoil};
use buslens_trainer::practice::{Kind, LEVELS, QUESTIONS, Round};
use buslens_trainer::random::Random;
use buslens_trainer::set::{self, Hide, Set as Tasks};

use super::state::PracticeState;

/// What can be hidden or found in what somebody pastes: a group in the list, its words, and what it is.
const HIDDEN: [(&str, Hide); 3] = [
    ("Whatever fits, by chance", Hide::Any),
    ("A log as it is: what is wrong?", Hide::Log(Find::Fault)),
    ("A log as it is: who does not answer?", Hide::Log(Find::Unit)),
];

/// All that can be hidden, with its words.
fn hidden() -> Vec<(Hide, String)> {
    let plain = HIDDEN.into_iter().map(|(words, hide)| (hide, words.to_owned()));
    let faults = Fault::ALL.into_iter().map(|it| (Hide::Fault(it), format!("In a telegram: {}", it.label())));
    let spoils = Spoil::ALL.into_iter().map(|it| (Hide::Spoil(it), format!("In a log: {}", it.label())));
    plain.chain(faults).chain(spoils).collect()
}

/// `from_read` takes what is in Read.
pub fn prepare(from_read: bool) -> AnyView {
    let learn = expect_context::<LearnState>();
    let state = learn.practice;
    let toasts = expect_context::<Toasts>();
    if from_read {
        untrack(|| take(state, expect_context()));
    }
    let read = Memo::new(move |_| {
        let (set, mistakes) = state.draft.with(|text| set::read(text));
        Draft { set, mistakes }
    });
    let empty = Signal::derive(move || state.draft.with(|text| set::places(text).is_empty()));
    let wrong = move || {
        let mistakes = read.with(|draft| draft.mistakes.clone());
        (!mistakes.is_empty() && !empty.get()).then(|| {
            let refused = Refused { said: "This is not a set yet.".to_owned(), mistakes };
            view! { <Mistakes refused /> }
        })
    };
    let rows = move || {
        let places = state.draft.with(|text| set::places(text).len());
        read.with(|draft| (0..places).map(|at| row(state, &draft.set, at, places)).collect::<Vec<_>>())
    };
    let none = move || empty.get().then(|| view! { <p class="note">"No task is in it yet."</p> });
    let save = move |()| {
        let name = read.with_untracked(|draft| file_name(&draft.set.title));
        file::save(&name, &state.draft.get_untracked());
    };
    let open = move |()| open_text(learn, "The set", &state.draft.get_untracked());
    let anew = move |()| {
        let before = state.draft.get_untracked();
        state.prepare(set::empty("My set"));
        toasts.offer("The set is empty again.", "Undo", move || state.prepare(before.clone()));
    };
    let unready = Signal::derive(move || read.with(|draft| !draft.mistakes.is_empty()));
    let title = Signal::derive(move || read.with(|draft| draft.set.title.clone()));
    let text = move || {
        lines(
            "The set as a text",
            "14",
            "# My set",
            state.draft.into(),
            Callback::new(move |text| state.prepare(text)),
        )
    };
    view! {
        {to_start(learn)}
        <div class="prepare">
            <header>
                <h3 class="headline">"Prepare a set of tasks"</h3>
                <p class="intro">
                    "Choose tasks, put them in order, and give the set to your group as a file or as a link. It is opened here, and asks everybody the same. This browser keeps what you prepare."
                </p>
            </header>
            {move || wrong()}
            {titled("Title", title, "set-title".to_owned(), Callback::new(move |title: String| {
                state.prepare(set::titled(&state.draft.get_untracked(), None, &title));
            }))}
            <ol class="chosen-tasks" aria-label="Tasks of the set">{move || rows()}</ol>
            {move || none()}
            <div class="acts">
                <Button class="button main" glyph=Glyph::Forward label="Open the set" disabled=unready on_press=open />
                <Button glyph=Glyph::Save label="Save as a file" disabled=empty on_press=save />
                <Button class="button plain" glyph=Glyph::Undo label="Begin anew" on_press=anew />
            </div>
            <p class="note">"Open it for its link, its handout, the wall, and Moodle."</p>
            <div class="adding">
                {from_practice(state, toasts)}
                {from_plant(state, toasts)}
            </div>
            <Fold summary=ViewFn::from(|| "The set as a text")>{text()}</Fold>
        </div>
    }
    .into_any()
}

/// The set as far as it is read.
#[derive(Clone)]
struct Draft {
    set: Tasks,
    mistakes: Vec<buslens_trainer::lesson::Mistake>,
}

/// It is read anew only when the text changes.
impl PartialEq for Draft {
    fn eq(&self, _: &Self) -> bool {
        false
    }
}

/// A title that is typed; it counts once the field is left.
fn titled(label: &'static str, title: Signal<String>, id: String, on_change: Callback<String>) -> AnyView {
    view! {
        <label class="typed">
            <span>{label}</span>
            <input
                class="input"
                id=id
                maxlength="80"
                autocomplete="off"
                prop:value=title
                on:change=move |event| on_change.run(event_target_value(&event))
            />
        </label>
    }
    .into_any()
}

/// A task of the set.
fn row(state: PracticeState, set: &Tasks, at: usize, places: usize) -> AnyView {
    let own: Vec<_> = set.tasks.iter().filter(|task| task.place == at).collect();
    let asked = match own.as_slice() {
        [] => "It cannot be asked yet.".to_owned(),
        [one] => one.task.question.clone(),
        [first, ..] => format!("{} questions, the first: {}", own.len(), first.task.question),
    };
    // Without a task it stands in the text alone.
    let title = own.first().map(|task| task.title.clone()).unwrap_or_else(|| {
        let text = state.draft.get_untracked();
        let place = set::places(&text).get(at).cloned().unwrap_or_default();
        text[place].lines().next().unwrap_or_default().trim_start_matches("## ").to_owned()
    });
    let change = move |change: &dyn Fn(&str) -> String| state.prepare(change(&state.draft.get_untracked()));
    let renamed = move |title: String| change(&|text| set::titled(text, Some(at), &title));
    let moved = move |from: usize, to: usize| {
        change(&|text| set::later(text, from));
        focus(format!("task-{to}"));
    };
    let (first, last) = (at == 0, at + 1 == places);
    let number = at + 1;
    let icon = |glyph: Glyph, label: String, disabled: bool, on_press: Callback<()>| {
        view! { <Button class="button plain icon-only" glyph label disabled on_press /> }
    };
    view! {
        <li>
            {titled("Title of the task", Signal::stored(title), format!("task-{at}"), Callback::new(renamed))}
            <p class="soft">{asked}</p>
            <div class="acts">
                {icon(
                    Glyph::Up,
                    format!("Move task {number} up"),
                    first,
                    Callback::new(move |()| moved(at - 1, at - 1)),
                )}
                {icon(
                    Glyph::Down,
                    format!("Move task {number} down"),
                    last,
                    Callback::new(move |()| moved(at, at + 1)),
                )}
                {icon(
                    Glyph::Close,
                    format!("Remove task {number}"),
                    false,
                    Callback::new(move |()| change(&|text| set::without(text, at))),
                )}
            </div>
        </li>
    }
    .into_any()
}

/// Gives a field the focus once it is drawn.
fn focus(id: String) {
    let focus = move || {
        let field = document().get_element_by_id(&id).and_then(|field| field.dyn_into::<HtmlElement>().ok());
        let _ = field.map(|field| field.focus());
    };
    set_timeout(focus, Duration::ZERO);
}

/// Puts a task at the end of the set.
fn add(state: PracticeState, toasts: Toasts, title: &str, lines: &str) {
    state.prepare(set::with(&state.draft.get_untracked(), title, lines));
    toasts.say(format!("“{title}” is the last task of the set now."));
}

fn from_practice(state: PracticeState, toasts: Toasts) -> AnyView {
    let kind = RwSignal::new(Kind::Decode.key().to_owned());
    let level = RwSignal::new(LEVELS.start().to_string());
    let kinds = choices(Kind::ALL.map(|kind| (kind.key(), kind.label())));
    let levels = LEVELS.map(|level| (level.to_string(), format!("Level {level}"))).collect();
    let add = move |whole: bool| {
        let kind = Kind::of(&kind.get_untracked()).unwrap_or(Kind::Decode);
        let level = level.get_untracked().parse().unwrap_or(1);
        let round = Round { kind, level, seed: any_seed() };
        let lines = match whole {
            true => set::of_rounds(&round),
            false => set::of_round(&round, any_seed().number() as usize % QUESTIONS),
        };
        add(state, toasts, kind.label(), &lines);
    };
    view! {
        <section>
            <h4>"From practice"</h4>
            {select("Kind", kinds, kind)}
            {select("Level", levels, level)}
            <div class="acts">
                <Button glyph=Glyph::Add label="Add a question" on_press=move |()| add(false) />
                <Button class="button plain" label=format!("All {QUESTIONS} of a round") on_press=move |()| add(true) />
            </div>
        </section>
    }
    .into_any()
}

fn from_plant(state: PracticeState, toasts: Toasts) -> AnyView {
    let read = expect_context::<ReadState>();
    let all = hidden();
    let options = all.iter().enumerate().map(|(at, (_, words))| (at.to_string(), words.clone())).collect();
    let chosen = RwSignal::new("0".to_owned());
    let device = RwSignal::new(String::new());
    let devices = PROFILES.iter().map(|device| (device.key, device.label));
    let devices = choices(std::iter::once(("", "Any")).chain(devices));
    let refused = RwSignal::new(String::new());
    let make = move |event: SubmitEvent| {
        event.prevent_default();
        let at: usize = chosen.get_untracked().parse().unwrap_or_default();
        let hide = all.get(at).map_or(Hide::Any, |(hide, _)| *hide);
        let device = Profile::of(&device.get_untracked());
        let mut random = Random::of(&[any_seed().number().into()]);
        let made = state.own.with_untracked(|text| set::made(text, device, hide, &mut random));
        match made {
            Ok((title, lines)) => {
                refused.set(String::new());
                add(state, toasts, title, &lines);
            }
            Err(why) => refused.set(why),
        }
    };
    let typed = move |text| {
        refused.set(String::new());
        state.own.set(text);
    };
    view! {
        <form on:submit=make>
            <h4>"From your plant"</h4>
            {lines("A telegram, a request and its response, or a log", "5", "01 03 00 C8 00 03 84 35", state.own.into(), Callback::new(typed))}
            <Button class="button low" glyph=Glyph::Read label="Take it from Read" on_press=move |()| untrack(|| take(state, read)) />
            {select("What is to be found", options, chosen)}
            {select("Device", devices, device)}
            <p class="misfit" role="alert">{refused}</p>
            <button type="submit" class="button">"Add the task"</button>
        </form>
    }
    .into_any()
}

/// Takes what is in Read: all of a few telegrams, of a long log those around the one that is shown.
fn take(state: PracticeState, read: ReadState) {
    /// Longer texts take too long to be read here.
    const LONGEST: usize = 4_000_000;
    let text = read.text();
    if text.trim().is_empty() || text.len() > LONGEST {
        return state.say(match read.is_text() && text.is_empty() {
            true => "Nothing is in Read yet.",
            false => "What is in Read is a large file: paste the lines that matter.",
        });
    }
    let current = read.log.current.get().map(|current| current.told.row.index);
    state.own.set(Log::excerpt(&text, read.options(), current.unwrap_or_default()));
}

/// A name for the file, after the title.
fn file_name(title: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { ' ' };
    let words: String = title.chars().map(plain).collect();
    let words: Vec<&str> = words.split_whitespace().collect();
    format!("{}.txt", if words.is_empty() { "set".to_owned() } else { words.join("-") })
}

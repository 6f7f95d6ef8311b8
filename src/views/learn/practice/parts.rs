//! What the screens of Practice are made of. Each is drawn by one function, so that the module holds it once.

use leptos::prelude::*;
use web_sys::{File, FileList};

use super::go;
use super::state::Where;
use crate::components::icon::{Glyph, Icon};
use crate::views::learn::LearnState;
use buslens_trainer::lesson::Mistake;

/// A button with a sign and a word.
pub fn button(
    class: &'static str,
    glyph: impl Into<Option<Glyph>>,
    label: impl Into<Signal<String>>,
    act: impl Fn() + Send + Sync + 'static,
) -> AnyView {
    pressed(class, glyph.into(), label.into(), Signal::stored(false), Callback::new(move |()| act()))
}

/// The same that can be pressed at times.
pub fn pressed(
    class: &'static str,
    glyph: Option<Glyph>,
    label: Signal<String>,
    disabled: Signal<bool>,
    act: Callback<()>,
) -> AnyView {
    let sign = move || glyph.map(|glyph| view! { <Icon glyph /> });
    // What leads on has its sign behind the word.
    let (before, after) = if glyph == Some(Glyph::Forward) { (None, sign()) } else { (sign(), None) };
    let icon_only = class.contains("icon-only");
    view! {
        <button type="button" class=class prop:disabled=disabled on:click=move |_| act.run(())>
            {before}
            <span class:unseen=icon_only>{label}</span>
            {after}
        </button>
    }
    .into_any()
}

/// The way back to where practice begins.
pub fn to_start(learn: LearnState) -> AnyView {
    button("button plain low back", Glyph::Back, "All kinds", move || go(learn, Where::Start))
}

/// The files of a list.
pub fn files(list: Option<FileList>) -> impl Iterator<Item = File> {
    let files: Vec<File> = match list {
        Some(list) => (0..list.length()).filter_map(|at| list.get(at)).collect(),
        None => Vec::new(),
    };
    files.into_iter()
}

/// A choice from a list: value and words of each.
pub fn select(label: &'static str, options: Vec<(String, String)>, chosen: RwSignal<String>) -> AnyView {
    let option = |(value, words): (String, String)| {
        let own = value.clone();
        view! { <option value=value prop:selected=move || chosen.with(|chosen| *chosen == own)>{words}</option> }
    };
    view! {
        <label class="typed short">
            <span>{label}</span>
            <select class="select" on:change=move |event| chosen.set(event_target_value(&event))>
                {options.into_iter().map(option).collect_view()}
            </select>
        </label>
    }
    .into_any()
}

/// A place for many lines.
pub fn lines(
    label: &'static str,
    rows: &'static str,
    placeholder: &'static str,
    text: impl Into<Signal<String>>,
    on_type: impl Fn(String) + 'static,
) -> AnyView {
    let text = text.into();
    view! {
        <label class="typed">
            <span>{label}</span>
            <textarea
                class="input mono"
                rows=rows
                spellcheck="false"
                placeholder=placeholder
                prop:value=text
                on:input=move |event| on_type(event_target_value(&event))
            ></textarea>
        </label>
    }
    .into_any()
}

/// What is wrong in a text, line by line.
pub fn mistakes(said: String, all: &[Mistake]) -> AnyView {
    /// More are not shown at once.
    const MOST: usize = 20;
    let row = |mistake: &Mistake| {
        view! {
            <li>
                <b>{format!("Line {}", mistake.line)}</b>
                <span>{mistake.said.clone()}</span>
            </li>
        }
    };
    let rows: Vec<_> = all.iter().take(MOST).map(row).collect();
    view! {
        <section class="mistakes" role="alert">
            <p>
                <Icon glyph=Glyph::Warning />
                <b>{said}</b>
            </p>
            <ol>{rows}</ol>
        </section>
    }
    .into_any()
}

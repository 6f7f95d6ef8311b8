//! What the screens of Practice are made of. Each is drawn by one function, so that the module holds it once.

use leptos::prelude::*;
use web_sys::{File, FileList};

use super::go;
use super::state::Where;
use crate::components::button::Button;
use crate::components::choose::{Choice, Choose};
use crate::components::icon::Glyph;
use crate::views::learn::LearnState;

/// The way back to where practice begins.
pub fn to_start(learn: LearnState) -> AnyView {
    let to = move |()| go(learn, Where::Start);
    view! { <Button class="button plain low back" glyph=Glyph::Back label="All kinds" on_press=to /> }
        .into_any()
}

/// The files of a list.
pub fn files(list: Option<FileList>) -> impl Iterator<Item = File> {
    let files: Vec<File> = match list {
        Some(list) => (0..list.length()).filter_map(|at| list.get(at)).collect(),
        None => Vec::new(),
    };
    files.into_iter()
}

/// A choice from a list.
pub fn select(label: &'static str, options: Vec<Choice>, chosen: RwSignal<String>) -> AnyView {
    let on_choose = Callback::new(move |key| chosen.set(key));
    view! { <Choose class="typed short" of_list="select" label options value=chosen on_choose /> }.into_any()
}

/// A place for many lines.
pub fn lines(
    label: &'static str,
    rows: &'static str,
    placeholder: &'static str,
    text: Signal<String>,
    on_type: Callback<String>,
) -> AnyView {
    view! {
        <label class="typed">
            <span>{label}</span>
            <textarea
                class="input mono"
                rows=rows
                spellcheck="false"
                placeholder=placeholder
                prop:value=text
                on:input=move |event| on_type.run(event_target_value(&event))
            ></textarea>
        </label>
    }
    .into_any()
}

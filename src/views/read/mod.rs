//! Read: paste, type, drop or open anything of any size.

mod editor;
mod examples;
mod log;
mod log_view;
mod open_file;
mod reading;
mod start;
mod state;
mod telegrams;
mod times;

use leptos::ev;
use leptos::prelude::*;

use crate::browser::typing::is_typed_into;
use crate::components::icon::{Glyph, Icon};
use crate::later::{CouldNotLoad, Later, LaterPiece, Part, Piece};
use editor::Editor;
use examples::Examples;
use open_file::OpenFile;
use reading::{Beside, ProposedDevice, ReadAs, ReadingChoices};
use start::Start;
use state::Mode;
use telegrams::Telegrams;

pub use log_view::LogView;
pub use state::ReadState;

#[component]
pub fn Read() -> impl IntoView {
    let read = expect_context::<ReadState>();
    let later = expect_context::<Later>();
    // What is pasted where nothing is typed is meant for the input.
    let pasted = window_event_listener(ev::paste, move |event| {
        let text = event.clipboard_data().and_then(|data| data.get_data("text").ok());
        if let Some(text) = text.filter(|text| !text.is_empty() && !is_typed_into(event.target())) {
            event.prevent_default();
            read.load(text);
        }
    });
    on_cleanup(move || pasted.remove());
    let has_editor = Memo::new(move |_| read.mode() != Mode::Log || read.editing.get());
    let below = move || match read.mode() {
        Mode::Start => view! { <Start /> }.into_any(),
        Mode::Telegrams => view! { <Telegrams /> }.into_any(),
        Mode::Log => view! { <LaterPiece piece=Piece::Log /> }.into_any(),
    };
    view! {
        <Show when=move || has_editor.get()>
            <Input />
        </Show>
        <Show when=move || read.mode() == Mode::Telegrams && later.has_failed(Part::Log)>
            <CouldNotLoad part=Part::Log>
                "What reads logs could not be loaded: check the connection. Telegrams can be read one by one."
            </CouldNotLoad>
        </Show>
        {below}
    }
}

/// Where telegrams are pasted, and how they are read.
#[component]
fn Input() -> impl IntoView {
    let read = expect_context::<ReadState>();
    view! {
        <section class="input-bar" aria-label="Input">
            <Editor />
            <Beside />
            <div class="input-tools">
                <ReadAs />
                <ProposedDevice />
                <ReadingChoices />
                <div class="acts">
                    <Examples />
                    <OpenFile label="Open file" class="low" />
                    <Show when=move || read.mode() != Mode::Start>
                        <button type="button" class="button plain low" on:click=move |_| read.clear()>
                            <Icon glyph=Glyph::Close />
                            "Clear"
                        </button>
                        <a class="button plain low" href="#/sheet">
                            <Icon glyph=Glyph::Print />
                            "Print, export"
                        </a>
                    </Show>
                </div>
            </div>
        </section>
    }
}

//! Read: paste, type, drop or open anything of any size.

mod editor;
mod examples;
mod log;
mod log_view;
mod pictures;
mod reading;
mod start;
mod state;
mod telegrams;
mod times;

use leptos::ev;
use leptos::prelude::*;

use crate::browser::typing::{find_focus, is_typed_into};
use crate::components::icon::{Glyph, Icon};
use crate::components::open_file::OpenFile;
use crate::later::{CouldNotLoad, Later, LaterPiece, Part, Piece};
use editor::Editor;
use reading::ReadAs;
use start::Welcome;
use telegrams::Telegrams;

pub use examples::Examples;
pub use log_view::LogView;
pub use reading::{Beside, ProposedDevice, ReadingChoices};
pub use start::Start;
pub use state::{Mode, ReadState};
pub use telegrams::More;

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
    // A change of what is shown takes away the control that made it.
    Effect::new(move |before: Option<_>| {
        let mode = read.mode();
        if before.is_some_and(|before| before != mode) {
            request_animation_frame(find_focus);
        }
        mode
    });
    let has_editor = Memo::new(move |_| read.mode() != Mode::Log || read.editing.get());
    let starts = Memo::new(move |_| read.mode() == Mode::Start);
    let is_empty = Memo::new(move |_| read.report().telegrams.is_empty());
    let below = move || match read.mode() {
        Mode::Start => view! { <LaterPiece piece=Piece::Start /> }.into_any(),
        Mode::Telegrams if is_empty.get() => view! { <Nothing /> }.into_any(),
        Mode::Telegrams => view! { <Telegrams /> }.into_any(),
        Mode::Log => view! { <LaterPiece piece=Piece::Log /> }.into_any(),
    };
    view! {
        <div class="read" class:start=move || starts.get()>
            <Show when=move || starts.get()>
                <Welcome />
            </Show>
            <Show when=move || has_editor.get()>
                <Input />
            </Show>
            <Show when=move || read.mode() != Mode::Log && later.has_failed(Part::Log)>
                <CouldNotLoad part=Part::Log>
                    "A part of Buslens could not be loaded: check the connection. Telegrams can be read one by one, without examples, possible causes and proposals."
                </CouldNotLoad>
            </Show>
            {move || below()}
        </div>
    }
}

/// Where there is no telegram: what was looked for, what the lines tell instead, and what helps.
#[component]
fn Nothing() -> impl IntoView {
    view! {
        <section class="no-telegram">
            <h2>"There is no telegram in this text."</h2>
            <LaterPiece piece=Piece::Beside />
            <p>
                "Buslens looked for bytes in hex (01 03 00 C8 00 03 84 35, 0103, 0x01, \\x01 …) or decimal, with or without times and words around them, and took for a telegram only what has enough speaking for it."
            </p>
            <p>
                "If a program wrote this text, switch on its debug output of bytes. If you know what the bytes are, choose the protocol above: they are then taken for it."
            </p>
        </section>
    }
}

/// Where telegrams are pasted, and how they are read.
#[component]
fn Input() -> impl IntoView {
    let read = expect_context::<ReadState>();
    view! {
        <section class="input-bar" aria-label="Input">
            <Editor />
            <Show when=move || read.mode() == Mode::Telegrams && !read.report().telegrams.is_empty()>
                <LaterPiece piece=Piece::Beside />
            </Show>
            <div class="input-tools">
                <ReadAs />
                <Show when=move || read.mode() == Mode::Telegrams>
                    <LaterPiece piece=Piece::ProposedDevice />
                </Show>
                <LaterPiece piece=Piece::ReadingChoices />
                <div class="acts">
                    <LaterPiece piece=Piece::Examples />
                    <OpenFile label="Open file" class="low" on_open=read.opener() />
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

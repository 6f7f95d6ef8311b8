//! The button that opens files.

use leptos::ev::Event;
use leptos::prelude::*;
use web_sys::File;

use super::icon::{Glyph, Icon};
use crate::browser::file;

#[component]
pub fn OpenFile(
    #[prop(into)] label: String,
    #[prop(into, optional)] class: String,
    /// The kinds that the system offers at first; without, all of them.
    #[prop(optional)]
    accept: &'static str,
    /// Whether several can be opened at once.
    #[prop(optional)]
    multiple: bool,
    /// Called for each file.
    on_open: Callback<File>,
) -> impl IntoView {
    let open = move |event: Event| {
        file::chosen(&event_target(&event)).into_iter().for_each(|file| on_open.run(file))
    };
    view! {
        <label class=format!("button open-file {class}")>
            <Icon glyph=Glyph::Open />
            {label}
            <input class="unseen" type="file" accept=accept multiple=multiple on:change=open />
        </label>
    }
}

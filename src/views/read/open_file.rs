//! The button that opens a file.

use leptos::ev::Event;
use leptos::prelude::*;

use super::ReadState;
use crate::browser::file;
use crate::components::icon::{Glyph, Icon};

#[component]
pub fn OpenFile(#[prop(into)] label: String, #[prop(into, optional)] class: String) -> impl IntoView {
    let read = expect_context::<ReadState>();
    let open = move |event: Event| {
        if let Some(file) = file::chosen(&event_target(&event)) {
            read.open(file);
        }
    };
    view! {
        <label class=format!("button open-file {class}")>
            <Icon glyph=Glyph::Open />
            {label}
            <input class="unseen" type="file" on:change=open />
        </label>
    }
}

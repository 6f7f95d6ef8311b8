//! What is built: its form, and why there is no telegram of it.

use leptos::prelude::*;
use maud::{Markup, html};
use web_sys::Event;

use super::{drawn, form};
use crate::app::browser;
use crate::app::making::{Made, Making};
use crate::app::state::State;

#[component]
pub fn Form(making: Making) -> impl IntoView {
    let form = drawn(move || {
        making.shape.track();
        making.now(form)
    });
    let refused = drawn(move || {
        making
            .outcome
            .with(|outcome| html! { @if let Some(message) = &outcome.refused { (message.sentence()) "." } })
    });
    view! {
        <section class="card form" aria-label="Form">
            <div inner_html=form></div>
            <p class="misfit" role="status" inner_html=refused></p>
        </section>
    }
}

pub fn hear(making: Making, state: State, kind: &str, event: &Event) {
    if kind == "click" && browser::attribute(event, "data-open").is_some() {
        making.open_all(state);
    }
    form::hear(kind, event, |path, change| making.edit(state, |editor| editor.edit(path, change)));
}

fn form(made: &Made) -> Markup {
    let Some(editor) = &made.editor else { return html! {} };
    html! {
        h2 { (editor.label().sentence()) }
        (form::form(editor.entries()))
        @if editor.task().is_some() {
            button.quiet type="button" data-open="" { "Edit every field of it" }
        }
    }
}

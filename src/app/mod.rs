//! The page. It shows what [`tool`](crate::tool) makes of the input, and knows no protocol.
//!
//! - `state`: what the page is about, as signals;
//! - `browser`: what the browser is asked for;
//! - `pages`: the views; `components`: their parts.

mod browser;
mod components;
mod pages;
mod state;

use leptos::prelude::*;
use state::State;

/// Puts the page into the document's body.
pub fn start() {
    browser::tell_of_panics();
    mount_to_body(|| {
        let state = State::new();
        browser::listen(move |event| components::hear(state, event));
        view! { <Page state /> }
    });
    browser::bring_back();
}

#[component]
fn Page(state: State) -> impl IntoView {
    view! {
        <a class="skip" href="#input">"Skip to the input"</a>
        <components::header::Header />
        <pages::decode::Decode state />
    }
}

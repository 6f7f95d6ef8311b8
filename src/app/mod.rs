//! The page. It shows what [`tool`](crate::tool) makes of the input, and knows no protocol.
//!
//! - `state`: what is read, and `making`: what is built, as signals;
//! - `browser`: what the browser is asked for;
//! - `pages`: the views; `components`: their parts.

mod browser;
mod components;
mod making;
mod pages;
mod state;

use leptos::prelude::*;
use making::Making;
use state::State;

/// Starts the page that reads telegrams.
pub fn decode() {
    browser::tell_of_panics();
    let state = State::new();
    browser::listen(move |event| pages::decode::hear(state, event));
    mount_to_body(move || view! { <pages::decode::Decode state /> });
    browser::bring_back();
}

/// Starts the page that builds telegrams.
pub fn build() {
    browser::tell_of_panics();
    let state = State::new();
    let making = Making::new();
    browser::listen(move |event| pages::build::hear(making, state, event));
    mount_to_body(move || view! { <pages::build::Build making state /> });
    making.start(state);
}

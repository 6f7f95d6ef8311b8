//! The page. It shows what [`tool`](buslens::tool) makes of the input, and knows no protocol.
//!
//! - `state`: what is read, `making`: what is built, and `setup`: how devices are set up, `stepping`: a check while it is followed, as signals;
//! - `browser`: what the browser is asked for; `address`: what a link and a reload bring back;
//! - `pages`: the views; `components`: their parts;
//! - `logs`: logs of any size, and the worker that reads them.

mod address;
mod browser;
mod components;
mod logs;
mod making;
mod pages;
mod setup;
mod state;
mod stepping;

use leptos::prelude::*;
use making::Making;
use setup::Setup;
use state::State;
use stepping::Stepping;

/// Starts the page that reads telegrams.
pub fn decode() {
    browser::tell_of_panics();
    let state = State::new();
    browser::listen(move |event| pages::decode::hear(state, event));
    mount_to_body(move || view! { <pages::decode::Decode state /> });
    address::keep(state);
}

/// Starts the page that builds telegrams.
pub fn build() {
    browser::tell_of_panics();
    let state = State::new();
    let making = Making::new();
    browser::listen(move |event| pages::build::hear(making, state, event));
    mount_to_body(move || view! { <pages::build::Build making state /> });
    address::keep((making, state));
}

/// Starts the page that shows logs.
pub fn logs() {
    browser::tell_of_panics();
    let desk = logs::desk::Desk::new();
    browser::listen(move |event| pages::logs::hear(desk, event));
    mount_to_body(move || view! { <pages::logs::Logs desk /> });
    desk.start();
}

/// Starts the worker that reads logs.
pub fn log_worker() {
    logs::worker::start();
}

/// Starts the page that says how devices are set up.
pub fn devices() {
    browser::tell_of_panics();
    let setup = Setup::new();
    browser::listen(move |event| pages::devices::hear(setup, event));
    mount_to_body(move || view! { <pages::devices::Devices setup /> });
}

/// Starts the page that works out checks step by step.
pub fn check() {
    browser::tell_of_panics();
    let stepping = Stepping::new();
    browser::listen(move |event| pages::check::hear(stepping, event));
    mount_to_body(move || view! { <pages::check::Check stepping /> });
    address::keep(stepping);
}

/// Starts the page that prints telegrams and exports them.
pub fn sheet() {
    browser::tell_of_panics();
    let state = State::new();
    browser::listen(move |event| pages::sheet::hear(state, event));
    mount_to_body(move || view! { <pages::sheet::Sheet state /> });
    address::keep(state);
}

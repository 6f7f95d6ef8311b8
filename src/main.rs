//! The page: reads and builds field-bus telegrams in a browser.
//!
//! What telegrams are is the library's, `buslens`; the page sees of it only [`buslens::tool`] and the
//! words of [`buslens::field`].
//!
//! - `app`: the views by address, and what outlasts them;
//! - `views`: a folder for each view, with its state; `components`: parts that several views use;
//! - `later`: what is loaded after the first view;
//! - `worker`: reads large files beside the page, out of the same module;
//! - `address`: what a link and a reload bring back; `browser`: what the browser is asked for.
#![deny(unsafe_code)]

mod address;
mod app;
mod browser;
mod components;
mod later;
mod views;
mod worker;

fn main() {
    if worker::is_worker() {
        worker::start();
    } else {
        browser::panic::tell();
        leptos::mount::mount_to_body(app::App);
    }
}

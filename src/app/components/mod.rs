//! The parts of the views, one file each.
//!
//! What a person can edit is a Leptos view. What only shows a telegram is a function from plain
//! data to markup: a page of cells and rows is drawn quickly and costs little to download. Markup has
//! no listeners: every event of the page comes to [`hear`], and the parts know what is theirs by the
//! ids and the attributes `data-…` around the event's target.

use web_sys::Event;

use super::state::State;

pub mod check;
pub mod detail;
pub mod examples;
pub mod fields;
pub mod header;
pub mod input;
pub mod layout;
pub mod list;
pub mod marks;
pub mod settings;
pub mod strip;
pub mod views;

/// An event of the page, for the part that it concerns.
pub fn hear(state: State, event: &Event) {
    let kind = event.type_();
    match kind.as_str() {
        "click" if examples::load(state, event) => settings::close_menu(event),
        _ => {
            header::hear(&kind, event);
            settings::hear(state, &kind, event);
            input::hear(state, &kind, event);
            list::hear(state, &kind, event);
            detail::hear(state, &kind, event);
        }
    }
}

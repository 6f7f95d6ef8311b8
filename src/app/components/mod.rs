//! The parts of the views, one file each.
//!
//! What a person can edit is a Leptos view. What only shows a telegram is a function from plain
//! data to markup: a page of cells and rows is drawn quickly and costs little to download. Markup has
//! no listeners: every event of the page comes to the `hear` of its view and from there to those of the
//! parts, who know what is theirs by the ids and the attributes `data-…` around the event's target.

pub mod byte;
pub mod causes;
pub mod check;
pub mod copies;
pub mod detail;
pub mod device_file;
pub mod examples;
pub mod exports;
pub mod fields;
pub mod finder;
pub mod form;
pub mod header;
pub mod input;
pub mod layout;
pub mod list;
pub mod made;
pub mod marks;
pub mod menu;
pub mod replies;
pub mod settings;
pub mod sheet;
pub mod shortcuts;
pub mod stepper;
pub mod strip;
pub mod views;

use maud::Markup;

/// What an element shows, anew whenever that changes. All of them are of one type: the code that follows
/// the signals is downloaded once.
pub type Drawn<T = String> = Box<dyn Fn() -> T + Send>;

pub fn drawn(markup: impl Fn() -> Markup + Send + 'static) -> Drawn {
    Box::new(move || markup().into_string())
}

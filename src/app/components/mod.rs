//! The parts of the views, one file each.
//!
//! What a person can edit is a Leptos view. What only shows a telegram is a function from plain
//! data to markup: a page of cells and rows is drawn quickly and costs little to download. Markup has
//! no listeners: every event of the page comes to the `hear` of its view and from there to those of the
//! parts, who know what is theirs by the ids and the attributes `data-…` around the event's target.

pub mod check;
pub mod detail;
pub mod examples;
pub mod fields;
pub mod finder;
pub mod form;
pub mod header;
pub mod input;
pub mod layout;
pub mod list;
pub mod marks;
pub mod settings;
pub mod strip;
pub mod views;

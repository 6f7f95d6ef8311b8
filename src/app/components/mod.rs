//! The parts of the views, one file each.
//!
//! What a person can edit is a Leptos view. What only shows a telegram is a function from plain
//! data to markup: a page of cells and rows is drawn quickly and costs little to download. Events
//! are taken where the markup is put in, by the attributes `data-…` of its elements.

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

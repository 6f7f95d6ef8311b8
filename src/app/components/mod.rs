//! The parts of the views, one file each.

pub mod check;
pub mod detail;
pub mod examples;
pub mod fields;
pub mod header;
pub mod input;
pub mod layout;
pub mod list;
pub mod strip;

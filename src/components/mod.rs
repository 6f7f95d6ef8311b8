//! Parts that several views use, one file each.

pub mod byte_strip;
pub mod copy_button;
pub mod dialog;
pub mod field_table;
pub mod header;
pub mod icon;
pub mod menu;
pub mod roving;
pub mod segments;
pub mod toast;

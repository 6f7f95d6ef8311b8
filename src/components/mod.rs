//! Parts that several views use, one file each.

pub mod byte_strip;
pub mod causes;
pub mod check_result;
pub mod chosen_byte;
pub mod combobox;
pub mod copy_as;
pub mod copy_button;
pub mod dialog;
pub mod field_table;
pub mod fold;
pub mod foot;
pub mod form;
pub mod header;
pub mod icon;
pub mod menu;
pub mod page_menu;
pub mod page_tools;
pub mod problems;
pub mod registers;
pub mod roving;
pub mod segments;
pub mod state_badge;
pub mod structure;
pub mod telegram;
pub mod toast;
pub mod wide_table;

//! The views, one file each.

pub mod build;
pub mod check;
pub mod decode;
pub mod devices;
pub mod logs;
pub mod sheet;

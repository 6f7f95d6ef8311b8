//! The views, one file each.

pub mod build;
pub mod decode;
pub mod devices;

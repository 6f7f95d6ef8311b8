//! The views, one file each.

pub mod decode;

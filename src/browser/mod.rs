//! What the browser is asked for, besides showing the page.

pub mod clipboard;
pub mod compression;
pub mod edition;
pub mod file;
pub mod kept_file;
pub mod panic;
pub mod storage;
pub mod stylesheet;
pub mod typing;

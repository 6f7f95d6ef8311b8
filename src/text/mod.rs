//! Pasted text into bytes, with each byte's place in the text.

mod hex;

pub use hex::{Line, Reading, Remark, Style, read};

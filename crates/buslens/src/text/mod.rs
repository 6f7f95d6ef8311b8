//! Pasted text into bytes, with each byte's place in the text.

mod hex;
pub mod log;

pub use hex::{Line, Reading, Remark, Style, read};

/// All bytes of a text, whatever they are written like and on however many lines.
pub fn bytes(text: &str) -> Vec<u8> {
    read(text).lines.into_iter().flat_map(|line| line.bytes).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_all_lines() {
        assert_eq!(bytes("01 03\n00C8"), [1, 3, 0, 0xC8]);
    }
}

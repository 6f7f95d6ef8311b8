//! Bytes as text, for other programs.

use crate::field::hex;

/// A way to write bytes.
#[derive(Debug)]
pub struct Format {
    /// Stable word of settings.
    pub key: &'static str,
    pub label: &'static str,
    pub write: fn(&[u8]) -> String,
}

/// All of them, the usual one first. [`decode`](super::decode()) reads each of them again.
pub static FORMATS: &[Format] = &[
    Format { key: "spaced", label: "Hex with spaces", write: hex },
    Format { key: "plain", label: "Hex without spaces", write: |bytes| hex(bytes).replace(' ', "") },
    Format {
        key: "c",
        label: "C array",
        write: |bytes| format!("uint8_t telegram[{}] = {{ {} }};", bytes.len(), each(bytes, "0x", ", ")),
    },
    Format {
        key: "python",
        label: "Python bytes",
        write: |bytes| format!("telegram = b\"{}\"", each(bytes, "\\x", "")),
    },
    Format {
        key: "rust",
        label: "Rust array",
        write: |bytes| format!("let telegram: [u8; {}] = [{}];", bytes.len(), each(bytes, "0x", ", ")),
    },
];

/// The bytes in hex, each with something before it, and something between them.
fn each(bytes: &[u8], before: &str, between: &str) -> String {
    let written: Vec<String> = bytes.iter().map(|byte| format!("{before}{byte:02X}")).collect();
    written.join(between)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::{Options, PROTOCOLS, Protocol, decode};

    #[test]
    fn characters_of_a_line_are_read_again() {
        let ascii = PROTOCOLS.iter().find(|protocol| protocol.key == "modbus-ascii").unwrap();
        let bytes = [0x02, 0x03, 0x00, 0xC8, 0x00, 0x05, 0x2E];
        let characters = ascii.characters.unwrap()(&bytes);
        for format in FORMATS {
            let report = decode(&(format.write)(characters.as_bytes()), Options::default());
            assert_eq!(report.telegrams[0].line.bytes, bytes, "{}", format.key);
            assert_eq!(report.telegrams[0].choice.protocol.key, "modbus-ascii");
        }
    }

    #[test]
    fn every_format_is_read_again() {
        let bytes: Vec<u8> = (0..=255).collect();
        for format in FORMATS {
            for bytes in [&bytes[..], &[0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35]] {
                let text = (format.write)(bytes);
                // Not all of these bytes are a telegram.
                let protocol = Protocol::of("modbus-rtu");
                let report = decode(&text, Options { protocol, ..Options::default() });
                assert_eq!(report.telegrams.len(), 1, "{text}");
                assert_eq!(report.telegrams[0].line.bytes, bytes, "{}", format.key);
                assert!(report.telegrams[0].line.remarks.is_empty(), "{text}");
            }
        }
    }
}

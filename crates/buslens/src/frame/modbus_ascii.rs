//! Modbus ASCII: the frame of a serial line with an LRC (1 byte).
//!
//! On the line each byte is two hex digits, after a colon and before CR LF: `:0103…`, at most 513
//! characters. Spans count the bytes that the digits stand for.
//!
//! Source: Modbus over serial line V1.02, section 2.5.2.

use super::modbus_serial::{self as serial, Mode, PduFit, Serial, pdu_fit};
use super::{Cargo, Fit, Protocol, Settings, Speaker, Verdict};
use crate::field::{Role, Spec, hex};
use crate::message;
use crate::walk::LRC;

pub static PROTOCOL: Protocol = Protocol {
    key: "modbus-ascii",
    label: "Modbus ASCII",
    fit,
    verdict: |bytes| ASCII.verdict(bytes),
    first: <[u8]>::len,
    unit: |bytes| bytes.first().copied(),
    speaker: Speaker::Pdu(|bytes| (ASCII.pdu_bytes(bytes), ASCII.around())),
    exchange: serial::exchange,
    waiting: 1,
    expect: |bytes, direction, settings| Box::new(ASCII.expect(bytes, direction, settings.dialect)),
    characters: Some(characters),
    carry: |unit, cargo| match cargo {
        Cargo::Modbus(pdu) => Some(Box::new(Serial { mode: &ASCII, unit, pdu })),
        Cargo::Profibus(..) => None,
    },
};

/// The mode with an LRC.
pub static ASCII: Mode = Mode {
    check: Spec::new("lrc", "LRC")
        .role(Role::Check)
        .note("What the sum of all bytes before it lacks to a multiple of 256.")
        .source("Modbus over serial line V1.02, 2.5.2.2"),
    algorithm: &LRC,
};

/// An LRC is right by chance once in 256, so the PDU has to look right, too.
fn fit(bytes: &[u8], settings: &Settings) -> Fit {
    match (ASCII.verdict(bytes), pdu_fit(ASCII.pdu_bytes(bytes), settings.dialect)) {
        (Verdict::Right, PduFit::Length) => {
            Fit { bits: 12, reason: message!("the last byte is a valid LRC, and the length fits") }
        }
        (Verdict::Right, _) => Fit { bits: 5, reason: message!("the last byte is a valid LRC") },
        _ => Fit { bits: 0, reason: message!("the last byte is not a valid LRC") },
    }
}

/// The characters on the line for the bytes of a frame.
pub fn characters(bytes: &[u8]) -> String {
    format!(":{}\r\n", hex(bytes).replace(' ', ""))
}

/// The bytes that characters stand for, where they are a frame as it is on the line: colon, hex
/// digits, and (not always recorded) CR LF.
pub fn from_characters(characters: &[u8]) -> Option<Vec<u8>> {
    let digits = characters.strip_prefix(b":")?.trim_ascii_end();
    from_digits(digits).filter(|bytes| bytes.len() >= ASCII.shortest())
}

/// The bytes that characters stand for which are hex digits only, as where a program records the text that it
/// was to send as bytes.
pub fn from_hex_text(characters: &[u8]) -> Option<Vec<u8>> {
    /// So many digits are no number or word.
    const SHORTEST: usize = 4;
    from_digits(characters.trim_ascii()).filter(|bytes| bytes.len() >= SHORTEST)
}

fn from_digits(digits: &[u8]) -> Option<Vec<u8>> {
    let digit = |byte: u8| char::from(byte).to_digit(16).map(|digit| digit as u8);
    let pairs = digits.chunks(2).map(|pair| match *pair {
        [high, low] => Some(digit(high)? << 4 | digit(low)?),
        _ => None,
    });
    pairs.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_and_back() {
        let bytes = [0x02, 0x03, 0x00, 0xC8, 0x00, 0x05, 0x2E];
        assert_eq!(characters(&bytes), ":020300C800052E\r\n");
        assert_eq!(from_characters(b":020300C800052E\r\n"), Some(bytes.to_vec()));
        assert_eq!(from_characters(b":020300c800052e"), Some(bytes.to_vec()));
        // The shortest that there is: unit, function, check.
        assert_eq!(from_characters(b":0507F4\r\n"), Some(vec![0x05, 0x07, 0xF4]));
        for not in [&b"020300C800052E"[..], b":0203", b":020300C800052", b":0203 00C8", b""] {
            assert_eq!(from_characters(not), None);
        }
    }

    #[test]
    fn hex_text() {
        assert_eq!(from_hex_text(b" 020300c8\r\n"), Some(vec![0x02, 0x03, 0x00, 0xC8]));
        for not in [&b"020300"[..], b"020300C80", b"02 0300C8", b":020300C8", b""] {
            assert_eq!(from_hex_text(not), None);
        }
    }
}

//! The Modbus ASCII frame: unit address (1 byte), PDU, LRC (1 byte).
//!
//! On the line each byte is two hex digits, after a colon and before CR LF: `:0103…`, at most 513
//! characters. Spans count the bytes that the digits stand for.
//!
//! Source: Modbus over serial line V1.02, section 2.5.2.

use super::modbus_serial::{self as serial, PduFit, answer, check_length, head, pdu_fit};
use super::{Cargo, Content, Fit, Frame, Protocol, Settings, Speaker, Verdict};
use crate::field::{Direction, Message, Role, Spec, hex};
use crate::message;
use crate::modbus::{Dialect, LONGEST_PDU, Pdu};
use crate::walk::{LRC as LRC_SUM, Telegram, Walk, Walker};

pub static PROTOCOL: Protocol = Protocol {
    key: "modbus-ascii",
    label: "Modbus ASCII",
    fit,
    verdict,
    first: <[u8]>::len,
    speaker: Speaker::Pdu(|bytes| (pdu_bytes(bytes), AROUND)),
    exchange: serial::exchange,
    waiting: 1,
    expect: |bytes, direction, settings| Box::new(Ascii::expect(bytes, direction, settings.dialect)),
    carry: |unit, cargo| match cargo {
        Cargo::Modbus(pdu) => Some(Box::new(Ascii { unit, pdu })),
        Cargo::Profibus(..) => None,
    },
};

/// An LRC is right by chance once in 256, so the PDU has to look right, too.
fn fit(bytes: &[u8], settings: &Settings) -> Fit {
    match (verdict(bytes), pdu_fit(pdu_bytes(bytes), settings.dialect)) {
        (Verdict::Right, PduFit::Length) => {
            Fit { bits: 12, reason: message!("its last byte is the LRC of the others, and its length fits") }
        }
        (Verdict::Right, _) => Fit { bits: 5, reason: message!("its last byte is the LRC of the others") },
        _ => Fit { bits: 0, reason: message!("its last byte is not the LRC of the others") },
    }
}

/// The bytes around the PDU: unit and LRC.
pub const AROUND: usize = 2;

/// The fewest bytes of a frame: unit, function code, LRC.
pub const SHORTEST: usize = 1 + AROUND;

/// The most bytes of a frame: 513 characters less colon and line end.
pub const LONGEST: usize = LONGEST_PDU + AROUND;

/// A Modbus ASCII frame.
pub struct Ascii {
    pub unit: u8,
    pub pdu: Pdu,
}

impl Ascii {
    /// An empty frame to read `bytes` into.
    pub fn expect(bytes: &[u8], direction: Direction, dialect: &'static Dialect) -> Self {
        let [unit, function] = head(bytes);
        Self { unit, pdu: Pdu::expect(function, direction, dialect) }
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
    let digit = |byte: u8| char::from(byte).to_digit(16).map(|digit| digit as u8);
    let pairs = digits.chunks(2).map(|pair| match *pair {
        [high, low] => Some(digit(high)? << 4 | digit(low)?),
        _ => None,
    });
    pairs.collect::<Option<Vec<u8>>>().filter(|bytes| bytes.len() >= SHORTEST)
}

fn pdu_bytes(bytes: &[u8]) -> &[u8] {
    if bytes.len() < SHORTEST { &[] } else { &bytes[1..bytes.len() - 1] }
}

fn verdict(bytes: &[u8]) -> Verdict {
    match bytes.split_last() {
        Some((lrc, covered)) if bytes.len() >= SHORTEST => {
            if LRC_SUM.wire(covered) == u64::from(*lrc) {
                Verdict::Right
            } else {
                Verdict::Wrong
            }
        }
        _ => Verdict::Unchecked,
    }
}

impl Telegram for Ascii {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let start = w.mark();
        serial::walk(w, &mut self.unit, &mut self.pdu, LRC_SUM.width)?;
        w.checksum(&LRC, &LRC_SUM, start)?;
        let length = w.mark() - start;
        check_length(w, &LRC, length, LONGEST);
        Ok(())
    }
}

impl Frame for Ascii {
    fn content(&self) -> Content<'_> {
        Content::Modbus { server: serial::server(self.unit), pdu: &self.pdu }
    }

    fn meaning(&self) -> Message {
        self.pdu.body.meaning(serial::server(self.unit))
    }

    fn answer(&mut self, request: &Content<'_>) {
        answer(&mut self.pdu, request);
    }
}

static LRC: Spec = Spec::new("lrc", "LRC")
    .role(Role::Check)
    .note("What the sum of all bytes before it lacks to a multiple of 256.")
    .source("Modbus over serial line V1.02, 2.5.2.2");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_and_back() {
        let bytes = [0x02, 0x03, 0x00, 0xC8, 0x00, 0x05, 0x2E];
        assert_eq!(characters(&bytes), ":020300C800052E\r\n");
        assert_eq!(from_characters(b":020300C800052E\r\n"), Some(bytes.to_vec()));
        assert_eq!(from_characters(b":020300c800052e"), Some(bytes.to_vec()));
        for not in [&b"020300C800052E"[..], b":0203", b":020300C800052", b":0203 00C8", b""] {
            assert_eq!(from_characters(not), None);
        }
    }
}

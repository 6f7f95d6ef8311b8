//! The Modbus RTU frame: unit address (1 byte), PDU, CRC-16/MODBUS (2 bytes, low byte first).
//!
//! The line is silent for 3.5 characters before and after. 4 to 256 bytes. RTU frames also come
//! inside TCP, from converters that pass on what they hear: the bytes are the same.
//!
//! Source: Modbus over serial line V1.02, sections 2.2 and 2.5.1.

use super::modbus_serial::{self as serial, answer, check_length, head};
use super::{Cargo, Content, Fit, Frame, Protocol, Speaker, Verdict};
use crate::field::{Direction, Message, Role, Spec};
use crate::message;
use crate::modbus::{Dialect, LONGEST_PDU, Pdu};
use crate::walk::{CRC_16_MODBUS, Telegram, Walk, Walker};

pub use serial::BROADCAST;

pub static PROTOCOL: Protocol = Protocol {
    key: "modbus-rtu",
    label: "Modbus RTU",
    fit: |bytes, settings| match verdict(bytes) {
        Verdict::Right => Fit { bits: 20, reason: message!("its last two bytes are the CRC of the others") },
        _ => serial::fit(Rtu::pdu_bytes(bytes), settings.dialect),
    },
    verdict,
    first: <[u8]>::len,
    speaker: Speaker::Pdu(|bytes| (Rtu::pdu_bytes(bytes), AROUND)),
    exchange: serial::exchange,
    waiting: 1,
    expect: |bytes, direction, settings| Box::new(Rtu::expect(bytes, direction, settings.dialect)),
    carry: |unit, cargo| match cargo {
        Cargo::Modbus(pdu) => Some(Box::new(Rtu { unit, pdu })),
        Cargo::Profibus(..) => None,
    },
};

/// The bytes around the PDU: unit and CRC.
pub const AROUND: usize = 3;

/// The fewest bytes of a frame: unit, function code, CRC.
pub const SHORTEST: usize = 1 + AROUND;

/// The most bytes of a frame.
pub const LONGEST: usize = LONGEST_PDU + AROUND;

/// A Modbus RTU frame.
pub struct Rtu {
    pub unit: u8,
    pub pdu: Pdu,
}

impl Rtu {
    /// An empty frame to read `bytes` into.
    pub fn expect(bytes: &[u8], direction: Direction, dialect: &'static Dialect) -> Self {
        let [unit, function] = head(bytes);
        Self { unit, pdu: Pdu::expect(function, direction, dialect) }
    }

    /// The bytes of the PDU in a frame of `bytes`; empty where the frame is too short for one.
    pub fn pdu_bytes(bytes: &[u8]) -> &[u8] {
        if bytes.len() < SHORTEST { &[] } else { &bytes[1..bytes.len() - 2] }
    }

    /// Whether the last two bytes are the CRC of those before them.
    ///
    /// ```
    /// use buslens::frame::modbus_rtu::Rtu;
    ///
    /// assert!(Rtu::check_matches(&[0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35]));
    /// ```
    pub fn check_matches(bytes: &[u8]) -> bool {
        bytes.split_last_chunk::<2>().is_some_and(|(covered, check)| {
            CRC_16_MODBUS.wire(covered) == u64::from(u16::from_be_bytes(*check))
        })
    }
}

fn verdict(bytes: &[u8]) -> Verdict {
    match bytes.len() {
        ..SHORTEST => Verdict::Unchecked,
        _ if Rtu::check_matches(bytes) => Verdict::Right,
        _ => Verdict::Wrong,
    }
}

impl Telegram for Rtu {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let start = w.mark();
        serial::walk(w, &mut self.unit, &mut self.pdu, CRC_16_MODBUS.width)?;
        w.checksum(&CRC, &CRC_16_MODBUS, start)?;
        let length = w.mark() - start;
        check_length(w, &CRC, length, LONGEST);
        Ok(())
    }
}

impl Frame for Rtu {
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

static CRC: Spec = Spec::new("crc", "CRC")
    .role(Role::Check)
    .note(
        "CRC-16/MODBUS over all bytes before it, low byte first. A unit ignores a frame that does not match.",
    )
    .source("Modbus over serial line V1.02, 2.5.1.2");

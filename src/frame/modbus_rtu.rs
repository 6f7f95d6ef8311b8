//! The Modbus RTU frame: unit address (1 byte), PDU, CRC-16/MODBUS (2 bytes, low byte first).
//!
//! The line is silent for 3.5 characters before and after. 4 to 256 bytes.
//!
//! Source: Modbus over serial line V1.02, sections 2.2 and 2.5.1.

use crate::field::{Direction, Message, Name, Role, Severity, Spec};
use crate::message;
use crate::modbus::{Dialect, LONGEST_PDU, Pdu, Server};
use crate::walk::{CRC_16_MODBUS, Telegram, Walk, Walker};

/// The unit that everybody on the line listens to.
pub const BROADCAST: u8 = 0;

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
        let function = bytes.get(1).copied().unwrap_or_default();
        let unit = bytes.first().copied().unwrap_or_default();
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

    /// The telegram in one sentence.
    pub fn meaning(&self) -> Message {
        self.pdu.body.meaning(match self.unit {
            BROADCAST => Server::All,
            unit => Server::Unit(unit),
        })
    }
}

impl Telegram for Rtu {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        let start = w.mark();
        w.window(2, &mut |w| {
            w.u8(&UNIT, &mut self.unit)?;
            if self.unit > 247 {
                w.remark(
                    &UNIT,
                    Severity::Warning,
                    "reserved-address",
                    message!("unit {unit} is reserved: units have the numbers 1 to 247", unit = self.unit),
                );
            }
            let walk = self.pdu.walk(w);
            self.check_broadcast(w);
            walk
        })?;
        w.checksum(&CRC, &CRC_16_MODBUS, start)?;
        let length = w.mark() - start;
        if length > LONGEST {
            w.remark(
                &CRC,
                Severity::Error,
                "frame-too-long",
                message!(
                    "the frame has {length} bytes; a Modbus RTU frame has at most {longest}",
                    length = length,
                    longest = LONGEST
                ),
            );
        }
        Ok(())
    }
}

impl Rtu {
    fn check_broadcast(&self, w: &mut dyn Walker) {
        if self.unit != BROADCAST {
            return;
        }
        let reads = self.pdu.body.access().is_some_and(|access| !access.write);
        if self.pdu.direction == Direction::Response {
            w.remark(
                &UNIT,
                Severity::Error,
                "broadcast-answered",
                message!("unit 0 is the broadcast address: nobody answers from it"),
            );
        } else if reads {
            w.remark(
                &UNIT,
                Severity::Error,
                "broadcast-read",
                message!("a broadcast can only write: no unit answers a read from all"),
            );
        }
    }
}

static UNIT: Spec = Spec::new("unit", "Unit address")
    .short("Unit")
    .role(Role::Unit)
    .note("Which device is meant (older texts: slave address). 1 to 247; 0 speaks to all at once.")
    .source("Modbus over serial line V1.02, 2.2")
    .names(&[Name { value: 0, label: "all units (broadcast)", note: "Every unit obeys, none answers." }]);

static CRC: Spec = Spec::new("crc", "CRC")
    .role(Role::Check)
    .note(
        "CRC-16/MODBUS over all bytes before it, low byte first. A unit ignores a frame that does not match.",
    )
    .source("Modbus over serial line V1.02, 2.5.1.2");

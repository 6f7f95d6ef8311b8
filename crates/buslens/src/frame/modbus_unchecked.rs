//! A Modbus telegram of a serial line without its check: unit address (1 byte) and PDU. Programs print it
//! so before they append the CRC or after they have taken it off, and so does a log whose telegram is cut
//! before its end. 2 to 254 bytes.
//!
//! Source: Modbus over serial line V1.02, section 2.2.

use super::modbus_serial::{self as serial, Unchecked};
use super::{Cargo, Fit, Protocol, Speaker, Verdict};
use crate::message;

pub static PROTOCOL: Protocol = Protocol {
    key: "modbus-unchecked",
    label: "Modbus RTU without CRC",
    // Nothing in the bytes tells it from an RTU frame: that takes what stands around them.
    fit: |_, _| Fit { bits: 0, reason: message!("nothing speaks for a telegram without its checksum") },
    verdict: |_| Verdict::NoCheck,
    first: <[u8]>::len,
    unit: |bytes| bytes.first().copied(),
    speaker: Speaker::Pdu(|bytes| (bytes.get(1..).unwrap_or_default(), 1)),
    exchange: serial::exchange,
    waiting: 1,
    expect: |bytes, direction, settings| Box::new(Unchecked::expect(bytes, direction, settings.dialect)),
    characters: None,
    carry: |unit, cargo| match cargo {
        Cargo::Modbus(pdu) => Some(Box::new(Unchecked { unit, pdu })),
        Cargo::Profibus(..) => None,
    },
};

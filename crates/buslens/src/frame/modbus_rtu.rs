//! Modbus RTU: the frame of a serial line with CRC-16/MODBUS (2 bytes, low byte first).
//!
//! The line is silent for 3.5 characters before and after. 4 to 256 bytes. RTU frames also come
//! inside TCP, from converters that pass on what they hear: the bytes are the same.
//!
//! Source: Modbus over serial line V1.02, section 2.5.1.

use super::modbus_serial::{self as serial, Mode, Serial};
use super::{Cargo, Fit, Protocol, Speaker, Verdict};
use crate::field::{Direction, Role, Span, Spec};
use crate::message;
use crate::modbus::{Pdu, STANDARD};
use crate::walk::CRC_16_MODBUS;

pub static PROTOCOL: Protocol = Protocol {
    key: "modbus-rtu",
    label: "Modbus RTU",
    fit: |bytes, settings| match RTU.verdict(bytes) {
        _ if first(bytes) < bytes.len() => {
            Fit { bits: 20, reason: message!("it begins with a telegram whose CRC is valid") }
        }
        Verdict::Right => Fit { bits: 20, reason: message!("the last two bytes are a valid CRC") },
        _ => serial::fit(RTU.pdu_bytes(bytes), settings.dialect),
    },
    verdict: |bytes| RTU.verdict(bytes),
    first,
    unit: |bytes| bytes.first().copied(),
    speaker: Speaker::Pdu(|bytes| (RTU.pdu_bytes(bytes), RTU.around())),
    exchange: serial::exchange,
    waiting: 1,
    expect: |bytes, direction, settings| Box::new(RTU.expect(bytes, direction, settings.dialect)),
    characters: None,
    carry: |unit, cargo| match cargo {
        Cargo::Modbus(pdu) => Some(Box::new(Serial { mode: &RTU, unit, pdu })),
        Cargo::Profibus(..) => None,
    },
};

/// The length of the first telegram, where a right one ends before the bytes do and another can
/// follow: a line of text may hold several.
fn first(bytes: &[u8]) -> usize {
    let all = bytes.len();
    let Some(function) = bytes.get(1).filter(|_| RTU.verdict(bytes) != Verdict::Right) else { return all };
    let ends = [Direction::Request, Direction::Response].map(|direction| {
        let length = Pdu::kind(*function, direction, &STANDARD).length.of(bytes.get(1..).unwrap_or_default());
        length.map_or(all, |length| length + RTU.around())
    });
    let right = |end: &usize| {
        end + RTU.shortest() <= all && RTU.verdict(Span::new(0, *end).of(bytes)) == Verdict::Right
    };
    ends.into_iter().find(right).unwrap_or(all)
}

/// The mode with a CRC.
///
/// ```
/// use buslens::frame::{Verdict, modbus_rtu::RTU};
///
/// assert_eq!(RTU.verdict(&[0x01, 0x03, 0x00, 0xC8, 0x00, 0x03, 0x84, 0x35]), Verdict::Right);
/// ```
pub static RTU: Mode = Mode {
    check: Spec::new("crc", "CRC")
        .role(Role::Check)
        .note(
            "CRC-16/MODBUS over all bytes before it, low byte first. A unit ignores a frame whose CRC is wrong.",
        )
        .source("Modbus over serial line V1.02, 2.5.1.2"),
    algorithm: &CRC_16_MODBUS,
};

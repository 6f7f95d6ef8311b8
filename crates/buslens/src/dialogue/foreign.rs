//! Protocols that are not read here but come in the same logs: named, so that nobody takes them for Modbus or
//! PROFIBUS.

use crate::frame::profibus_fdl::Fdl;
use crate::walk::crc_residue;

/// A protocol that is only named.
#[derive(Debug)]
pub struct Foreign {
    pub name: &'static str,
    /// Whether a piece of a text is a telegram of it.
    pub fits: fn(&[u8]) -> bool,
    /// What fits is one beyond doubt: by its length and a sum over it.
    pub certain: bool,
}

impl Foreign {
    const fn likely(name: &'static str, fits: fn(&[u8]) -> bool) -> Self {
        Self { name, fits, certain: false }
    }

    const fn certain(name: &'static str, fits: fn(&[u8]) -> bool) -> Self {
        Self { name, fits, certain: true }
    }
}

pub static FOREIGN: &[Foreign] = &[
    Foreign::likely("M-Bus or IEC 60870-5 (FT1.2 frames)", is_ft12),
    Foreign::likely("BACnet MS/TP", is_mstp),
    Foreign::likely("DIN 66019", is_din_66019),
    Foreign::certain("the AA 55 protocol of inverters", is_aa55),
    Foreign::certain("a protocol with marks in front", is_marked),
    Foreign::likely("a text protocol (~ … CR)", is_tilde_text),
    Foreign::certain("M-Bus", is_meter_bus),
    Foreign::certain("DL/T 645", is_dlt_645),
    Foreign::certain("HDLC, as DLMS has it", is_hdlc),
    Foreign::certain("IEC 60870-5-101 or -103", is_telecontrol),
];

/// The place in [`FOREIGN`] of the protocol that a piece is a telegram of beyond doubt.
#[inline]
pub fn certain(bytes: &[u8]) -> Option<usize> {
    // All of them begin with marks that few others begin with.
    match bytes {
        [0x55 | 0x5A | 0x68 | 0x7E | 0xAA | 0xEB | 0xFE, ..] => {
            FOREIGN.iter().position(|foreign| foreign.certain && (foreign.fits)(bytes))
        }
        _ => None,
    }
}

/// The place of FT1.2 in [`FOREIGN`]: the only one whose frames also pass as PROFIBUS.
pub const FT12: usize = 0;

/// The short frame of FT1.2: 10h, control, address, sum, 16h. PROFIBUS has one byte more.
///
/// Source: IEC 60870-5-1, section 6.2.4.2; EN 13757-2.
fn is_ft12(bytes: &[u8]) -> bool {
    matches!(*bytes, [0x10, control, address, sum, 0x16] if control.wrapping_add(address) == sum)
}

/// Control field, address and what comes behind them in a long frame of FT1.2, if its lengths and its sum are right.
///
/// Source: IEC 60870-5-1, section 6.2.4.2.
fn long_frame(bytes: &[u8]) -> Option<[u8; 3]> {
    let [0x68, length, again, 0x68, covered @ .., sum, 0x16] = bytes else { return None };
    let right = (again, covered.len(), *sum) == (length, usize::from(*length), sum_of(covered));
    covered.first_chunk().copied().filter(|_| right)
}

/// A long frame with what M-Bus has in it: a control field of its own, and a CI field where PROFIBUS has its frame
/// control, which has no such function.
///
/// Source: EN 13757-2 and -3.
fn is_meter_bus(bytes: &[u8]) -> bool {
    let Some([control, _, ci]) = long_frame(bytes) else { return false };
    matches!(control, 0x08 | 0x18 | 0x28 | 0x38 | 0x53 | 0x73 | 0x5B | 0x7B)
        && matches!(ci, 0x50..=0x52 | 0x5A | 0x5B | 0x70..=0x72 | 0x78 | 0x7A | 0xB8..=0xBF)
}

/// A long frame with a control field of its own, and behind the address what PROFIBUS's frame control cannot be: it has
/// no such function, or none that carries data.
///
/// Source: IEC 60870-5-2, section 6.1.2.
fn is_telecontrol(bytes: &[u8]) -> bool {
    let Some([control, _, next]) = long_frame(bytes) else { return false };
    matches!(control & 0x4F, 0x40 | 0x43 | 0x44 | 0x4A | 0x4B | 0x08) && !Fdl::carries_data(next)
}

/// FEh up to a few times; 68h, address (6), 68h, control, length, data, sum, 16h.
///
/// Source: DL/T 645-2007, section 5.
fn is_dlt_645(bytes: &[u8]) -> bool {
    let woken = bytes.iter().take_while(|byte| **byte == 0xFE).count();
    let [covered @ .., sum, 0x16] = &bytes[woken..] else { return false };
    let [0x68, _, _, _, _, _, _, 0x68, _, length, data @ ..] = covered else { return false };
    (data.len(), sum_of(covered)) == (usize::from(*length), *sum)
}

/// The sum of bytes, in one.
fn sum_of(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum, byte| sum.wrapping_add(*byte))
}

/// 7Eh, format and length (A0h and more), addresses, …, FCS, 7Eh.
///
/// Source: ISO/IEC 13239, frame format type 3; IEC 62056-46.
fn is_hdlc(bytes: &[u8]) -> bool {
    /// The remainder that the FCS leaves in CRC-16/IBM-SDLC.
    const RIGHT: u16 = 0xF0B8;
    let [0x7E, covered @ .., 0x7E] = bytes else { return false };
    let [high @ 0xA0..=0xA7, low, ..] = covered else { return false };
    let crc = covered.iter().fold(0xFFFF_u16, |crc, byte| {
        (0..8).fold(crc ^ u16::from(*byte), |crc, _| (crc >> 1) ^ (0x8408 * (crc & 1)))
    });
    covered.len() == usize::from(u16::from_be_bytes([high & 7, *low])) && crc == RIGHT
}

/// Preamble 55h FFh, type, destination, source, length (2), header CRC.
///
/// Source: ANSI/ASHRAE 135, clause 9.3.
fn is_mstp(bytes: &[u8]) -> bool {
    matches!(*bytes, [0x55, 0xFF, kind, _, _, _, _, _, ..] if kind <= 7 || kind >= 128)
}

/// EOT, address, …, ENQ; or STX, …, ETX, check.
///
/// Source: DIN 66019.
fn is_din_66019(bytes: &[u8]) -> bool {
    let text = |bytes: &[u8]| bytes.len() > 2 && bytes.iter().all(|c| (0x20..0x7F).contains(c));
    match bytes {
        [0x04, inside @ .., 0x05] => text(inside),
        [0x02, inside @ .., 0x03, _] => text(inside),
        _ => false,
    }
}

/// AA 55, …, sum of all in two bytes.
fn is_aa55(bytes: &[u8]) -> bool {
    let [0xAA, 0x55, .., high, low] = bytes else { return false };
    let covered = &bytes[..bytes.len() - 2];
    let sum = covered.iter().fold(0_u16, |sum, byte| sum.wrapping_add(u16::from(*byte)));
    sum == u16::from_be_bytes([*high, *low])
}

/// Two bytes that mark where a frame begins, as makers choose them, and the CRC of Modbus over what is behind them,
/// or over all. Inverters that put AA 55 before answers of Modbus have the units 7Fh and F7h.
fn is_marked(bytes: &[u8]) -> bool {
    let marks =
        matches!(bytes, [0xAA, 0x55, 0..0x7F, ..] | [0x55, 0xAA, ..] | [0x5A, 0xA5, ..] | [0xEB, 0x90, ..]);
    marks && bytes.len() > 5 && [&bytes[2..], bytes].into_iter().any(|covered| crc_residue(covered) == 0)
}

/// A tilde, characters that are hex digits, CR.
fn is_tilde_text(bytes: &[u8]) -> bool {
    match bytes {
        [b'~', inside @ .., b'\r'] => inside.len() > 4 && inside.iter().all(u8::is_ascii_hexdigit),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(bytes: &[u8]) -> Option<&'static str> {
        let found = FOREIGN.iter().find(|foreign| (foreign.fits)(bytes))?;
        assert_eq!(certain(bytes).map(|place| FOREIGN[place].name), found.certain.then_some(found.name));
        Some(found.name)
    }

    #[test]
    fn each_is_named() {
        assert_eq!(named(&[0x10, 0x5B, 0x0A, 0x65, 0x16]), Some(FOREIGN[FT12].name));
        assert_eq!(named(&[0x55, 0xFF, 0, 7, 3, 0, 0, 0xEB]), Some("BACnet MS/TP"));
        assert_eq!(named(b"\x0401G220701\x05"), Some("DIN 66019"));
        assert_eq!(named(b"\x02G0003\x037"), Some("DIN 66019"));
        assert_eq!(
            named(&[0xAA, 0x55, 1, 0, 0, 0x0B, 0x11, 4, 0, 1, 0x20]),
            Some("the AA 55 protocol of inverters")
        );
        let marked = Some("a protocol with marks in front");
        assert_eq!(named(&[0xAA, 0x55, 1, 3, 0, 200, 0, 3, 0x84, 0x35]), marked);
        assert_eq!(named(&[0xAA, 0x55, 1, 3, 0, 200, 0, 3, 0x84, 0x36]), None, "a check that is wrong");
        assert_eq!(named(&[0xAA, 0x55, 0xF7, 0x83, 2, 0x20, 0xC3]), None, "an answer of Modbus");
        assert_eq!(named(b"~20014642\r"), Some("a text protocol (~ … CR)"));
        let bytes = |text: &str| -> Vec<u8> {
            text.split(' ').map(|byte| u8::from_str_radix(byte, 16).expect("hex")).collect()
        };
        let meter = "68 0F 0F 68 08 03 72 21 43 65 87 24 40 01 07 12 00 00 00 17 16";
        let mut meter = bytes(meter);
        let end = meter.len() - 2;
        meter[end] = meter[4..end].iter().fold(0, |sum: u8, byte| sum.wrapping_add(*byte));
        assert_eq!(named(&meter), Some("M-Bus"));
        meter[5] ^= 1;
        assert_eq!(named(&meter), None, "a sum that is wrong");
        let dlt = "FE FE FE FE 68 21 43 65 87 09 00 68 11 04 33 33 34 33 00 16";
        let mut dlt = bytes(dlt);
        let end = dlt.len() - 2;
        dlt[end] = dlt[4..end].iter().fold(0, |sum: u8, byte| sum.wrapping_add(*byte));
        assert_eq!(named(&dlt), Some("DL/T 645"));
        // SNRM of a client to a meter.
        assert_eq!(named(&bytes("7E A0 07 03 21 93 0F 01 7E")), Some("HDLC, as DLMS has it"));
        assert_eq!(named(&bytes("7E A0 07 03 21 93 0F 02 7E")), None);
        let interrogation = "68 0B 0B 68 53 05 00 64 01 06 05 00 00 00 14 DC 16";
        assert_eq!(named(&bytes(interrogation)), Some("IEC 60870-5-101 or -103"));
        assert_eq!(
            named(&bytes("68 08 08 68 73 05 08 04 81 09 05 14 27 16")),
            None,
            "a response of PROFIBUS"
        );
        assert_eq!(named(&[1, 3, 0, 200, 0, 3, 0x84, 0x35]), None);
        assert_eq!(named(&[0x10, 2, 1, 0x49, 0x4C, 0x16]), None, "PROFIBUS");
    }
}

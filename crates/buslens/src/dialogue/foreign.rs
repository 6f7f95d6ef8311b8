//! Protocols that are not read here but come in the same logs: named, so that nobody takes them for Modbus or
//! PROFIBUS.

/// A protocol that is only named.
#[derive(Debug)]
pub struct Foreign {
    pub name: &'static str,
    /// Whether a piece of a text is a telegram of it.
    pub fits: fn(&[u8]) -> bool,
}

pub static FOREIGN: &[Foreign] = &[
    Foreign { name: "M-Bus or IEC 60870-5 (FT1.2 frames)", fits: is_ft12 },
    Foreign { name: "BACnet MS/TP", fits: is_mstp },
    Foreign { name: "DIN 66019", fits: is_din_66019 },
    Foreign { name: "the AA 55 protocol of inverters", fits: |bytes| is_aa55(bytes) },
    Foreign { name: "a text protocol (~ … CR)", fits: is_tilde_text },
];

/// The place of FT1.2 in [`FOREIGN`]: the only one whose frames also pass as PROFIBUS.
pub const FT12: usize = 0;

/// The short frame of FT1.2: 10h, control, address, sum, 16h. PROFIBUS has one byte more.
///
/// Source: IEC 60870-5-1, section 6.2.4.2; EN 13757-2.
fn is_ft12(bytes: &[u8]) -> bool {
    matches!(*bytes, [0x10, control, address, sum, 0x16] if control.wrapping_add(address) == sum)
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
    let Some((covered, [high, low])) = bytes.split_last_chunk::<2>() else { return false };
    let sum = covered.iter().fold(0_u16, |sum, byte| sum.wrapping_add(u16::from(*byte)));
    bytes.starts_with(&[0xAA, 0x55]) && sum == u16::from_be_bytes([*high, *low])
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
        FOREIGN.iter().find(|foreign| (foreign.fits)(bytes)).map(|foreign| foreign.name)
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
        assert_eq!(named(b"~20014642\r"), Some("a text protocol (~ … CR)"));
        assert_eq!(named(&[1, 3, 0, 200, 0, 3, 0x84, 0x35]), None);
        assert_eq!(named(&[0x10, 2, 1, 0x49, 0x4C, 0x16]), None, "PROFIBUS");
    }
}

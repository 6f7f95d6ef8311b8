//! The checks that field buses and their converters use: which of them gives the bytes that are there?

use crc::{Crc, Table};

use crate::walk::{Algorithm, CRC_16_MODBUS, FCS, LRC};

/// A check with the name that it is known by.
#[derive(Debug)]
pub struct Checksum {
    /// As the catalogue of CRC algorithms has it, where it is one.
    pub name: &'static str,
    /// Who uses it.
    pub used_by: &'static str,
    pub algorithm: &'static Algorithm,
}

/// The order of a check's bytes on the wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ByteOrder {
    /// As it is specified.
    Usual,
    /// The other way round.
    Swapped,
}

impl Checksum {
    /// The check of `bytes` as a number.
    pub fn value(&self, bytes: &[u8]) -> u64 {
        (self.algorithm.compute)(bytes)
    }

    /// The check of `bytes` as the wire has it.
    pub fn wire(&self, bytes: &[u8]) -> Vec<u8> {
        self.algorithm.wire(bytes).to_be_bytes()[8 - self.algorithm.width..].to_vec()
    }

    /// In which order the check of `bytes` gives what was `found` behind them, if in any.
    ///
    /// ```
    /// use buslens::tool::checksums::{ByteOrder, CHECKSUMS};
    ///
    /// let request = [0x01, 0x03, 0x00, 0xC8, 0x00, 0x03];
    /// assert_eq!(CHECKSUMS[0].gives(&request, &[0x84, 0x35]), Some(ByteOrder::Usual));
    /// assert_eq!(CHECKSUMS[0].gives(&request, &[0x35, 0x84]), Some(ByteOrder::Swapped));
    /// ```
    pub fn gives(&self, bytes: &[u8], found: &[u8]) -> Option<ByteOrder> {
        let mut wire = self.wire(bytes);
        if wire == found {
            return Some(ByteOrder::Usual);
        }
        wire.reverse();
        (wire == found).then_some(ByteOrder::Swapped)
    }
}

/// All of them, those of the protocols that Buslens reads first.
///
/// Source for the CRCs: the catalogue of parametrised CRC algorithms, whose names they have.
pub static CHECKSUMS: &[Checksum] = &[
    Checksum { name: "CRC-16/MODBUS", used_by: "Modbus RTU", algorithm: &CRC_16_MODBUS },
    Checksum { name: "LRC", used_by: "Modbus ASCII", algorithm: &LRC },
    Checksum { name: "FCS", used_by: "PROFIBUS", algorithm: &FCS },
    Checksum {
        name: "CRC-16/ARC",
        used_by: "drivers that start with 0000h",
        algorithm: &crc_16("crc-16/arc", true, |bytes| ARC.checksum(bytes).into()),
    },
    Checksum {
        name: "CRC-16/IBM-3740",
        used_by: "often called CCITT-FALSE",
        algorithm: &crc_16("crc-16/ibm-3740", false, |bytes| IBM_3740.checksum(bytes).into()),
    },
    Checksum {
        name: "CRC-16/XMODEM",
        used_by: "XMODEM",
        algorithm: &crc_16("crc-16/xmodem", false, |bytes| XMODEM.checksum(bytes).into()),
    },
    Checksum {
        name: "CRC-16/KERMIT",
        used_by: "often called CCITT",
        algorithm: &crc_16("crc-16/kermit", true, |bytes| KERMIT.checksum(bytes).into()),
    },
    Checksum {
        name: "CRC-16/IBM-SDLC",
        used_by: "HDLC, X.25",
        algorithm: &crc_16("crc-16/ibm-sdlc", true, |bytes| IBM_SDLC.checksum(bytes).into()),
    },
    Checksum {
        name: "CRC-16/USB",
        used_by: "USB",
        algorithm: &crc_16("crc-16/usb", true, |bytes| USB.checksum(bytes).into()),
    },
    Checksum {
        name: "CRC-16/DNP",
        used_by: "DNP3",
        algorithm: &crc_16("crc-16/dnp", true, |bytes| DNP.checksum(bytes).into()),
    },
    Checksum {
        name: "XOR of all bytes",
        used_by: "simple serial protocols, as BCC",
        algorithm: &Algorithm { kind: "xor", width: 1, low_first: false, compute: xor },
    },
];

const fn crc_16(kind: &'static str, low_first: bool, compute: fn(&[u8]) -> u64) -> Algorithm {
    Algorithm { kind, width: 2, low_first, compute }
}

fn xor(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0, |sum, byte| sum ^ byte).into()
}

// Without tables: a telegram is short, and tables take room in the page.
static ARC: Crc<u16, Table<0>> = Crc::<u16, Table<0>>::new(&crc::CRC_16_ARC);
static IBM_3740: Crc<u16, Table<0>> = Crc::<u16, Table<0>>::new(&crc::CRC_16_IBM_3740);
static XMODEM: Crc<u16, Table<0>> = Crc::<u16, Table<0>>::new(&crc::CRC_16_XMODEM);
static KERMIT: Crc<u16, Table<0>> = Crc::<u16, Table<0>>::new(&crc::CRC_16_KERMIT);
static IBM_SDLC: Crc<u16, Table<0>> = Crc::<u16, Table<0>>::new(&crc::CRC_16_IBM_SDLC);
static USB: Crc<u16, Table<0>> = Crc::<u16, Table<0>>::new(&crc::CRC_16_USB);
static DNP: Crc<u16, Table<0>> = Crc::<u16, Table<0>>::new(&crc::CRC_16_DNP);

#[cfg(test)]
mod tests {
    use super::*;

    /// The catalogue gives the check of `123456789` for each.
    #[test]
    fn the_check_values_of_the_catalogue() {
        let expected = [
            ("CRC-16/MODBUS", 0x4B37),
            ("LRC", 0x23),
            ("FCS", 0xDD),
            ("CRC-16/ARC", 0xBB3D),
            ("CRC-16/IBM-3740", 0x29B1),
            ("CRC-16/XMODEM", 0x31C3),
            ("CRC-16/KERMIT", 0x2189),
            ("CRC-16/IBM-SDLC", 0x906E),
            ("CRC-16/USB", 0xB4C8),
            ("CRC-16/DNP", 0xEA82),
            ("XOR of all bytes", 0x31),
        ];
        let found: Vec<(&str, u64)> = CHECKSUMS.iter().map(|it| (it.name, it.value(b"123456789"))).collect();
        assert_eq!(found, expected);
    }
}

use std::sync::LazyLock;

use crc::{CRC_16_MODBUS as MODBUS, Crc, Table};

/// How check bytes follow from the bytes that they protect.
#[derive(Debug)]
pub struct Algorithm {
    /// Stable name of exports: `crc-16/modbus`.
    pub kind: &'static str,
    /// How many bytes the check has.
    pub width: usize,
    /// The wire sends the low byte first.
    pub low_first: bool,
    /// The check as a number: for CRC-16/MODBUS over `123456789` it is 4B37h.
    pub compute: fn(&[u8]) -> u64,
}

impl Algorithm {
    /// The check of `bytes` as the wire has it, the first byte most significant.
    pub fn wire(&self, bytes: &[u8]) -> u64 {
        let value = (self.compute)(bytes);
        if self.low_first { value.swap_bytes() >> (64 - 8 * self.width) } else { value }
    }
}

/// CRC-16/MODBUS: polynomial 8005h (reflected A001h), start FFFFh, low byte first.
///
/// Source: Modbus over serial line V1.02, section 2.5.1.2 and appendix B.
pub static CRC_16_MODBUS: Algorithm =
    Algorithm { kind: "crc-16/modbus", width: 2, low_first: true, compute: crc_16_modbus };

fn crc_16_modbus(bytes: &[u8]) -> u64 {
    CRC.checksum(bytes).into()
}

/// One table of 256 entries: quick enough, and half a kilobyte in the page.
static CRC: Crc<u16, Table<1>> = Crc::<u16, Table<1>>::new(&MODBUS);

/// The CRC of a whole RTU frame, which is 0 where its check is right. Its eight tables (4 KiB) make
/// it quick enough for logs: the bytes of a block do not wait for each other.
#[inline]
pub fn crc_residue(frame: &[u8]) -> u16 {
    let tables = &*BLOCK_TABLES;
    let Some(first) = frame.first_chunk::<BLOCK>() else {
        return frame.iter().fold(u16::MAX, |crc, byte| crc_step(crc, *byte));
    };
    // The first block is the odd bytes at the beginning, behind as many zeros as it takes: before the first byte,
    // they change nothing. The start is a part of the first two bytes.
    let odd = (frame.len() - 1) % BLOCK + 1;
    let began = u64::from_le_bytes(*first) ^ u64::from(u16::MAX);
    let began = (began << (8 * (BLOCK - odd))).to_le_bytes();
    // Of one byte alone, half of the start is still to come.
    let crc = block_crc(tables, &began) ^ if odd == 1 { 0x00FF } else { 0 };
    let (blocks, _) = frame[odd..].as_chunks::<BLOCK>();
    blocks.iter().fold(crc, |crc, block| {
        let block = u64::from_le_bytes(*block) ^ u64::from(crc);
        block_crc(tables, &block.to_le_bytes())
    })
}

/// What a block adds to the CRC behind it.
#[inline]
fn block_crc(tables: &[[u16; 256]; BLOCK], block: &[u8; BLOCK]) -> u16 {
    block.iter().zip(tables).fold(0, |crc, (byte, table)| crc ^ table[usize::from(*byte)])
}

/// The CRC behind one more byte.
#[inline]
pub const fn crc_step(crc: u16, byte: u8) -> u16 {
    crc >> 8 ^ CRC.table()[0][(crc as u8 ^ byte) as usize]
}

/// So many bytes are taken at once.
const BLOCK: usize = 8;

/// What a byte adds to the CRC behind its block, for each place in the block. Worked out where they are first
/// needed: no compression makes them smaller, and everybody would wait for them.
static BLOCK_TABLES: LazyLock<[[u16; 256]; BLOCK]> = LazyLock::new(|| {
    let mut tables = [CRC.table()[0]; BLOCK];
    for place in (0..BLOCK - 1).rev() {
        // One byte further from the end: as much as before, and a zero behind it.
        tables[place] = tables[place + 1].map(|crc| crc_step(crc, 0));
    }
    tables
});

/// The check of Modbus ASCII: what is missing from the sum of the bytes to 0, in one byte.
///
/// Source: Modbus over serial line V1.02, section 2.5.2.2 and appendix A.
pub static LRC: Algorithm =
    Algorithm { kind: "lrc", width: 1, low_first: false, compute: |bytes| sum(bytes).wrapping_neg().into() };

/// The frame check of PROFIBUS: the sum of the bytes, in one byte.
///
/// Source: EN 50170, volume 2, part 4 (FDL), frame formats.
pub static FCS: Algorithm =
    Algorithm { kind: "fcs", width: 1, low_first: false, compute: |bytes| sum(bytes).into() };

fn sum(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum, byte| sum.wrapping_add(*byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_check_value_of_the_catalogue() {
        assert_eq!((CRC_16_MODBUS.compute)(b"123456789"), 0x4B37);
        assert_eq!(CRC_16_MODBUS.wire(b"123456789"), 0x374B);
    }

    #[test]
    fn the_quick_crc_is_the_same() {
        let bytes: Vec<u8> = (0..70_u32).map(|n| (n * n * 37 + 11) as u8).collect();
        for length in 0..bytes.len() {
            let part = &bytes[..length];
            assert_eq!(u64::from(crc_residue(part)), (CRC_16_MODBUS.compute)(part), "{length} bytes");
        }
    }

    #[test]
    fn sums() {
        assert_eq!(LRC.wire(&[0x02, 0x03, 0x00, 0xC8, 0x00, 0x05]), 0x2E);
        assert_eq!(FCS.wire(&[0x02, 0x01, 0x49]), 0x4C);
        assert_eq!(LRC.wire(&[]), 0);
    }
}

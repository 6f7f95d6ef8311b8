//! The arithmetic of CRC-16/MODBUS that lets a search do without trying everything: the check is
//! linear, so that the effect of a difference on it does not depend on the bytes around it.

pub use crate::walk::{crc_residue as residue, crc_step as step};

/// The CRC over the bytes before each place.
pub fn before(bytes: &[u8]) -> Vec<u16> {
    let mut crc = 0xFFFF;
    let states = bytes.iter().map(|byte| {
        crc = step(crc, *byte);
        crc
    });
    std::iter::once(0xFFFF).chain(states).collect()
}

/// The CRC that has to stand before each place so that the whole frame is right: `step` undone from
/// the end on.
pub fn needed(bytes: &[u8]) -> Vec<u16> {
    let mut needed = vec![0; bytes.len() + 1];
    for at in (0..bytes.len()).rev() {
        let high = (needed[at + 1] >> 8) as u8;
        // The table's high bytes are all different: this one tells which entry was used.
        let index = UNDO[high as usize];
        needed[at] = ((needed[at + 1] ^ step(index.into(), 0)) << 8) + u16::from(index ^ bytes[at]);
    }
    needed
}

static UNDO: [u8; 256] = {
    let mut undo = [0; 256];
    let mut index = 0;
    while index < 256 {
        undo[(step(index, 0) >> 8) as usize] = index as u8;
        index += 1;
    }
    undo
};

/// The byte that leads from one CRC to another, if one does.
pub fn between(from: u16, to: u16) -> Option<u8> {
    let index = UNDO[(to >> 8) as usize];
    (to == from >> 8 ^ step(index.into(), 0)).then_some(index ^ from as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIGHT: &[u8] = &[1, 3, 0, 200, 0, 3, 0x84, 0x35];

    #[test]
    fn forwards_and_back_meet_in_a_right_frame() {
        assert_eq!(crate::walk::crc_residue(RIGHT), 0);
        assert_eq!(before(RIGHT), needed(RIGHT));
        for (at, byte) in RIGHT.iter().enumerate() {
            assert_eq!(between(before(RIGHT)[at], needed(RIGHT)[at + 1]), Some(*byte));
        }
    }
}

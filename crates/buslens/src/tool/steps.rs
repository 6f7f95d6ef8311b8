//! A check worked out step by step, as a person does it on paper.

pub use crate::text::bytes;
pub use crate::walk::Algorithm;
use crate::walk::{CRC_16_MODBUS, FCS, LRC};

/// The checks that can be followed.
pub static CHECKS: &[&Algorithm] = &[&CRC_16_MODBUS, &LRC, &FCS];

/// More bytes no telegram has.
pub const MOST: usize = 1000;

/// The polynomial of CRC-16/MODBUS, lowest power leftmost: x^16 + x^15 + x^2 + 1 without its highest.
pub const POLYNOMIAL: u16 = 0xA001;

/// One step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    pub deed: Deed,
    /// The index of the byte that it belongs to.
    pub byte: usize,
    pub before: u16,
    pub after: u16,
}

/// What is done in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deed {
    /// The register gets its first value.
    Start,
    /// The byte is XORed into the low half of the register.
    Mix,
    /// The register goes one place to the right, the `bit`th time for this byte. If the bit that
    /// falls out is 1, the polynomial is XORed into the register.
    Shift { bit: u8, out: bool },
    /// The byte is added; what is above 8 bits is dropped.
    Add,
    /// What is missing to 0 is taken.
    Complement,
}

/// All steps from the start value to the check of `bytes`, of which [`MOST`] count.
///
/// ```
/// use buslens::tool::steps::{CHECKS, steps};
///
/// let crc = steps(CHECKS[0], b"123456789");
/// assert_eq!(crc.len(), 1 + 9 * 9);
/// assert_eq!(crc.last().unwrap().after, 0x4B37);
/// ```
pub fn steps(check: &'static Algorithm, bytes: &[u8]) -> Vec<Step> {
    let crc = std::ptr::eq(check, &raw const CRC_16_MODBUS);
    let start = if crc { 0xFFFF } else { 0 };
    let mut steps = Steps { taken: vec![Step { deed: Deed::Start, byte: 0, before: start, after: start }] };
    for (at, byte) in bytes.iter().take(MOST).enumerate() {
        if crc {
            steps.take(at, Deed::Mix, |register| register ^ u16::from(*byte));
            for bit in 1..=8 {
                let out = steps.register() & 1 == 1;
                let polynomial = if out { POLYNOMIAL } else { 0 };
                steps.take(at, Deed::Shift { bit, out }, |register| register >> 1 ^ polynomial);
            }
        } else {
            steps.take(at, Deed::Add, |sum| (sum + u16::from(*byte)) & 0xFF);
        }
    }
    if std::ptr::eq(check, &raw const LRC) {
        let last = bytes.len().min(MOST).saturating_sub(1);
        steps.take(last, Deed::Complement, |sum| (0x100 - sum) & 0xFF);
    }
    steps.taken
}

struct Steps {
    taken: Vec<Step>,
}

impl Steps {
    fn register(&self) -> u16 {
        self.taken.last().map_or(0, |step| step.after)
    }

    fn take(&mut self, byte: usize, deed: Deed, change: impl FnOnce(u16) -> u16) {
        let before = self.register();
        self.taken.push(Step { deed, byte, before, after: change(before) });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_step_gives_the_check() {
        for length in [0, 1, 2, 9, 253] {
            let bytes: Vec<u8> = (0..length).map(|at: usize| (at * 37 + 200) as u8).collect();
            for check in CHECKS {
                let steps = steps(check, &bytes);
                let last = steps.last().map(|step| u64::from(step.after));
                assert_eq!(last, Some((check.compute)(&bytes)), "{}, {length} bytes", check.kind);
                assert!(steps.windows(2).all(|pair| pair[0].after == pair[1].before));
            }
        }
    }

    #[test]
    fn no_input_makes_it_swell() {
        assert_eq!(steps(CHECKS[0], &vec![7; 1_000_000]).len(), 1 + 9 * MOST);
    }
}

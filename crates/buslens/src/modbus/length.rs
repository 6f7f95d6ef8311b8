/// How long a PDU is, told from its first bytes; the function code counts.
#[derive(Clone, Copy, Debug)]
pub enum Length {
    Fixed(usize),
    /// The byte at `at` counts the bytes after it, of which there are some, a multiple of `unit`.
    Counted {
        at: usize,
        unit: usize,
    },
    /// The same with two bytes that count.
    CountedByTwo {
        at: usize,
        unit: usize,
    },
    /// The byte at `at` counts the items after it. The second byte of each counts what it has
    /// behind that.
    Listed {
        at: usize,
    },
    /// Whole units behind the first `after` bytes, at least one. Nothing tells how many.
    Units {
        after: usize,
        unit: usize,
    },
    /// The number of `width` bytes at `at` decides.
    Chosen {
        at: usize,
        width: usize,
        by: fn(u64) -> Length,
    },
    /// Nothing tells.
    Open,
}

impl Length {
    /// The length that the PDU beginning with `bytes` must have, as far as its bytes tell.
    pub fn of(self, bytes: &[u8]) -> Option<usize> {
        match self {
            Self::Fixed(length) => Some(length),
            Self::Counted { at, .. } => number(bytes, at, 1).map(|count| at + 1 + count as usize),
            Self::CountedByTwo { at, .. } => number(bytes, at, 2).map(|count| at + 2 + count as usize),
            Self::Listed { at } => {
                let count = number(bytes, at, 1)?;
                (0..count).try_fold(at + 1, |end, _| {
                    number(bytes, end + 1, 1).map(|behind| end + 2 + behind as usize)
                })
            }
            Self::Chosen { at, width, by } => by(number(bytes, at, width)?).of(bytes),
            Self::Units { .. } | Self::Open => None,
        }
    }

    /// Whether bytes behind `bytes`, which do not tell the length yet, could tell it.
    pub fn can_be_told(self, bytes: &[u8]) -> bool {
        match self {
            Self::Fixed(_) | Self::Counted { .. } | Self::CountedByTwo { .. } | Self::Listed { .. } => true,
            Self::Chosen { at, width, by } => {
                number(bytes, at, width).is_none_or(|chosen| by(chosen).can_be_told(bytes))
            }
            Self::Units { .. } | Self::Open => false,
        }
    }

    /// Whether `bytes` can be a whole PDU of this length.
    pub fn fits(self, bytes: &[u8]) -> bool {
        let whole = |from: usize, unit: usize| {
            bytes.len().checked_sub(from).is_some_and(|units| units > 0 && units.is_multiple_of(unit))
        };
        match self {
            Self::Fixed(_) | Self::Listed { .. } => self.of(bytes) == Some(bytes.len()),
            Self::Counted { at, unit } => self.of(bytes) == Some(bytes.len()) && whole(at + 1, unit),
            Self::CountedByTwo { at, unit } => self.of(bytes) == Some(bytes.len()) && whole(at + 2, unit),
            Self::Units { after, unit } => whole(after, unit),
            Self::Chosen { at, width, by } => {
                number(bytes, at, width).is_some_and(|chosen| by(chosen).fits(bytes))
            }
            Self::Open => true,
        }
    }
}

/// The number of `width` bytes at `at`, if they are there.
fn number(bytes: &[u8], at: usize, width: usize) -> Option<u64> {
    let there = bytes.get(at..at + width)?;
    Some(there.iter().fold(0, |number, byte| number << 8 | u64::from(*byte)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_told_as_far_as_the_bytes_go() {
        let listed = Length::Listed { at: 1 };
        assert_eq!(listed.of(&[43, 2, 0, 3, b'K', b'E', b'B', 1, 0]), Some(9));
        assert_eq!(listed.of(&[43, 2, 0, 3, b'K']), None);
        assert!(listed.fits(&[43, 0]));
        assert!(!listed.fits(&[43, 1, 0, 1]));

        let wide = Length::CountedByTwo { at: 1, unit: 2 };
        assert_eq!(wide.of(&[24, 1, 0]), Some(259));
        assert!(wide.fits(&[24, 0, 2, 0, 0]));
        assert!(!wide.fits(&[24, 0, 0]));
        assert!(!wide.fits(&[24, 0, 3, 0, 0, 0]));

        let units = Length::Units { after: 1, unit: 4 };
        assert!(units.fits(&[100, 0, 0, 0, 1]));
        assert!(!units.fits(&[100]));
        assert!(!units.fits(&[100, 0, 0, 0]));
        assert_eq!(units.of(&[100, 0, 0, 0, 1]), None);

        let chosen = Length::Chosen {
            at: 1,
            width: 1,
            by: |chosen| if chosen == 14 { Length::Fixed(4) } else { Length::Open },
        };
        assert!(chosen.fits(&[43, 14, 1, 0]));
        assert!(!chosen.fits(&[43, 14, 1]));
        assert!(chosen.fits(&[43, 99]));
        assert!(chosen.can_be_told(&[43]) && chosen.can_be_told(&[43, 14]) && !chosen.can_be_told(&[43, 99]));
        assert!(listed.can_be_told(&[43, 2, 0, 3]) && !units.can_be_told(&[100]));
        assert!(!chosen.fits(&[43]));
    }
}

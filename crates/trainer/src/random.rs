//! Random numbers that are the same everywhere and for ever: SplitMix64.
//!
//! What a link asks follows from these numbers. So nothing here may ever change, but for a new version of the
//! generator beside the old one ([`crate::practice::VERSION`]).

/// A row of random numbers that its seed determines.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The row that belongs to these words; each word counts.
    pub fn of(words: &[u64]) -> Self {
        let mut random = Self(0x0B05_1E05);
        for word in words {
            random.0 ^= word.wrapping_mul(0x9E37_79B9_7F4A_7C15);
            random.0 = random.draw();
        }
        random
    }

    pub fn draw(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// From 0 to below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        ((u128::from(self.draw()) * end as u128) >> 64) as usize
    }

    /// From `from` to `to`, both included.
    pub fn between(&mut self, from: usize, to: usize) -> usize {
        from + self.below(to - from + 1)
    }

    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// So many different ones of `choices`, in a random order.
    pub fn some_of<T: Clone>(&mut self, choices: &[T], count: usize) -> Vec<T> {
        let mut all = choices.to_vec();
        self.shuffle(&mut all);
        all.truncate(count);
        all
    }

    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for at in (1..items.len()).rev() {
            items.swap(at, self.below(at + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// SplitMix64 with seed 1234567 as its authors' program prints it.
    #[test]
    fn it_is_splitmix64() {
        let mut random = Random(1_234_567);
        let first: Vec<u64> = (0..3).map(|_| random.draw()).collect();
        assert_eq!(first, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn numbers_stay_in_their_range() {
        let mut random = Random::of(&[1, 2]);
        let mut seen = [0; 6];
        for _ in 0..600 {
            seen[random.between(1, 6) - 1] += 1;
        }
        assert!(seen.iter().all(|times| *times > 60), "{seen:?}");
        let mut all = random.some_of(&[1, 2, 3, 4], 4);
        all.sort_unstable();
        assert_eq!(all, [1, 2, 3, 4]);
    }
}

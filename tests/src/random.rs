//! Random numbers from a seed, the same on every machine.

use taceva_core::random::{SplitMix64, scaled};

/// Generator SplitMix64 of random numbers, for example to choose when to kill a program and which bit to flip.
#[derive(Clone, Debug)]
pub struct Random(SplitMix64);

impl Random {
    /// Creates the generator with the seed `seed`.
    pub fn new(seed: u64) -> Random {
        Random(SplitMix64::new(seed))
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Random number from 0 to below `end`; 0 if `end` is 0.
    pub fn below(&mut self, end: usize) -> usize {
        usize::try_from(scaled(self.bits(), end as u64)).expect("below a usize")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_values() {
        let mut random = Random::new(1);
        let numbers = std::array::from_fn(|_| random.below(1000));
        assert_eq!(numbers, [566, 745, 971, 444, 444, 762, 877, 523]);
        assert_eq!(random.bits(), 5_266_705_631_892_356_520);
    }

    #[test]
    fn every_number_below_the_end_is_drawn_and_no_other() {
        let mut random = Random::new(1);
        let mut counts = [0; 5];
        (0..1_000).for_each(|_| counts[random.below(5)] += 1);
        assert!(
            counts.iter().all(|count| (150..250).contains(count)),
            "{counts:?}"
        );
        assert_eq!(random.below(0), 0);
    }
}

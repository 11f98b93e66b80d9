//! Random numbers in sequence.

use super::{STEP, mix, unit};

/// SplitMix64, a generator of random numbers. Each seed gives one sequence, the same on every machine.
///
/// ```
/// use taceva_core::random::SplitMix64;
/// let mut random = SplitMix64::new(0);
/// assert_eq!(random.next_u64(), 0xe220_a839_7b1d_cdaf);
/// let mut cards = [1, 2, 3, 4];
/// random.shuffle(&mut cards);
/// assert_eq!(cards.iter().sum::<i32>(), 10);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    /// Generator that starts in the state `seed`.
    #[inline]
    #[must_use]
    pub const fn new(seed: u64) -> SplitMix64 {
        SplitMix64 { state: seed }
    }

    /// Next 64 random bits.
    #[inline]
    pub const fn next_u64(&mut self) -> u64 {
        let word = mix(self.state);
        self.state = self.state.wrapping_add(STEP);
        word
    }

    /// Next random number from 0 (inclusive) to 1 (exclusive), a multiple of 2⁻⁵³.
    #[inline]
    pub const fn unit(&mut self) -> f64 {
        unit(self.next_u64())
    }

    /// Random integer below `bound`. All integers are equally likely, because draws that would bias the result are discarded.
    ///
    /// # Panics
    /// If `bound` is zero.
    pub fn below(&mut self, bound: usize) -> usize {
        let bound = bound as u64;
        let favoured = (u64::MAX % bound + 1) % bound;
        loop {
            let word = self.next_u64();
            if word <= u64::MAX - favoured {
                return usize::try_from(word % bound).expect("below a usize");
            }
        }
    }

    /// Shuffles `items`, with all orders equally likely (Fisher and Yates).
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, self.below(last + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sequence_keeps_its_values() {
        let mut random = SplitMix64::new(9);
        let mut items = [0, 1, 2, 3, 4, 5, 6, 7];
        random.shuffle(&mut items);
        assert_eq!(items, [3, 6, 5, 1, 7, 0, 2, 4]);
        assert_eq!([random.below(1000), random.below(3)], [165, 1]);
        assert_eq!(random.next_u64(), 14_557_450_600_514_164_083);
    }

    #[test]
    fn words_that_would_favour_some_numbers_are_discarded() {
        // For this bound about half of the words are discarded. The probability that 40 draws discard none is 2⁻⁴⁰.
        let bound = (1_usize << 63) + 1;
        let (mut drawn, mut plain) = (SplitMix64::new(3), SplitMix64::new(3));
        for _ in 0..40 {
            let number = drawn.below(bound);
            let word =
                std::iter::repeat_with(|| plain.next_u64()).find(|word| *word < bound as u64);
            assert_eq!(Some(number as u64), word);
        }
        assert_eq!(drawn, plain);
    }

    #[test]
    fn every_order_of_three_is_about_as_likely() {
        let mut counts = std::collections::BTreeMap::new();
        let mut random = SplitMix64::new(1);
        for _ in 0..6000 {
            let mut items = [0, 1, 2];
            random.shuffle(&mut items);
            *counts.entry(items).or_insert(0_u32) += 1;
        }
        // Expected: 1000, standard deviation 29; the limits are five deviations.
        assert_eq!(counts.len(), 6);
        assert!(counts.values().all(|count| count.abs_diff(1000) < 145));
    }
}

//! Random numbers computed from a key and a counter, without earlier draws.

use super::{STEP, finalise, mix, scaled, unit};

/// Source of random numbers, each computed from a key and a counter.
///
/// The bits of `counter` equal output `counter` + 1 of [`SplitMix64`](super::SplitMix64) with the key as seed. No earlier output is needed.
///
/// ```
/// use taceva_core::random::Draws;
/// let shuffles = Draws::new(7).of(1);
/// assert_eq!(shuffles.order(4).len(), 4);
/// assert_eq!(shuffles.bits(12), Draws::new(7).of(1).bits(12));
/// assert_ne!(shuffles.bits(12), Draws::new(7).of(2).bits(12));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draws {
    key: u64,
}

impl Draws {
    /// Source with `key`, which is a seed or a result of [`mix`].
    #[inline]
    #[must_use]
    pub const fn new(key: u64) -> Draws {
        Draws { key }
    }

    /// Independent source for the purpose with the number `purpose`, derived from this key.
    #[inline]
    #[must_use]
    pub const fn of(self, purpose: u64) -> Draws {
        Draws::new(finalise(self.bits(purpose) ^ STEP))
    }

    /// 64 random bits, determined by the key and `counter`.
    #[inline]
    #[must_use]
    pub const fn bits(self, counter: u64) -> u64 {
        mix(self.key.wrapping_add(counter.wrapping_mul(STEP)))
    }

    /// Random number from 0 (inclusive) to 1 (exclusive), determined by the key and `counter`.
    #[inline]
    #[must_use]
    pub const fn unit(self, counter: u64) -> f64 {
        unit(self.bits(counter))
    }

    /// Normal number with mean 0 and variance 1 (Box and Muller), from the uniform numbers of counters 2 · `counter` and 2 · `counter` + 1. Logarithm
    /// and cosine depend on the platform, so the last digits may differ between machines.
    #[must_use]
    pub fn normal(self, counter: u64) -> f64 {
        let (first, second) = (self.unit(2 * counter), self.unit(2 * counter + 1));
        // 1 − u is in (0, 1], so its logarithm is finite.
        (-2.0 * (1.0 - first).ln()).sqrt() * (std::f64::consts::TAU * second).cos()
    }

    /// Random permutation of the integers from 0 to `count` − 1 (Fisher and Yates), determined by the key.
    #[must_use]
    pub fn order(self, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..count).collect();
        for last in (1..count).rev() {
            let last_counter = last as u64;
            let other = scaled(self.bits(last_counter), last_counter + 1);
            order.swap(last, usize::try_from(other).expect("at most `last`"));
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_a_purpose_keep_their_values() {
        let draws = Draws::new(7).of(3);
        assert_eq!(draws.bits(0), 16_250_342_551_169_312_135);
        assert_eq!(draws.bits(5), 7_536_438_695_782_369_294);
        assert_eq!(draws.unit(2).to_bits(), 0x3fe0_cfb0_3908_e565);
        assert!((draws.normal(1) - 1.039_447_709_794_634_9).abs() < 1e-14);
        assert_eq!(draws.order(8), [0, 5, 7, 6, 3, 2, 4, 1]);
    }

    #[test]
    fn normal_numbers_have_the_moments_of_a_normal_distribution() {
        let draws = Draws::new(7);
        let values: Vec<f64> = (0..20_000).map(|counter| draws.normal(counter)).collect();
        let mean = values.iter().sum::<f64>() / 20_000.0;
        let variance = values.iter().map(|value| value * value).sum::<f64>() / 20_000.0;
        // Standard errors are 0.007 and 0.01; the limits are five of them.
        assert!(
            mean.abs() < 0.035 && (variance - 1.0).abs() < 0.05,
            "{mean} {variance}"
        );
    }

    #[test]
    fn every_order_of_three_is_about_as_likely() {
        let mut counts = std::collections::BTreeMap::new();
        for purpose in 0..6000 {
            let order = Draws::new(3).of(purpose).order(3);
            *counts.entry(order).or_insert(0_u32) += 1;
        }
        // Expected: 1000, standard deviation 29; the limits are five deviations.
        assert_eq!(counts.len(), 6);
        assert!(counts.values().all(|count| count.abs_diff(1000) < 145));
    }
}

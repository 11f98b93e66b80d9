//! Reproducible random numbers: each is a function of a key and a position, never of what was drawn before.

/// Draws of one purpose.
///
/// Number `n` is what the generator SplitMix64 gives at step n + 1 from the key as its state, so that any of them can be had
/// without those before it.
///
/// # Reference
/// G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Draws {
    key: u64,
}

/// What a step adds to the state: 2⁶⁴ over the golden ratio.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

fn mix(state: u64) -> u64 {
    let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

impl Draws {
    /// The draws of `seed`.
    pub(crate) const fn new(seed: u64) -> Draws {
        Draws { key: seed }
    }

    /// The draws of one purpose among those of this key.
    pub(crate) fn of(self, purpose: u64) -> Draws {
        Draws {
            key: mix(self.bits(purpose) ^ STEP),
        }
    }

    /// Draw `position`, 64 even bits.
    pub(crate) fn bits(self, position: u64) -> u64 {
        mix(self
            .key
            .wrapping_add(position.wrapping_add(1).wrapping_mul(STEP)))
    }

    /// Draw `position`, evenly distributed in 0..1.
    pub(crate) fn unit(self, position: u64) -> f64 {
        (self.bits(position) >> 11) as f64 * (0.5_f64).powi(53)
    }

    /// Draw `position` of a normal distribution of mean 0 and variance 1 (Box and Muller).
    pub(crate) fn normal(self, position: u64) -> f64 {
        let (first, second) = (self.unit(2 * position), self.unit(2 * position + 1));
        // 1 − u lies in (0, 1], so that its logarithm is finite.
        (-2.0 * (1.0 - first).ln()).sqrt() * (std::f64::consts::TAU * second).cos()
    }

    /// The numbers 0..`count` in a random order (Fisher and Yates).
    pub(crate) fn order(self, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..count).collect();
        for last in (1..count).rev() {
            let draw = u128::from(self.bits(last as u64)) * (last as u128 + 1);
            let other = usize::try_from(draw >> 64).expect("at most `last`");
            order.swap(last, other);
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_those_of_the_published_generator() {
        let draws = Draws::new(1_234_567);
        assert_eq!(
            [draws.bits(0), draws.bits(1), draws.bits(2)],
            [
                6_457_827_717_110_365_317,
                3_203_168_211_198_807_973,
                9_817_491_932_198_370_423
            ]
        );
    }

    #[test]
    fn normal_draws_have_the_moments_of_a_normal_distribution() {
        let draws = Draws::new(7);
        let values: Vec<f64> = (0..20_000).map(|position| draws.normal(position)).collect();
        let mean = values.iter().sum::<f64>() / 20_000.0;
        let variance = values.iter().map(|value| value * value).sum::<f64>() / 20_000.0;
        // Standard errors are 0.007 and 0.01: five of them.
        assert!(
            mean.abs() < 0.035 && (variance - 1.0).abs() < 0.05,
            "{mean} {variance}"
        );
    }

    #[test]
    fn every_order_of_three_is_about_as_likely() {
        let mut counts = std::collections::BTreeMap::new();
        for seed in 0..6000 {
            *counts
                .entry(Draws::new(3).of(seed).order(3))
                .or_insert(0_u32) += 1;
        }
        // 1000 expected, standard deviation 29: five of them.
        assert_eq!(counts.len(), 6);
        assert!(counts.values().all(|count| count.abs_diff(1000) < 145));
    }
}

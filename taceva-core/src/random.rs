//! Random numbers that are the same on every machine, from the generator SplitMix64.
//!
//! [`SplitMix64`] draws numbers in sequence. [`Draws`] computes each number from a key and a counter, without earlier draws. Use [`Draws`] if work
//! may be resumed, reordered or divided among threads. [`mix`] makes keys from a seed: for each purpose, press or sample, combine its number with the
//! key by exclusive or, and call `mix`.
//!
//! Do not use these numbers for cryptography.
//!
//! ```
//! use taceva_core::random::{Draws, SplitMix64, mix};
//! let (seed, purpose) = (7, 3);
//! let draws = Draws::new(mix(mix(seed) ^ purpose));
//! assert_eq!(draws.bits(41), draws.bits(41));
//! assert!((0.0..1.0).contains(&draws.unit(0)));
//!
//! let mut dice = SplitMix64::new(seed);
//! assert!((0..100).all(|_| dice.below(6) < 6));
//! ```
//!
//! # Reference
//! G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014; constants of `mix64` by Stafford (variant 13).

mod draws;
mod fnv;
mod sequence;

pub use draws::Draws;
pub use fnv::{FNV_OFFSET, fnv_1a, fnv_1a_after};
pub use sequence::SplitMix64;

/// Increment of the state of SplitMix64 per number: 2⁶⁴ divided by the golden ratio, rounded to an odd number.
///
/// ```
/// use taceva_core::random::{STEP, finalise, mix};
/// assert_eq!(mix(5), finalise(5 + STEP));
/// ```
pub const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// Output function of SplitMix64: a bijection of 64-bit numbers. Each bit of the result depends on each bit of `state`. 0 maps to 0.
///
/// ```
/// use taceva_core::random::finalise;
/// assert_eq!(finalise(0), 0);
/// assert_ne!(finalise(1), finalise(2));
/// ```
#[inline]
#[must_use]
pub const fn finalise(state: u64) -> u64 {
    let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

/// First output of SplitMix64 with the seed `word`.
///
/// ```
/// use taceva_core::random::mix;
/// assert_eq!(mix(0), 0xe220_a839_7b1d_cdaf);
/// ```
#[inline]
#[must_use]
pub const fn mix(word: u64) -> u64 {
    finalise(word.wrapping_add(STEP))
}

/// Converts 64 random bits to a number from 0 (inclusive) to 1 (exclusive). All multiples of 2⁻⁵³ in this range are equally likely.
///
/// ```
/// use taceva_core::random::unit;
/// assert_eq!(unit(0), 0.0);
/// assert_eq!(unit(1 << 63), 0.5);
/// assert!(unit(u64::MAX) < 1.0);
/// ```
#[inline]
#[must_use]
pub const fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 * UNIT_STEP
}

/// Converts 64 random bits to a number between 0 and 1, both exclusive. The number is an odd multiple of 2⁻⁵⁴, rounded to `f64`; a result rounded to
/// 1 is replaced with 1 − 2⁻⁵³.
///
/// ```
/// use taceva_core::random::open_unit;
/// assert_eq!(open_unit(0), 2_f64.powi(-54));
/// assert_eq!(open_unit(1 << 63), 0.5 + 2_f64.powi(-54));
/// ```
#[inline]
#[must_use]
pub const fn open_unit(bits: u64) -> f64 {
    let number = ((bits >> 11) as f64 + 0.5) * UNIT_STEP;
    if number < 1.0 {
        number
    } else {
        1.0 - UNIT_STEP
    }
}

/// Converts 64 random bits to an integer below `bound` by one multiplication; 0 if `bound` is 0.
///
/// The probability of each integer differs from 1 / `bound` by at most 2⁻⁶⁴. [`SplitMix64::below`] gives equal probabilities, but may need several
/// draws. Use this function if exactly one draw is available.
///
/// ```
/// use taceva_core::random::scaled;
/// assert_eq!(scaled(1 << 63, 6), 3);
/// assert_eq!(scaled(u64::MAX, 6), 5);
/// assert_eq!(scaled(u64::MAX, 0), 0);
/// ```
#[inline]
#[must_use]
pub const fn scaled(bits: u64, bound: u64) -> u64 {
    ((bits as u128 * bound as u128) >> 64) as u64
}

/// Distance between neighbouring results of `unit`, 2⁻⁵³.
const UNIT_STEP: f64 = 1.0 / 9_007_199_254_740_992.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_published_generator() {
        // First outputs of its reference program, seeded with 1234567.
        let published = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
        ];
        let mut sequence = SplitMix64::new(1_234_567);
        for (at, word) in (0..).zip(published) {
            let state = STEP.wrapping_mul(at).wrapping_add(1_234_567);
            assert_eq!(mix(state), word);
            assert_eq!(Draws::new(1_234_567).bits(at), word);
            assert_eq!(sequence.next_u64(), word);
        }
    }

    #[test]
    fn units_lie_evenly_between_their_ends() {
        let draws = Draws::new(1);
        let n = 100_000_u32;
        let units: Vec<f64> = (0..u64::from(n)).map(|at| draws.unit(at)).collect();
        let mean = units.iter().sum::<f64>() / f64::from(n);
        let variance = units.iter().map(|u| (u - mean).powi(2)).sum::<f64>() / f64::from(n);
        assert!((mean - 0.5).abs() < 0.004, "{mean}");
        assert!((variance - 1.0 / 12.0).abs() < 0.001, "{variance}");
        assert!(unit(u64::MAX) < 1.0 && open_unit(u64::MAX) < 1.0 && open_unit(0) > 0.0);
    }

    #[test]
    fn scaled_words_fill_the_numbers_below_the_bound() {
        let mut counts = [0_u32; 5];
        let draws = Draws::new(1);
        for at in 0..1_000 {
            let number = usize::try_from(scaled(draws.bits(at), 5)).expect("below 5");
            counts[number] += 1;
        }
        // Expected: 200, standard deviation 13; the limits are five deviations.
        assert!(
            counts.iter().all(|count| count.abs_diff(200) < 65),
            "{counts:?}"
        );
    }
}

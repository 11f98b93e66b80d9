//! Random numbers that depend on their purpose, not on earlier draws.

use taceva_core::random::{Draws, STEP, finalise, mix};

/// Random number with the index `index` in the sequence that `seed` and `purpose` determine.
pub(super) fn draw(seed: u64, purpose: u64, index: u64) -> u64 {
    let stream = mix(seed).wrapping_add(finalise(purpose.wrapping_mul(STEP)));
    Draws::new(stream).bits(index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_values() {
        assert_eq!(draw(1, 2, 3), 13_809_670_449_062_645_622);
        assert_eq!(draw(0, 0, 0), 12_035_550_249_420_947_055);
    }

    #[test]
    fn bits_of_neighbouring_draws_are_unlike_each_other() {
        let mut ones = 0;
        for index in 0..1_000 {
            ones += (draw(1, 2, index) ^ draw(1, 2, index + 1)).count_ones();
            ones += (draw(1, 2, index) ^ draw(2, 2, index)).count_ones();
            ones += (draw(1, 2, index) ^ draw(1, 3, index)).count_ones();
        }
        // 3,000 words of 64 fair bits: mean 96,000, one standard deviation 219.
        assert!((95_000..97_000).contains(&ones), "{ones}");
    }
}

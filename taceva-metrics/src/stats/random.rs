//! Random bits from a hash of seed and position, so the order of draws has no effect.

use taceva_core::random::mix;

/// 64 random bits of the pair `(major, minor)` under `seed`: mix(mix(mix(seed) ⊕ major) ⊕ minor), with the hash function `mix`.
pub(super) fn bits(seed: u64, major: u64, minor: u64) -> u64 {
    mix(mix(mix(seed) ^ major) ^ minor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_keep_their_values() {
        assert_eq!(bits(7, 1, 2), 1_650_069_959_653_123_811);
    }

    #[test]
    fn neighbouring_counters_differ_in_about_half_of_their_bits() {
        let neighbours = (0..4096_u64).flat_map(|at| {
            let (major, minor) = (at / 64, at % 64);
            let here = bits(7, major, minor);
            [bits(7, major + 1, minor), bits(7, major, minor + 1)]
                .map(|next| (here ^ next).count_ones())
        });
        let flipped: u32 = neighbours.sum();
        // 8192 pairs of 64 fair bits: mean 262144, standard deviation 362.
        assert!(flipped.abs_diff(262_144) < 4 * 362, "{flipped}");
    }

    #[test]
    fn the_two_counters_have_different_roles() {
        assert_ne!(bits(0, 1, 2), bits(0, 2, 1));
        assert_ne!(bits(1, 0, 0), bits(0, 1, 0));
    }
}

//! Poisson draws with mean 1, by exact inversion.

/// Thresholds ⌊2⁶⁴ P(X ≤ k)⌋ for k = 0…19, with a Poisson variable X of mean 1. P(X > 20) is below 2⁻⁶⁴.
const THRESHOLDS: [u64; 20] = [
    0x5e2d_58d8_b3bc_df1a,
    0xbc5a_b1b1_6779_be35,
    0xeb71_5e1d_c158_2dc2,
    0xfb23_9797_34a2_52f1,
    0xff10_25f5_9174_dc3d,
    0xffd9_0f3b_a405_5e19,
    0xfffa_8b71_fc72_c913,
    0xffff_540c_0914_b3c9,
    0xffff_ed1f_4aa8_f120,
    0xffff_fe21_6e64_1462,
    0xffff_ffd4_d85d_3183,
    0xffff_fffc_6da2_62b4,
    0xffff_ffff_ba12_d178,
    0xffff_ffff_fb07_c64c,
    0xffff_ffff_ffab_8ea5,
    0xffff_ffff_fffa_be22,
    0xffff_ffff_ffff_b11a,
    0xffff_ffff_ffff_fba1,
    0xffff_ffff_ffff_ffc5,
    0xffff_ffff_ffff_fffd,
];

/// Poisson weight of mean 1 for 64 uniform random bits: the number of thresholds up to `bits`.
pub(super) fn weight(bits: u64) -> u32 {
    // Three draws in four are below 2, so a linear search is shorter than a bisection.
    let reached = THRESHOLDS
        .iter()
        .take_while(|&&threshold| bits >= threshold);
    reached.fold(0, |weight, _| weight + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ⌊2⁶⁴ a / b⌋ for a < b, by long division.
    fn fraction(mut a: u128, b: u128) -> u64 {
        (0..64).fold(0, |bits, _| {
            a *= 2;
            let bit = u64::from(a >= b);
            if a >= b {
                a -= b;
            }
            bits << 1 | bit
        })
    }

    #[test]
    fn the_thresholds_are_the_series_of_the_distribution() {
        // Σ 1/j! up to k over Σ 1/j! of all, in units of 2⁻¹²⁰.
        let term = |j: u128| (1..=j).fold(1_u128 << 120, |term, factor| term / factor);
        let e: u128 = (0..40).map(term).sum();
        for (k, &threshold) in (0..).zip(&THRESHOLDS) {
            let below: u128 = (0..=k).map(term).sum();
            // The truncated series may change the last place by one.
            assert!(fraction(below, e).abs_diff(threshold) <= 1, "{k}");
        }
    }

    #[test]
    fn mean_and_variance_are_one() {
        // P(weight > k) = 1 − threshold / 2⁶⁴; E = Σ P(X > k), E X² = Σ (2k + 1) P(X > k).
        let above = THRESHOLDS.map(|threshold| u128::from(u64::MAX - threshold) + 1);
        let mean: u128 = above.iter().sum();
        let square: u128 = (0..).zip(above).map(|(k, above)| (2 * k + 1) * above).sum();
        // Each threshold is rounded down by less than one place.
        assert!(mean.abs_diff(1 << 64) < 20, "{mean}");
        assert!(square.abs_diff(2 << 64) < 400, "{square}");
    }

    #[test]
    fn each_threshold_begins_the_next_weight() {
        for (k, &threshold) in (0..).zip(&THRESHOLDS) {
            assert_eq!((weight(threshold - 1), weight(threshold)), (k, k + 1));
        }
        assert_eq!((weight(0), weight(u64::MAX)), (0, 20));
    }
}

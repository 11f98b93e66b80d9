//! Distributions of statistics of normal samples: tail probabilities and quantiles, to about 14 digits.
//!
//! The code uses only + − × ÷ and √, which IEEE 754 defines to the last bit. An argument outside the domain gives NaN.
//!
//! ```
//! use taceva_metrics::distributions::{chi_square, f_ratio, normal, student_t};
//! assert!((student_t::quantile(0.975, 16.0) - 2.119_905_299_221_254_7).abs() < 1e-14);
//! assert!((chi_square::quantile(0.95, 1.0) - 3.841_458_820_694_126).abs() < 1e-14);
//! assert!((f_ratio::above(3.554_557_145_661_789, 2.0, 18.0) - 0.05).abs() < 1e-15);
//! assert!((normal::below(1.96) - 0.975_002_104_851_779_6).abs() < 1e-15);
//! ```
//!
//! # Reference
//! Abramowitz and Stegun, Handbook of Mathematical Functions (1964), chapter 26; Loader, Fast and accurate computation of binomial
//! probabilities (2000).

mod beta;
pub mod chi_square;
mod deviance;
pub mod f_ratio;
mod gamma;
pub mod noncentral_t;
pub mod normal;
mod quadrature;
pub mod student_t;
mod tails;
pub mod tolerance;

pub use quadrature::integral;

#[cfg(test)]
mod tests {
    use super::*;

    /// Panics unless both tails in `found` agree with `expected` to twelve digits.
    fn hold(found: [f64; 2], expected: [f64; 2], name: &str) {
        for (found, expected) in found.into_iter().zip(expected) {
            let off = (found / expected - 1.0).abs();
            assert!(
                off < 1e-12,
                "{name}: {found} is not {expected}, off by {off:.1e}"
            );
        }
    }

    // Expected values of the tests below: mpmath, forty digits.

    #[test]
    fn both_tails_of_chi_square_keep_their_digits() {
        for (x, freedom, expected) in [
            (
                1e-6,
                0.5,
                [0.029_337_383_225_123_08, 0.970_662_616_774_876_9],
            ),
            (0.3, 0.1, [0.927_832_443_365_792_8, 0.072_167_556_634_207_2]),
            (
                900.0,
                1000.0,
                [0.010_717_238_091_289_742, 0.989_282_761_908_710_3],
            ),
            (
                1200.0,
                1000.0,
                [0.999_987_744_057_669_4, 1.225_594_233_062_290_4e-5],
            ),
            (
                1_003_000.0,
                1e6,
                [0.982_983_227_066_733_7, 0.017_016_772_933_266_315],
            ),
            (
                60.0,
                5.0,
                [0.999_999_999_987_845_4, 1.215_456_977_718_304e-11],
            ),
        ] {
            let found = [chi_square::below(x, freedom), chi_square::above(x, freedom)];
            hold(found, expected, &format!("{x}, {freedom}"));
        }
    }

    #[test]
    fn both_tails_of_f_keep_their_digits() {
        for (ratio, [a, b], expected) in [
            (
                0.01,
                [1.0, 3.0],
                [0.073_347_651_199_194_17, 0.926_652_348_800_805_8],
            ),
            (
                50.0,
                [0.5, 0.5],
                [0.797_573_210_188_738_5, 0.202_426_789_811_261_55],
            ),
            (
                1.1,
                [2e3, 3e3],
                [0.990_463_670_151_753_9, 0.009_536_329_848_246_1],
            ),
            (
                7.0,
                [30.0, 2.0],
                [0.867_464_093_046_911_4, 0.132_535_906_953_088_6],
            ),
            (
                0.2,
                [1e5, 8.0],
                [3.213_074_652_219_866_5e-6, 0.999_996_786_925_347_8],
            ),
            (
                4.0,
                [3.0, 1e6],
                [0.992_616_613_404_926_3, 0.007_383_386_595_073_607],
            ),
        ] {
            let found = [f_ratio::below(ratio, a, b), f_ratio::above(ratio, a, b)];
            hold(found, expected, &format!("{ratio}, {a}, {b}"));
        }
    }

    #[test]
    fn the_upper_tail_of_student_s_t_keeps_its_digits() {
        for (t, freedom, expected) in [
            (3.0, 0.1, 0.373_847_076_986_342_2),
            (12.0, 40.0, 3.912_085_652_127_986e-15),
            (40.0, 4.0, 1.167_008_161_300_634_3e-6),
            (1.2, 1e6, 0.115_069_812_365_862_28),
            (6.0, 1e5, 9.899_647_278_008_813e-10),
        ] {
            let found = [student_t::above(t, freedom), student_t::below(-t, freedom)];
            hold(found, [expected; 2], &format!("{t}, {freedom}"));
        }
    }

    #[test]
    fn both_tails_of_the_noncentral_t_keep_their_digits() {
        for (t, [freedom, off], expected) in [
            (
                2.0,
                [1.0, 5.0],
                [0.025_347_297_515_486_14, 0.974_652_702_484_513_9],
            ),
            (
                -3.0,
                [4.0, 1.0],
                [0.002_180_085_483_746_466_3, 0.997_819_914_516_253_5],
            ),
            (
                3.0,
                [4.0, -1.5],
                [0.999_443_508_790_545_2, 5.564_912_094_548_479e-4],
            ),
            (
                20.0,
                [50.0, 15.0],
                [0.987_661_410_786_045_3, 0.012_338_589_213_954_753],
            ),
            (
                80.0,
                [999.0, 73.5],
                [0.999_273_683_594_152_7, 7.263_164_058_473_166e-4],
            ),
            (
                1.0,
                [2.5, 0.5],
                [0.644_485_603_590_034_1, 0.355_514_396_409_965_94],
            ),
        ] {
            let below = noncentral_t::below(t, freedom, off);
            let found = [below, noncentral_t::above(t, freedom, off)];
            hold(found, expected, &format!("{t}, {freedom}, {off}"));
        }
    }

    #[test]
    fn quantiles_and_probabilities_are_inverse() {
        for share in [1e-12, 0.01, 0.5, 0.9, 0.999] {
            for freedom in [0.7, 1.0, 5.5, 300.0] {
                let t = student_t::below(student_t::quantile(share, freedom), freedom);
                let x = chi_square::below(chi_square::quantile(share, freedom), freedom);
                let f = f_ratio::below(f_ratio::quantile(share, freedom, 7.0), freedom, 7.0);
                let off = noncentral_t::quantile(share, freedom, 2.0);
                let off = noncentral_t::below(off, freedom, 2.0);
                for found in [t, x, f, off] {
                    assert!(
                        (found / share - 1.0).abs() < 1e-12,
                        "{share}, {freedom}: {found}"
                    );
                }
            }
        }
    }

    #[test]
    fn arguments_outside_the_domain_have_no_number() {
        assert!(student_t::quantile(1.5, 3.0).is_nan() && student_t::above(1.0, 0.0).is_nan());
        assert!(
            chi_square::quantile(0.5, -1.0).is_nan() && chi_square::below(f64::NAN, 1.0).is_nan()
        );
        assert!(f_ratio::quantile(0.5, 1.0, f64::NAN).is_nan());
        assert!(noncentral_t::below(f64::INFINITY, 1.0, 1.0).is_nan());
        assert!(noncentral_t::quantile(0.0, 1.0, 1.0).is_nan());
        assert!(chi_square::below(-1.0, 2.0) <= 0.0 && f_ratio::above(-1.0, 2.0, 2.0) >= 1.0);
        assert!(student_t::quantile(1.0, 3.0).is_infinite());
    }
}

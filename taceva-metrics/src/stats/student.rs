//! Student's t distribution, for any positive number of degrees of freedom.
//!
//! The code uses only + − × ÷ and √, which IEEE 754 rounds equally everywhere. The logarithms and gamma functions of platforms differ in
//! their last bits.

use std::f64::consts::{FRAC_2_SQRT_PI, PI};

/// Quantile: t for which ±t contains the share `central` of the distribution with `freedom` degrees of freedom.
///
/// Newton's method approaches the quantile from below, because the probability is concave. The iteration ends at the first step that does not
/// increase t. `central` is in 0..1 and `freedom` above 0.
pub(super) fn quantile(central: f64, freedom: f64) -> f64 {
    climb(freedom, |split| central - split.within)
}

/// Quantile: t for which the share `level` is outside ±t. Unlike [`quantile`], this function is accurate for a small `level`.
///
/// `level` is above 0 and at most 1.
pub(super) fn beyond(level: f64, freedom: f64) -> f64 {
    climb(freedom, |split| split.beyond - level)
}

/// Root of `missing` by Newton's method from t = 0, while t increases. `missing` is the probability that ±t does not contain yet.
fn climb(freedom: f64, missing: impl Fn(&Split) -> f64) -> f64 {
    /// Greatest number of steps; the 95 % quantile needs about ten.
    const MOST_STEPS: usize = 200;
    let mut t = 0.0;
    for _ in 0..MOST_STEPS {
        let missing = missing(&Split::at(t, freedom));
        let next = t + missing / (2.0 * density(t, freedom));
        if next <= t {
            break;
        }
        t = next;
    }
    t
}

/// P(T ≥ t) of Student's T: the upper one-sided p value.
pub(super) fn upper(t: f64, freedom: f64) -> f64 {
    let Split { within, beyond } = Split::at(t.abs(), freedom);
    if t < 0.0 {
        0.5 + within / 2.0
    } else {
        beyond / 2.0
    }
}

/// P(|T| < |t|) of Student's T.
pub(super) fn within(t: f64, freedom: f64) -> f64 {
    Split::at(t.abs(), freedom).within
}

/// Probabilities of Student's T within and beyond ±t.
struct Split {
    /// P(|T| < t) of Student's T.
    within: f64,
    /// P(|T| ≥ t) of Student's T.
    beyond: f64,
}

impl Split {
    /// Probabilities at `t`. For a large `t` the series gives `beyond`, so that small p values are accurate. Otherwise the series gives `within`.
    ///
    /// # Reference
    /// Abramowitz and Stegun, Handbook of Mathematical Functions, 26.7.1 and 26.5.4, of the incomplete beta function.
    fn at(t: f64, freedom: f64) -> Split {
        /// Greatest t² for which the series gives `within`. Beyond four standard deviations, 1 − within loses digits.
        const FAR: f64 = 16.0;
        let square = t * t;
        let half = freedom / 2.0;
        let far = 1.0 / (1.0 + square / freedom);
        let near = 1.0 / (1.0 + freedom / square);
        // √near × far^(ν/2) / B(ν/2, 1/2), which both series share.
        let front = near.sqrt() * power(far, half) * gamma_ratio(half) * (FRAC_2_SQRT_PI / 2.0);
        if front <= 0.0 {
            // t is 0, or so large that the remainder underflows.
            let within = if near < far { 0.0 } else { 1.0 };
            return Split {
                within,
                beyond: 1.0 - within,
            };
        }
        if square < FAR.min(freedom) {
            let within = front / 0.5 * series(half + 0.5, 1.5, near);
            Split {
                within,
                beyond: 1.0 - within,
            }
        } else {
            let beyond = front / half * series(half + 0.5, half + 1.0, far);
            Split {
                within: 1.0 - beyond,
                beyond,
            }
        }
    }
}

/// Hypergeometric series Σ (a)ₙ / (c)ₙ xⁿ with rising factorials: 1 + a/c x + a(a + 1)/(c(c + 1)) x² + …, for 0 ≤ x < 1.
fn series(mut a: f64, mut c: f64, x: f64) -> f64 {
    let (mut sum, mut term) = (1.0, 1.0);
    loop {
        term *= a / c * x;
        let next = sum + term;
        if next <= sum {
            return sum;
        }
        sum = next;
        a += 1.0;
        c += 1.0;
    }
}

/// Density of Student's distribution at t, with ν = `freedom`: Γ((ν + 1)/2) / (√(νπ) Γ(ν/2)) × (1 + t²/ν)^(−(ν + 1)/2).
fn density(t: f64, freedom: f64) -> f64 {
    let half = freedom / 2.0;
    let decline = power(1.0 / (1.0 + t * t / freedom), half + 0.5);
    gamma_ratio(half) / (freedom * PI).sqrt() * decline
}

/// Γ(z + 1/2) / Γ(z), for z > 0.
///
/// With w = z − 1/4 the ratio is √w (1 + 1/64 w⁻² − 19/8192 w⁻⁴ + 631/2¹⁹ w⁻⁶ − 174317/2²⁷ w⁻⁸ + …). The next term is below 2⁻⁵⁸ for z ≥ 32. For
/// smaller z, the ratio at z is z / (z + 1/2) times the ratio at z + 1.
pub(super) fn gamma_ratio(z: f64) -> f64 {
    const COEFFICIENTS: [f64; 5] = [
        1.0,
        1.0 / 64.0,
        -19.0 / 8192.0,
        631.0 / 524_288.0,
        -174_317.0 / 134_217_728.0,
    ];
    let (mut z, mut raised) = (z, 1.0);
    while z < 32.0 {
        raised *= z / (z + 0.5);
        z += 1.0;
    }
    let w = z - 0.25;
    let coefficients = COEFFICIENTS.iter().rev();
    let polynomial = coefficients.fold(0.0, |sum, coefficient| sum / (w * w) + coefficient);
    raised * w.sqrt() * polynomial
}

/// base^exponent for a base in 0..=1 and an exponent of at least 0, from repeated squares and square roots of the base.
pub(super) fn power(base: f64, exponent: f64) -> f64 {
    let mut whole = exponent.floor();
    let mut rest = exponent - whole;
    let mut result = 1.0;
    let mut factor = base;
    while whole >= 1.0 {
        let halved = (whole / 2.0).floor();
        if whole - 2.0 * halved >= 1.0 {
            result *= factor;
        }
        factor *= factor;
        whole = halved;
    }
    factor = base;
    while rest > 0.0 {
        factor = factor.sqrt();
        rest *= 2.0;
        if rest >= 1.0 {
            result *= factor;
            rest -= 1.0;
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    /// P(|T| ≥ |t|) of Student's T.
    fn two_sided(t: f64, freedom: f64) -> f64 {
        Split::at(t.abs(), freedom).beyond
    }

    #[test]
    fn what_lies_beyond_keeps_its_digits() {
        for freedom in [1.0, 3.0, 7.5, 31.0, 400.0] {
            for level in [1.0, 0.5, 0.05, 1e-3, 1e-6, 1e-9, 1e-12, 1.2e-16] {
                let found = two_sided(beyond(level, freedom), freedom);
                // Just inside 4 standard deviations the result is 1 minus the probability within.
                assert!(
                    (found / level - 1.0).abs() < 1e-10,
                    "{freedom} {level}: {found}"
                );
            }
            let near = beyond(0.05, freedom) / quantile(0.95, freedom);
            assert!((near - 1.0).abs() < 1e-13, "{freedom}: {near}");
        }
    }

    #[test]
    fn quantiles_agree_with_published_tables() {
        // Two-sided 95 %, nine decimals.
        let published = [
            (1, 12.706_204_736),
            (2, 4.302_652_730),
            (3, 3.182_446_305),
            (4, 2.776_445_105),
            (5, 2.570_581_836),
            (9, 2.262_157_163),
            (30, 2.042_272_456),
            (31, 2.039_513_446),
            (63, 1.998_340_543),
        ];
        for (freedom, expected) in published {
            let found = quantile(0.95, f64::from(freedom));
            // Half of the last printed decimal.
            assert!((found - expected).abs() <= 5.1e-10, "{freedom}: {found}");
        }
    }

    #[test]
    fn quantiles_between_whole_degrees_agree_with_a_calculation_in_forty_digits() {
        // Of the regularised incomplete beta function, by mpmath: degrees, 95 %, 90 %.
        let calculated = [
            (1.5, 6.016_663_104_427, 3.705_180_820_096),
            (4.5, 2.658_912_347_204, 2.065_575_888_878),
            (17.25, 2.107_488_737_428, 1.738_157_403_006),
            (62.5, 1.998_653_457_581, 1.669_601_560_291),
            (250.75, 1.969_469_740_099, 1.650_953_122_982),
        ];
        for (freedom, ninety_five, ninety) in calculated {
            for (central, expected) in [(0.95, ninety_five), (0.9, ninety)] {
                let found = quantile(central, freedom);
                // The last printed decimal.
                assert!((found - expected).abs() < 1e-12, "{freedom}: {found}");
            }
        }
    }

    #[test]
    fn p_values_agree_with_a_calculation_in_forty_digits() {
        // As above: degrees, t, P(|T| ≥ t).
        let calculated = [
            (0.5, 1.0, 6.0224322168264e-1),
            (1.0, 1.0, 5.0e-1),
            (4.5, 2.5, 5.9905686502201e-2),
            (7.25, 0.3, 7.7259683376395e-1),
            (17.7765, 2.22, 3.9671625632147e-2),
            (3.7, 12.0, 4.2678739938125e-4),
            (62.5, 5.5, 7.5037383343465e-7),
            (399.0, 3.3, 1.0537752110706e-3),
            (1234.5, 2.0, 4.5719023231055e-2),
        ];
        for (freedom, t, expected) in calculated {
            let found = two_sided(t, freedom);
            // The power rounds half as often as there are degrees of freedom; P is computed as 1 minus the rest.
            let tolerance = 1e-12 * expected + freedom * 1.2e-16;
            assert!(
                (found - expected).abs() < tolerance,
                "{freedom} {t}: {found}"
            );
        }
    }

    #[test]
    fn the_probability_at_a_quantile_is_the_one_asked_for() {
        for freedom in (1..=260).map(|quarters| f64::from(quarters) / 4.0) {
            for central in [0.5, 0.9, 0.95, 0.99] {
                let back = Split::at(quantile(central, freedom), freedom).within;
                // A few roundings of numbers near 1; the power rounds half as often as there are degrees of freedom.
                let tolerance = 4e-15 + freedom * 1.2e-16;
                assert!((back - central).abs() < tolerance, "{freedom}: {back}");
            }
        }
    }

    #[test]
    fn the_parts_of_the_distribution_add_up_to_all_of_it() {
        for t in [0.0, 0.3, 1.0, 4.0, 50.0] {
            let (down, up) = (upper(-t, 7.5), upper(t, 7.5));
            assert!((down + up - 1.0).abs() < 1e-15);
            assert!((2.0 * up - two_sided(t, 7.5)).abs() < 1e-15);
        }
        assert_eq!(two_sided(0.0, 3.0).to_bits(), 1.0_f64.to_bits());
        assert_eq!(two_sided(f64::MAX, 3.0).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn powers_agree_with_the_machine_s() {
        for base in [0.9999, 0.5, 0.123, 1e-12] {
            for exponent in [0.0, 0.25, 1.0 / 3.0, 1.0, 7.9, 20.5] {
                let quotient = power(base, exponent) / base.powf(exponent);
                assert!((quotient - 1.0).abs() < 1e-14, "{base}^{exponent}");
            }
        }
    }
}

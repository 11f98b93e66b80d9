//! Factors of gamma, beta and t densities, accurate for any number of degrees of freedom.

use crate::elementary::logarithm;

/// ln Γ(a + 1) − (a + ½) ln a + a − ½ ln 2π, a > 0: the error of Stirling's formula.
pub(super) fn stirling_error(a: f64) -> f64 {
    /// Least a for which the first omitted term of the series is below 2⁻⁵³ of the first term.
    const SERIES: f64 = 16.0;
    const TERMS: [f64; 7] = [
        1.0 / 12.0,
        -1.0 / 360.0,
        1.0 / 1260.0,
        -1.0 / 1680.0,
        1.0 / 1188.0,
        -691.0 / 360_360.0,
        1.0 / 156.0,
    ];
    let (mut a, mut raised) = (a, 0.0);
    while a < SERIES {
        // (a + ½) ln((a + 1) / a) − 1 = s²/3 + s⁴/5 + …, where s = 1 / (2a + 1).
        let s = 1.0 / (2.0 * a + 1.0);
        raised += match s * s < 0.032 {
            true => odd_powers(s * s),
            false => (a + 0.5) * logarithm((a + 1.0) / a) - 1.0,
        };
        a += 1.0;
    }
    let square = 1.0 / (a * a);
    let series = TERMS
        .iter()
        .rev()
        .fold(0.0, |sum, term| sum * square + term);
    raised + series / a
}

/// a ln(a / x) + x − a for positive a and x, without cancellation for a near x.
pub(super) fn deviance(a: f64, x: f64) -> f64 {
    let off = (x - a) / a;
    a * if off.abs() < 0.3 {
        // ln(1 + d) = 2 (s + s³/3 + …) and d − 2s = d s, where s = d / (2 + d).
        let s = off / (2.0 + off);
        off * s - 2.0 * s * odd_powers(s * s)
    } else {
        off - logarithm(x / a)
    }
}

/// z/3 + z²/5 + z³/7 + … for z up to 0.032.
fn odd_powers(z: f64) -> f64 {
    let mut odd = 27.0;
    let mut sum = 0.0;
    while odd >= 3.0 {
        sum = z * (1.0 / odd + sum);
        odd -= 2.0;
    }
    sum
}

/// e^w − 1 − w, without cancellation near 0.
pub(super) fn exponential_excess(w: f64) -> f64 {
    if w.abs() > 0.5 {
        return crate::elementary::exponential(w) - 1.0 - w;
    }
    // w²/2 (1 + w/3 (1 + w/4 (…))): the 16th term is below 2⁻⁶⁰.
    let mut term = 18.0;
    let mut sum = 1.0;
    while term >= 3.0 {
        sum = 1.0 + w / term * sum;
        term -= 1.0;
    }
    w * w / 2.0 * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stirling_s_error_agrees_with_a_calculation_in_forty_digits() {
        let calculated = [
            (0.01, 1.434_007_953_703_184_2),
            (0.5, 0.153_426_409_720_027_35),
            (1.0, 0.081_061_466_795_327_26),
            (7.25, 0.011_487_002_684_428_697),
            (40.0, 0.002_083_289_938_302_421_7),
        ];
        for (a, expected) in calculated {
            let found = stirling_error(a);
            assert!((found - expected).abs() < 4e-15, "{a}: {found}");
        }
    }

    #[test]
    fn both_forms_of_the_deviance_meet() {
        for off in [0.299_999, 0.300_001, -0.299_999, -0.300_001] {
            let direct = off - (1.0_f64 + off).ln();
            assert!((deviance(1.0, 1.0 + off) - direct).abs() < 1e-15, "{off}");
        }
        for w in [0.499_999_f64, -0.5, 0.1, -0.3] {
            let direct = w.exp_m1() - w;
            assert!((exponential_excess(w) - direct).abs() < 1e-16, "{w}");
        }
    }
}

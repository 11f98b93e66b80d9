//! Student's noncentral t distribution, for detection limits.

use super::student::{gamma_ratio, power, quantile, within};
use crate::elementary::exponential;

/// Risk of a false alarm, and risk of a missed detection.
const RISK: f64 = 0.05;

/// Smallest detectable difference from zero δ(ν), in standard deviations: 5 % risk of a false alarm, and 5 % risk of a missed detection. The standard
/// deviation is estimated with ν = `freedom` degrees of freedom.
///
/// Let t be the 95 % quantile of Student's distribution, and t′ noncentral with ν degrees of freedom. δ(ν) is the noncentrality for P(t′ ≤ t) = 5 %.
/// For a known standard deviation δ is 3.29.
///
/// # Reference
/// Currie, Pure and Applied Chemistry 67 (1995), 3.7.2; ISO 11843-2, 5.1.
pub(crate) fn detection_factor(freedom: f64) -> f64 {
    let threshold = critical_factor(freedom);
    let (mut low, mut high) = (0.0, 8.0 * threshold);
    for _ in 0..200 {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        match below(threshold, freedom, middle) > RISK {
            true => low = middle,
            false => high = middle,
        }
    }
    f64::midpoint(low, high)
}

/// The 95 % quantile of Student's distribution with `freedom` degrees of freedom.
pub(crate) fn critical_factor(freedom: f64) -> f64 {
    quantile(1.0 - 2.0 * RISK, freedom)
}

/// P(t′ ≤ t) of a noncentral t′ with ν = `freedom` and the noncentrality δ, for t ≥ 0 and δ ≥ 0.
///
/// Let y = δ² / 2, pⱼ = e^(−y) yʲ / j! and qⱼ = δ e^(−y) yʲ / (√2 Γ(j + 3/2)). Let Iₓ be the incomplete beta function at x = t² / (ν + t²). The
/// probability is ½ (1 + Σ pⱼ Iₓ(j + ½, ν/2) − Σ qⱼ (1 − Iₓ(j + 1, ν/2))). Here Σ qⱼ = 1 − 2 Φ(−δ) is used, with the normal distribution Φ.
///
/// # Reference
/// Lenth, Algorithm AS 243, Applied Statistics 38 (1989).
fn below(t: f64, freedom: f64, noncentrality: f64) -> f64 {
    /// Greatest number of terms of the sum, far beyond its largest term.
    const MOST: u32 = 10_000;
    let half = freedom / 2.0;
    let x = t * t / (freedom + t * t);
    let rest = power(freedom / (freedom + t * t), half);
    let y = noncentrality * noncentrality / 2.0;
    let start = exponential(-y);
    let two_over_pi = std::f64::consts::FRAC_2_PI.sqrt();
    let (mut p, mut q) = (start, noncentrality * start * two_over_pi);
    // Iₓ(½, ν/2) and Iₓ(1, ν/2), and their decrements from one j to the next.
    let (mut one, mut other) = (within(t, freedom), 1.0 - rest);
    let two_over_root_pi = std::f64::consts::FRAC_2_SQRT_PI;
    let mut lost = [
        x.sqrt() * rest * gamma_ratio(half) * two_over_root_pi,
        x * rest * half,
    ];
    let mut sum = 0.0;
    for j in 0..MOST {
        let at = f64::from(j);
        sum += p * one - q * (1.0 - other);
        one -= lost[0];
        other -= lost[1];
        lost[0] *= x * (at + 0.5 + half) / (at + 1.5);
        lost[1] *= x * (at + 1.0 + half) / (at + 2.0);
        p *= y / (at + 1.0);
        q *= y / (at + 1.5);
        if at > y && p + q < 1e-18 {
            break;
        }
    }
    f64::midpoint(1.0, sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_agree_with_50_digits() {
        let published = [
            (8.0, 3.617_126_558_904_401),
            (9.0, 3.575_384_834_044_819),
            (19.0, 3.414_994_210_194_465),
            (29.0, 3.369_887_208_450_547),
        ];
        for (freedom, expected) in published {
            let found = detection_factor(freedom);
            assert!(
                (found / expected - 1.0).abs() < 1e-12,
                "{freedom}: {found} is not {expected}"
            );
        }
    }

    #[test]
    fn many_degrees_of_freedom_come_to_a_known_deviation() {
        let found = detection_factor(1e6);
        assert!((found - 3.289_707_253_902_943).abs() < 1e-5, "{found}");
        assert!(detection_factor(1.0) > 8.0);
    }

    #[test]
    fn without_noncentrality_it_is_student_s_distribution() {
        for (t, freedom) in [(0.5, 3.0), (1.0, 9.0), (1.832_112_932_65, 9.0), (2.5, 40.0)] {
            let expected = 1.0 - crate::stats::student::upper(t, freedom);
            assert!((below(t, freedom, 0.0) - expected).abs() < 1e-13);
        }
    }
}

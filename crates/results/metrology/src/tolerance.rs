//! Tolerance intervals: limits that hold a share of all values with a confidence.
//!
//! ```
//! use taceva_metrology::tolerance::{least_n_one_sided, least_n_two_sided, two_sided_factor};
//! // 95 % of the values with confidence 95 %, from 20 of them: mean ± 2.76 standard deviations.
//! let k = two_sided_factor(20.0, 19.0, 0.95, 0.95).ok_or("valid")?;
//! assert!((k - 2.760_346).abs() < 1e-6);
//! // From the least to the greatest value, whatever the distribution.
//! assert_eq!((least_n_two_sided(0.95, 0.95), least_n_one_sided(0.95, 0.95)), (Some(93), Some(59)));
//! # Ok::<(), &str>(())
//! ```
//!
//! # Reference
//! Krishnamoorthy and Mathew, Statistical Tolerance Regions (2009), 2.2, 2.3 and 8.6; ISO 16269-6:2014.

use serde::{Deserialize, Serialize};
use taceva_metrics::distributions::{chi_square, noncentral_t, normal};
use taceva_metrics::elementary::{exponential, logarithm};
use taceva_metrics::{Dyadic, ExactSum};

use crate::quadrature::integral;

fn is_share(value: f64) -> bool {
    value > 0.0 && value < 1.0
}

fn is_valid(n: f64, freedom: f64, share: f64, confidence: f64) -> bool {
    let is_positive = |value: f64| value > 0.0 && value.is_finite();
    is_positive(n) && is_positive(freedom) && is_share(share) && is_share(confidence)
}

/// Factor k of a one-sided limit: mean + k s has `share` of a normal distribution below it, with `confidence`.
///
/// The mean has the variance σ²/`n`, and s has `freedom` degrees of freedom: n − 1 for independent values. `None` for an argument out of
/// range.
///
/// ```
/// use taceva_metrology::tolerance::one_sided_factor;
/// let k = one_sided_factor(43.0, 42.0, 0.9, 0.99).ok_or("valid")?;
/// assert!((k - 1.873_953_605_851_2).abs() < 1e-12);
/// # Ok::<(), &str>(())
/// ```
#[must_use]
pub fn one_sided_factor(n: f64, freedom: f64, share: f64, confidence: f64) -> Option<f64> {
    is_valid(n, freedom, share, confidence).then(|| {
        let noncentrality = normal::quantile(share) * n.sqrt();
        noncentral_t::quantile(confidence, freedom, noncentrality) / n.sqrt()
    })
}

/// Factor k of a two-sided interval: mean ± k s holds `share` of a normal distribution, with `confidence`.
///
/// Exact by the integral over the error of the mean, not by Howe's approximation. Arguments are those of [`one_sided_factor`].
///
/// ```
/// use taceva_metrology::tolerance::two_sided_factor;
/// // Howe's approximation is 2.2173.
/// let k = two_sided_factor(43.0, 42.0, 0.9, 0.99).ok_or("valid")?;
/// assert!((k - 2.222_825).abs() < 1e-6);
/// # Ok::<(), &str>(())
/// ```
#[must_use]
pub fn two_sided_factor(n: f64, freedom: f64, share: f64, confidence: f64) -> Option<f64> {
    /// Greatest error of the mean in standard deviations of the mean, and width of a panel.
    const FAR: f64 = 9.0;
    const WIDTH: f64 = 0.75;
    if !is_valid(n, freedom, share, confidence) {
        return None;
    }
    let root = n.sqrt();
    // Half-widths that hold the share about a mean that is off.
    let held = |k: f64| {
        let at = |z: f64| {
            let half = half_width(z / root, share) / k;
            normal::density(z) * chi_square::above(freedom * half * half, freedom)
        };
        2.0 * integral(at, 0.0, FAR, WIDTH)
    };
    let mut high = half_width(0.0, share);
    // A confidence within rounding of 1 has no factor.
    while held(high) < confidence {
        if !high.is_finite() {
            return None;
        }
        high *= 2.0;
    }
    let mut low = 0.0;
    loop {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high || high - low <= 1e-14 * high {
            return Some(middle);
        }
        match held(middle) < confidence {
            true => low = middle,
            false => high = middle,
        }
    }
}

/// The r for which a normal number is within `off` ± r with probability `share`.
fn half_width(off: f64, share: f64) -> f64 {
    let missed = |r: f64| normal::above(r - off) + normal::above(r + off);
    let density = |r: f64| normal::density(r - off) + normal::density(r + off);
    let outside = 1.0 - share;
    // From the side where all of one tail is outside, Newton's steps only increase.
    let mut r = (off + normal::quantile(share)).max(normal::quantile(f64::midpoint(1.0, share)));
    for _ in 0..60 {
        let next = r + (missed(r) - outside) / density(r);
        if (next - r).abs() <= f64::EPSILON * r {
            return next;
        }
        r = next;
    }
    r
}

/// Least number of values whose extremes hold `share` of any continuous distribution, with `confidence`; `None` for one that is no share.
#[must_use]
pub fn least_n_two_sided(share: f64, confidence: f64) -> Option<u64> {
    // 1 − n Pⁿ⁻¹ + (n − 1) Pⁿ grows with n.
    let held = |n: f64| {
        let log = logarithm(share);
        1.0 - n * exponential((n - 1.0) * log) + (n - 1.0) * exponential(n * log)
    };
    (is_share(share) && is_share(confidence)).then(|| least_n(2, |n| held(n) >= confidence))
}

/// Least number of values whose greatest has `share` of any continuous distribution below it, with `confidence`.
#[must_use]
pub fn least_n_one_sided(share: f64, confidence: f64) -> Option<u64> {
    let held = |n: f64| 1.0 - exponential(n * logarithm(share));
    (is_share(share) && is_share(confidence)).then(|| least_n(1, |n| held(n) >= confidence))
}

/// The least number from `first` on that is enough, as all above it are.
fn least_n(first: u64, is_enough: impl Fn(f64) -> bool) -> u64 {
    let real = |n: u64| {
        #[expect(
            clippy::cast_precision_loss,
            reason = "numbers of samples are below 2^53"
        )]
        let real = n as f64;
        real
    };
    let (mut low, mut high) = (first, first);
    while !is_enough(real(high)) && high < 1 << 52 {
        (low, high) = (high + 1, 2 * high);
    }
    while low < high {
        let middle = low.midpoint(high);
        match is_enough(real(middle)) {
            true => high = middle,
            false => low = middle + 1,
        }
    }
    high
}

/// Interval mean ± k s of independent values of a normal distribution, in their unit.
///
/// ```
/// use taceva_metrology::tolerance::ToleranceInterval;
/// let errors = [0.01, -0.02, 0.00, 0.03, -0.01, 0.02];
/// let found = ToleranceInterval::of(&errors, 0.95, 0.95).ok_or("six values")?;
/// assert_eq!(found.n, 6);
/// assert!(found.low < -0.02 && found.high > 0.03);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ToleranceInterval {
    /// Number of values.
    pub n: u64,
    /// Share of all values that the interval holds.
    pub share: f64,
    /// Confidence with which it does.
    pub confidence: f64,
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the values.
    pub sd: f64,
    /// Factor of the standard deviation.
    pub k: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl ToleranceInterval {
    /// Interval of `values`; `None` below two values, for a value that is not finite, or a share or confidence out of range.
    #[must_use]
    pub fn of(values: &[f64], share: f64, confidence: f64) -> Option<ToleranceInterval> {
        let Spread { n, mean, sd } = Spread::of(values)?;
        #[expect(
            clippy::cast_precision_loss,
            reason = "numbers of samples are below 2^53"
        )]
        let real = n as f64;
        let k = two_sided_factor(real, real - 1.0, share, confidence)?;
        Some(ToleranceInterval {
            n,
            share,
            confidence,
            mean,
            sd,
            k,
            low: mean - k * sd,
            high: mean + k * sd,
        })
    }
}

/// Number, mean and standard deviation of values, each rounded once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spread {
    pub(crate) n: u64,
    pub(crate) mean: f64,
    pub(crate) sd: f64,
}

impl Spread {
    /// Spread of at least two finite values.
    pub(crate) fn of(values: &[f64]) -> Option<Spread> {
        let n = u64::try_from(values.len()).unwrap_or(u64::MAX);
        if n < 2 || values.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let sum = values.iter().copied().collect::<ExactSum>().to_dyadic();
        let mut squares = ExactSum::default();
        values
            .iter()
            .for_each(|&value| squares.add_product(value, value));
        let count = Dyadic::from(n);
        let spread = &(&count * &squares.to_dyadic()) - &(&sum * &sum);
        Some(Spread {
            n,
            mean: sum.over(&count),
            sd: spread.root_over(&(&count * &Dyadic::from(n - 1))),
        })
    }
}

//! Factors of tolerance limits, which contain a share of a normal distribution with a given confidence.
//!
//! ```
//! use taceva_metrics::distributions::tolerance::two_sided_factor;
//! // From 20 values, 95 % of all values with confidence 95 %: mean ± 2.76 standard deviations.
//! let k = two_sided_factor(20.0, 19.0, 0.95, 0.95).ok_or("valid")?;
//! assert!((k - 2.760_346).abs() < 1e-6);
//! # Ok::<(), &str>(())
//! ```
//!
//! # Reference
//! Krishnamoorthy and Mathew, Statistical Tolerance Regions (2009), 2.2 and 2.3; ISO 16269-6:2014.

use super::quadrature::nodes;
use super::{chi_square, noncentral_t, normal};

fn is_valid(n: f64, freedom: f64, share: f64, confidence: f64) -> bool {
    let is_positive = |value: f64| value > 0.0 && value.is_finite();
    let is_share = |value: f64| value > 0.0 && value < 1.0;
    is_positive(n) && is_positive(freedom) && is_share(share) && is_share(confidence)
}

/// Factor k of a one-sided limit: with `confidence`, at least `share` of a normal distribution is below mean + k s.
///
/// The estimated mean has the variance σ²/`n`. The estimated standard deviation s has `freedom` degrees of freedom: n − 1 for independent values.
/// Returns `None` for an argument out of range.
///
/// ```
/// use taceva_metrics::distributions::tolerance::one_sided_factor;
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

/// Factor k of a two-sided interval: with `confidence`, mean ± k s contains at least `share` of a normal distribution.
///
/// The factor is exact, from an integral over the error of the mean. The approximation of Howe is only the first guess. The arguments are as in
/// [`one_sided_factor`].
///
/// ```
/// use taceva_metrics::distributions::tolerance::two_sided_factor;
/// // Howe's approximation is 2.2173.
/// let k = two_sided_factor(43.0, 42.0, 0.9, 0.99).ok_or("valid")?;
/// assert!((k - 2.222_825).abs() < 1e-6);
/// # Ok::<(), &str>(())
/// ```
#[must_use]
pub fn two_sided_factor(n: f64, freedom: f64, share: f64, confidence: f64) -> Option<f64> {
    /// Upper end of the integral over the error of the mean, in standard deviations of the mean.
    const FAR: f64 = 9.0;
    /// Width of a panel of the integral, in standard deviations of the mean.
    const WIDTH: f64 = 0.75;
    if !is_valid(n, freedom, share, confidence) {
        return None;
    }
    // Half-widths that contain the share for each error of the mean, with the weights of these errors.
    let halves = nodes(0.0, FAR, WIDTH).into_iter().map(|node| {
        let half = half_width(node.at / n.sqrt(), share);
        [half, 2.0 * node.weight * normal::density(node.at)]
    });
    let halves: Vec<[f64; 2]> = halves.collect();
    let off = |k: f64| {
        let held = halves.iter().map(|[half, weight]| {
            let ratio = half / k;
            weight * chi_square::above(freedom * ratio * ratio, freedom)
        });
        held.sum::<f64>() - confidence
    };
    let spread = (freedom / chi_square::quantile(1.0 - confidence, freedom)).sqrt();
    let howe = half_width(0.0, share) * (1.0 + 1.0 / n).sqrt() * spread;
    root(off, howe.min(1e100))
}

/// Positive zero of an increasing function by the Illinois method, from a guess above 0. `None` if the search finds no zero.
///
/// # Reference
/// Dowell and Jarratt, BIT 11 (1971).
fn root(function: impl Fn(f64) -> f64, guess: f64) -> Option<f64> {
    const MOST: usize = 200;
    let first = function(guess);
    let ([mut low, mut high], [mut below, mut above]) = ([guess; 2], [first; 2]);
    let mut step = 1.01;
    while below > 0.0 {
        (high, above) = (low, below);
        low /= step;
        step *= step;
        below = function(low);
    }
    while above < 0.0 {
        (low, below) = (high, above);
        high *= step;
        step *= step;
        // A confidence within rounding of 1 has no factor.
        if !high.is_finite() {
            return None;
        }
        above = function(high);
    }
    let mut last = f64::NAN;
    for _ in 0..MOST {
        if below >= 0.0 {
            return Some(low);
        }
        if above <= 0.0 {
            return Some(high);
        }
        let next = high - above * (high - low) / (above - below);
        let is_settled = (next - last).abs() <= 1e-14 * next;
        if is_settled || next <= low || next >= high {
            return Some(next);
        }
        let found = function(next);
        // The value at an end that stays twice is halved, so that the next point moves this end.
        if found < 0.0 {
            if last <= low {
                above /= 2.0;
            }
            (low, below) = (next, found);
        } else {
            if last >= high {
                below /= 2.0;
            }
            (high, above) = (next, found);
        }
        last = next;
    }
    None
}

/// Half-width r for which a standard normal number is within `off` ± r with probability `share`.
fn half_width(off: f64, share: f64) -> f64 {
    let missed = |r: f64| normal::above(r - off) + normal::above(r + off);
    let density = |r: f64| normal::density(r - off) + normal::density(r + off);
    let outside = 1.0 - share;
    // The start is at most the solution, so Newton's steps only increase.
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

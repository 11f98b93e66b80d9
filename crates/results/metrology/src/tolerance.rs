//! Tolerance intervals: limits that contain a share of all values with a given confidence.
//!
//! ```
//! use taceva_metrology::tolerance::{least_n_one_sided, least_n_two_sided, two_sided_factor};
//! // From 20 values, 95 % of all values with confidence 95 %: mean ± 2.76 standard deviations.
//! let k = two_sided_factor(20.0, 19.0, 0.95, 0.95).ok_or("valid")?;
//! assert!((k - 2.760_346).abs() < 1e-6);
//! // From the least to the greatest value, whatever the distribution.
//! assert_eq!((least_n_two_sided(0.95, 0.95), least_n_one_sided(0.95, 0.95)), (Some(93), Some(59)));
//! # Ok::<(), &str>(())
//! ```
//!
//! # Reference
//! Krishnamoorthy and Mathew, Statistical Tolerance Regions (2009), 8.6; ISO 16269-6:2014.

use serde::{Deserialize, Serialize};
pub use taceva_metrics::distributions::tolerance::{one_sided_factor, two_sided_factor};
use taceva_metrics::elementary::{exponential, logarithm};
use taceva_metrics::{Moments, NormalSample, OneWaySums};

fn is_share(value: f64) -> bool {
    value > 0.0 && value < 1.0
}

/// Least number of values whose extremes contain `share` of any continuous distribution with `confidence`; `None` unless both are in 0..1.
#[must_use]
pub fn least_n_two_sided(share: f64, confidence: f64) -> Option<u64> {
    // 1 − n Pⁿ⁻¹ + (n − 1) Pⁿ grows with n.
    let held = |n: f64| {
        let log = logarithm(share);
        1.0 - n * exponential((n - 1.0) * log) + (n - 1.0) * exponential(n * log)
    };
    (is_share(share) && is_share(confidence)).then(|| least_n(2, |n| held(n) >= confidence))
}

/// Least number of values whose maximum exceeds `share` of any continuous distribution with `confidence`; `None` unless both are in 0..1.
#[must_use]
pub fn least_n_one_sided(share: f64, confidence: f64) -> Option<u64> {
    let held = |n: f64| 1.0 - exponential(n * logarithm(share));
    (is_share(share) && is_share(confidence)).then(|| least_n(1, |n| held(n) >= confidence))
}

/// Least number from `first` on for which `is_enough` is true. `is_enough` must be monotonic.
fn least_n(first: u64, is_enough: impl Fn(f64) -> bool) -> u64 {
    let (mut low, mut high) = (first, first);
    while !is_enough(high as f64) && high < 1 << 52 {
        (low, high) = (high + 1, 2 * high);
    }
    while low < high {
        let middle = low.midpoint(high);
        match is_enough(middle as f64) {
            true => high = middle,
            false => low = middle + 1,
        }
    }
    high
}

/// Tolerance interval mean ± k s of independent, normally distributed values, in the unit of the values.
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
    /// Share of all values that the interval contains.
    pub share: f64,
    /// Confidence that the interval contains this share.
    pub confidence: f64,
    /// Mean of the values.
    pub mean: f64,
    /// Standard deviation of the values.
    pub sd: f64,
    /// Factor k of the standard deviation.
    pub k: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

impl ToleranceInterval {
    /// Interval of `values`; `None` for fewer than two values, a value that is not finite, or a share or confidence out of range.
    #[must_use]
    pub fn of(values: &[f64], share: f64, confidence: f64) -> Option<ToleranceInterval> {
        let values = moments(values)?;
        let sample = NormalSample::of_independent(&values)?;
        ToleranceInterval::of_sample(values.n, &sample, share, confidence)
    }

    /// Tolerance interval of clustered values. Values may be correlated within a cluster, so the confidence is approximate.
    ///
    /// `None` for fewer than two clusters, no cluster with two values, no variation, and under the conditions of [`of`](ToleranceInterval::of).
    ///
    /// ```
    /// use taceva_metrology::tolerance::ToleranceInterval;
    /// let clusters = [[0.0, 0.1, 0.2], [1.0, 1.1, 1.2], [2.0, 2.1, 2.2]];
    /// let found = ToleranceInterval::of_clusters(clusters.iter().map(|of| of.as_slice()), 0.95, 0.95).ok_or("three")?;
    /// // Hardly more is known of three clusters than of three values.
    /// assert_eq!(found.n, 9);
    /// assert!(found.k > 9.0);
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn of_clusters<'a>(
        clusters: impl IntoIterator<Item = &'a [f64]>,
        share: f64,
        confidence: f64,
    ) -> Option<ToleranceInterval> {
        let mut sums = OneWaySums::default();
        for cluster in clusters {
            sums.add(&moments(cluster)?);
        }
        let model = sums.model()?;
        let sample = NormalSample::of_clusters(&model)?;
        ToleranceInterval::of_sample(model.readings, &sample, share, confidence)
    }

    fn of_sample(
        n: u64,
        sample: &NormalSample,
        share: f64,
        confidence: f64,
    ) -> Option<ToleranceInterval> {
        let NormalSample { mean, sd, .. } = *sample;
        let k = sample.tolerance_factor(share, confidence)?;
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

/// Sums of `values`; `None` if a value is not finite.
fn moments(values: &[f64]) -> Option<Moments> {
    let are_finite = values.iter().all(|value| value.is_finite());
    are_finite.then(|| values.iter().copied().collect())
}

//! Published shares with an interval from the spread over test sets, and the correct interval of each share.

use taceva_metrics::Interval;
use taceva_metrics::distributions::student_t;

use crate::quotient::ratio;

/// Normal quantile of 95 % in the published formula.
const Z: f64 = 1.96;

/// A published share of right samples over several test sets, with the half-width 1.96 SD / √samples.
///
/// SD is the standard deviation over the sets. The division by the root of the number of *samples* is wrong, because the number of sets determines
/// the uncertainty.
///
/// ```
/// use taceva_tasks::PublishedShare;
/// // TacBench, grasp stability, MAE (base), ViT-B: 0.8193 ± 0.0021 of six sets.
/// let published = PublishedShare::new(1229, 1500, 6, 0.002_14);
/// assert!((published.half_width_by_sets() - 0.0486).abs() < 5e-5);
/// assert!((published.ratio() - 22.7).abs() < 0.05);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PublishedShare {
    /// Number of right samples.
    pub hits: u64,
    /// Number of all samples.
    pub samples: u64,
    /// Number of test sets.
    pub sets: u32,
    /// Published half-width of the interval, as a share.
    pub half_width: f64,
}

impl PublishedShare {
    /// A share of `samples`, at least one, in `sets`, at least two, with its published half-width.
    ///
    /// # Panics
    /// If there are fewer than two sets, no sample, or more hits than samples.
    #[must_use]
    pub fn new(hits: u64, samples: u64, sets: u32, half_width: f64) -> PublishedShare {
        assert!(
            sets >= 2 && samples > 0 && hits <= samples,
            "{hits} hits of {samples} samples in {sets} sets"
        );
        PublishedShare {
            hits,
            samples,
            sets,
            half_width,
        }
    }

    /// The published half-width of shares with the standard deviation `sd` over sets: 1.96 SD / √samples.
    #[must_use]
    pub fn half_width_of(sd: f64, samples: u64) -> f64 {
        Z * sd / ratio(u128::from(samples), 1).sqrt()
    }

    /// Share of right samples.
    #[must_use]
    pub fn value(&self) -> f64 {
        ratio(u128::from(self.hits), u128::from(self.samples))
    }

    /// Standard deviation over the sets, from the published half-width. As in NumPy, the variance divides by the number of sets.
    #[must_use]
    pub fn sd_over_sets(&self) -> f64 {
        self.half_width / PublishedShare::half_width_of(1.0, self.samples)
    }

    /// Half-width of the 95 % interval over sets: t SD / √(sets − 1), with Student's t of sets − 1 degrees of freedom.
    ///
    /// The root is of sets − 1, because SD divides by the number of sets.
    #[must_use]
    pub fn half_width_by_sets(&self) -> f64 {
        let freedom = f64::from(self.sets - 1);
        student_t::quantile(0.975, freedom) * self.sd_over_sets() / freedom.sqrt()
    }

    /// Half-width over sets / published half-width.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.half_width_by_sets() / self.half_width
    }

    /// Interval by Wilson as if all samples were independent, which is too narrow for frames of one object.
    #[must_use]
    pub fn if_frames_were_independent(&self) -> Interval {
        Interval::wilson(self.hits, self.samples)
    }
}

//! Limits that contain a share of all values of a normal distribution, from a sample of independent or clustered values.

use super::one_way::OneWay;
use crate::count::as_f64;
use crate::distributions::{chi_square, noncentral_t, normal, student_t, tolerance};
use crate::exact::{Dyadic, Moments};

/// Share of values between the limits, and confidence of all intervals.
const SHARE: f64 = 0.95;

/// Mean and standard deviation of a normal sample, with the uncertainty of both.
///
/// ```
/// use taceva_metrics::{Moments, NormalSample};
/// let errors: Moments = [0.01, -0.02, 0.00, 0.03, -0.01, 0.02].into_iter().collect();
/// let found = NormalSample::of_independent(&errors).ok_or("six errors")?;
/// assert_eq!((found.worth, found.freedom), (6.0, 5.0));
/// let [low, high] = found.limits();
/// assert!((low + 0.0317).abs() < 5e-5 && (high - 0.0417).abs() < 5e-5);
/// # Ok::<(), &str>(())
/// ```
///
/// # Reference
/// Carkeet, Optometry and Vision Science 92 (2015), exact ends; Satterthwaite, Biometrics Bulletin 2 (1946), clusters.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NormalSample {
    /// Mean of the values.
    pub mean: f64,
    /// Degrees of freedom of the uncertainty of the mean.
    pub mean_freedom: f64,
    /// Standard deviation of one value.
    pub sd: f64,
    /// Degrees of freedom of the standard deviation.
    pub freedom: f64,
    /// Effective sample size: the mean of so many independent values would have the same uncertainty.
    pub worth: f64,
}

impl NormalSample {
    /// Sample of independent values; `None` for fewer than two values.
    #[must_use]
    pub fn of_independent(values: &Moments) -> Option<NormalSample> {
        let mean = values.mean().filter(|_| values.n >= 2)?;
        let count = Dyadic::from(values.n);
        let freedom = values.n - 1;
        Some(NormalSample {
            mean,
            mean_freedom: as_f64(freedom),
            sd: values
                .scaled_spread()
                .root_over(&(&count * &Dyadic::from(freedom))),
            freedom: as_f64(freedom),
            worth: as_f64(values.n),
        })
    }

    /// Sample of clustered values, which depend on each other within a cluster; `None` if the values do not vary.
    ///
    /// The standard deviation includes both variance components, with degrees of freedom by Satterthwaite. Interval ends are therefore
    /// approximate, and too narrow if clusters differ in spread.
    #[must_use]
    pub fn of_clusters(model: &OneWay) -> Option<NormalSample> {
        let freedom = model.total_freedom?;
        let ratio = model.total / model.mean_uncertainty;
        Some(NormalSample {
            mean: model.mean,
            mean_freedom: as_f64(model.groups - 1),
            sd: model.total,
            freedom,
            worth: match model.mean_uncertainty > 0.0 {
                true => ratio * ratio,
                false => as_f64(model.readings),
            },
        })
    }

    /// Limits that contain 95 % of values: mean ± 1.96 standard deviations.
    #[must_use]
    pub fn limits(&self) -> [f64; 2] {
        let half = self.half_width();
        [self.mean - half, self.mean + half]
    }

    /// Half the distance between the limits.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        z() * self.sd
    }

    /// 95 % interval of the mean, by Student's distribution.
    #[must_use]
    pub fn mean_ends(&self) -> [f64; 2] {
        let t = student_t::quantile(f64::midpoint(1.0, SHARE), self.mean_freedom);
        let half = t * self.sd / self.worth.sqrt();
        [self.mean - half, self.mean + half]
    }

    /// 95 % interval of the standard deviation, by the chi-square distribution.
    #[must_use]
    pub fn sd_ends(&self) -> [f64; 2] {
        let at = |share: f64| {
            self.sd * (self.freedom / chi_square::quantile(share, self.freedom)).sqrt()
        };
        let tail = (1.0 - SHARE) / 2.0;
        [at(1.0 - tail), at(tail)]
    }

    /// 95 % intervals of the lower and of the upper limit, by the noncentral t distribution.
    #[must_use]
    pub fn limit_ends(&self) -> [[f64; 2]; 2] {
        let root = self.worth.sqrt();
        let tail = (1.0 - SHARE) / 2.0;
        let shift = z() * root;
        // (limit − mean) √n / s has the noncentral t distribution; the lower limit is its mirror image.
        let end = |share| noncentral_t::quantile(share, self.freedom, shift) / root * self.sd;
        let (near, far) = (end(tail), end(1.0 - tail));
        [
            [self.mean - far, self.mean - near],
            [self.mean + near, self.mean + far],
        ]
    }

    /// Factor k: mean ± k standard deviations contains `share` of all values with `confidence`. `None` for an argument out of range.
    #[must_use]
    pub fn tolerance_factor(&self, share: f64, confidence: f64) -> Option<f64> {
        tolerance::two_sided_factor(self.worth, self.freedom, share, confidence)
    }
}

/// Half-width of the limits in standard deviations, 1.96.
fn z() -> f64 {
    normal::quantile(f64::midpoint(1.0, SHARE))
}

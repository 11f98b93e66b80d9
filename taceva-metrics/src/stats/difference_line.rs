//! Least-squares line of the difference of two methods against their mean.

use crate::count::as_f64;
use crate::distributions::student_t;
use crate::exact::merge::Merge;
use crate::exact::{Dyadic, ExactSum, Moments};

/// Exact sums for a line of the difference d of a pair against its mean m, without the sums of d alone. Sums of shards merge in any order.
///
/// ```
/// use taceva_metrics::{DifferenceLine, Moments};
/// // The second method reads 10 % more.
/// let (mut line, mut differences) = (DifferenceLine::default(), Moments::default());
/// for x in [1.0, 2.0, 3.0, 4.5] {
///     line.add(x, 1.1 * x);
///     differences.add(x - 1.1 * x);
/// }
/// let found = line.proportional(&differences).ok_or("four pairs")?;
/// assert!((found.slope + 0.1 / 1.05).abs() < 1e-12 && found.p < 1e-9);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DifferenceLine {
    /// Σ m, Σ m² and Σ m d over all pairs, with the mean m and the difference d of a pair.
    pub(crate) sums: [ExactSum; 3],
}

/// Slope of the difference between two methods over their mean, with its uncertainty.
///
/// ```
/// use taceva_metrics::{DifferenceLine, Moments};
/// assert_eq!(DifferenceLine::default().proportional(&Moments::default()), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Proportional {
    /// Change of the difference per unit of the mean of both methods.
    pub slope: f64,
    /// Standard error of the slope, for independent pairs.
    pub standard_error: f64,
    /// p value of the hypothesis that the slope is 0, for independent pairs.
    pub p: f64,
}

impl DifferenceLine {
    /// Adds a pair of finite values, one of each method.
    pub fn add(&mut self, one: f64, other: f64) {
        let (mean, difference) = (f64::midpoint(one, other), one - other);
        let [of_means, squares, shared] = &mut self.sums;
        of_means.add(mean);
        squares.add_product(mean, mean);
        shared.add_product(mean, difference);
    }

    /// Adds the pairs of `other`.
    pub fn merge(&mut self, other: &DifferenceLine) {
        self.sums.merge(&other.sums);
    }

    /// Slope of the least-squares line; `differences` holds the differences of the same pairs. `None` for fewer than three pairs, or if all means are
    /// equal.
    #[must_use]
    pub fn proportional(&self, differences: &Moments) -> Option<Proportional> {
        let n = differences.n;
        if n < 3 {
            return None;
        }
        let count = Dyadic::from(n);
        let [x, xx, xy] = self.sums.each_ref().map(|sum| sum.to_dyadic());
        let xx = &(&count * &xx) - &(&x * &x);
        if xx.is_zero() {
            return None;
        }
        let xy = &(&count * &xy) - &(&x * &differences.sum.to_dyadic());
        let yy = differences.scaled_spread();
        let freedom = n - 2;
        // Variance of the slope: (Sxx Syy − Sxy²) / (Sxx² (n − 2)).
        let left = &(&xx * &yy) - &(&xy * &xy);
        let standard_error = left.root_over(&(&(&xx * &xx) * &Dyadic::from(freedom)));
        let slope = xy.over(&xx);
        Some(Proportional {
            slope,
            standard_error,
            p: chance(slope, standard_error, as_f64(freedom)),
        })
    }
}

/// p value of the hypothesis that the true slope is 0. If the standard error is 0, a slope of 0 has p = 1, and any other slope has p = 0.
pub(crate) fn chance(slope: f64, standard_error: f64, freedom: f64) -> f64 {
    match standard_error > 0.0 {
        true => 2.0 * student_t::above(slope.abs() / standard_error, freedom),
        false if slope.abs() > 0.0 => 0.0,
        false => 1.0,
    }
}

impl Merge for DifferenceLine {
    fn merge(&mut self, other: &DifferenceLine) {
        DifferenceLine::merge(self, other);
    }
}

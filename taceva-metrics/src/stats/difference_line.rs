//! Line through the differences of two methods over their means.

use crate::count::as_f64;
use crate::distributions::student_t;
use crate::exact::merge::Merge;
use crate::exact::{Dyadic, ExactSum, Moments};

/// Exact sums for a line through the differences d of pairs over their means m, except the sums of d. Sums of parts merge in any order.
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
    /// Σ m, Σ m² and Σ m d.
    pub(crate) sums: [ExactSum; 3],
}

/// Change of the difference of two methods with the magnitude of the measured quantity.
///
/// ```
/// use taceva_metrics::{DifferenceLine, Moments};
/// assert_eq!(DifferenceLine::default().proportional(&Moments::default()), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Proportional {
    /// Slope of the difference over the mean of both methods.
    pub slope: f64,
    /// Standard error of the slope, for independent pairs.
    pub standard_error: f64,
    /// p value of the slope, for independent pairs.
    pub p: f64,
}

impl DifferenceLine {
    /// Adds a pair of finite values.
    pub fn add(&mut self, one: f64, other: f64) {
        let (mean, difference) = (f64::midpoint(one, other), one - other);
        let [of_means, squares, shared] = &mut self.sums;
        of_means.add(mean);
        squares.add_product(mean, mean);
        shared.add_product(mean, difference);
    }

    /// Adds the pairs of another part.
    pub fn merge(&mut self, other: &DifferenceLine) {
        self.sums.merge(&other.sums);
    }

    /// Least-squares line, with the sums of the same differences; `None` for fewer than three pairs, or if all means are equal.
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

/// p value of a slope. With a standard error of 0, 1 for a slope of 0 and 0 for any other slope.
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

//! Sums of the distances between estimate and reference in a plane.

use crate::exact::merge::Merge;
use crate::exact::{ColumnSums, ExactSum};
use crate::pair::Paired;

/// Number of samples, and exact sum of their distances between estimate and reference.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct PlaneSums {
    pub(crate) n: u64,
    pub(crate) n_invalid: u64,
    pub(crate) distance: ExactSum,
}

impl PlaneSums {
    /// Adds one sample, given its pairs along x and y. A sample with an invalid value only raises the count of skipped samples.
    pub(crate) fn add(&mut self, x: Paired<f64>, y: Paired<f64>) {
        match PlaneSums::distance_of(x, y) {
            Some(distance) => {
                self.n += 1;
                self.distance.add(distance);
            }
            None => self.n_invalid += 1,
        }
    }

    /// Distance between estimate and reference; `None` if a value is not finite or too large.
    #[inline]
    pub(crate) fn distance_of(x: Paired<f64>, y: Paired<f64>) -> Option<f64> {
        let is_usable = x.is_valid() && y.is_valid();
        is_usable.then(|| hypotenuse(x.residual(), y.residual()))
    }

    /// Number of samples.
    pub(crate) fn n(&self) -> u64 {
        self.n
    }

    /// Number of skipped samples.
    pub(crate) fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    /// Sum of the distances.
    pub(crate) fn distance(&self) -> &ExactSum {
        &self.distance
    }
}

/// Adds up a single column, the distances.
impl ColumnSums for PlaneSums {
    fn sums(&mut self) -> [&mut [ExactSum]; 2] {
        [std::slice::from_mut(&mut self.distance), &mut []]
    }

    fn take(&mut self, columns: &[&[f64]]) {
        let rows = columns.first().map_or(0, |column| column.len());
        self.n += u64::try_from(rows).expect("no column has 2^64 rows");
    }

    fn leave_out(&mut self) {
        self.n_invalid += 1;
    }
}

impl Merge for PlaneSums {
    fn merge(&mut self, other: &PlaneSums) {
        self.n = self.n.saturating_add(other.n);
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.distance.merge(&other.distance);
    }
}

/// Length √(x² + y²), rounded at every step, and scaled by a power of two if a square would over- or underflow.
///
/// Unlike the `hypot` of a platform, this function returns the same bits on every platform.
#[inline]
fn hypotenuse(x: f64, y: f64) -> f64 {
    /// 2⁶⁰⁰: factor that scales small numbers up.
    const UP: f64 = f64::from_bits((1023 + 600) << 52);
    /// 2⁻⁶⁰⁰: factor that scales large numbers down.
    const DOWN: f64 = f64::from_bits((1023 - 600) << 52);
    /// 2⁵¹⁰: up to this magnitude the sum of two squares is finite.
    const LARGE: f64 = f64::from_bits((1023 + 510) << 52);
    /// 2⁻⁴⁵⁰: if the greater number has this magnitude, a square that underflows is negligible.
    const SMALL: f64 = f64::from_bits((1023 - 450) << 52);
    let root = |x: f64, y: f64| (x * x + y * y).sqrt();
    let greatest = x.abs().max(y.abs());
    if greatest > LARGE {
        root(x * DOWN, y * DOWN) * UP
    } else if greatest < SMALL {
        root(x * UP, y * UP) * DOWN
    } else {
        root(x, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_of_3_4_5_keeps_its_shape_at_every_scale() {
        for power in [-1000, -600, -450, -1, 0, 300, 510, 1018] {
            let scale = 2.0_f64.powi(power);
            let found = hypotenuse(3.0 * scale, -4.0 * scale);
            assert_eq!(found.to_bits(), (5.0 * scale).to_bits(), "2^{power}");
        }
    }

    #[test]
    fn a_sample_with_one_broken_value_is_left_out() {
        let pair = |estimate| Paired {
            estimate,
            reference: 0.0,
        };
        let mut sums = PlaneSums::default();
        sums.add(pair(3.0), pair(4.0));
        sums.add(pair(3.0), pair(f64::NAN));
        assert_eq!((sums.n(), sums.n_invalid()), (1, 1));
        assert_eq!(sums.distance().to_f64().to_bits(), 5.0_f64.to_bits());
    }
}

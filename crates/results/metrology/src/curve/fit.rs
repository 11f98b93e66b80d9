//! Least-squares fit of a calibration curve.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use taceva_metrics::LEAST_CLUSTERS;

use super::squares::{Axis, Coefficients, MOST, Solution, Square, form, solve};
use super::undefined::CurveUndefined;

/// Reading y at a reference value x, each in a unit of its own.
///
/// ```
/// use taceva_metrology::curve::CurveRow;
/// assert_eq!(CurveRow::new(0.5, 0.52).of_point(3).point, Some(3));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CurveRow {
    /// Reference value.
    pub x: f64,
    /// Reading, in a unit of its own.
    pub y: f64,
    /// Contact point; rows of one point are correlated. `None` for an independent row.
    pub point: Option<u64>,
}

impl CurveRow {
    /// An independent row.
    pub const fn new(x: f64, y: f64) -> CurveRow {
        CurveRow { x, y, point: None }
    }

    /// The same row, assigned to a contact point.
    #[must_use]
    pub const fn of_point(self, point: u64) -> CurveRow {
        CurveRow {
            point: Some(point),
            ..self
        }
    }
}

/// Polynomial y(x) of order 1 to 3 by least squares, with the covariance of its coefficients.
///
/// ```
/// use taceva_metrology::curve::{CurveFit, CurveRow};
/// let rows: Vec<CurveRow> = [(0.0, 1.0), (1.0, 3.1), (2.0, 4.9), (3.0, 7.0)].map(|(x, y)| CurveRow::new(x, y)).into();
/// let line = CurveFit::of(&rows, 1)?;
/// assert!((line.coefficients()[1] - 1.98).abs() < 1e-12);
/// assert_eq!(line.freedom(), 2.0);
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
///
/// # Reference
/// Draper and Smith, Applied Regression Analysis (1998), chapters 1 to 5.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFit {
    pub(super) rows: Vec<CurveRow>,
    pub(super) axis: Axis,
    pub(super) count: usize,
    pub(super) solution: Solution,
    /// Jackknife covariance of the coefficients over points, and the number of points.
    pub(super) clustered: Option<Clustered>,
}

/// Covariance of the coefficients between contact points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Clustered {
    pub(super) covariance: Square,
    pub(super) clusters: usize,
}

impl CurveFit {
    /// Fits a polynomial of `order` 1 to 3.
    ///
    /// # Errors
    /// [`CurveUndefined`] for another order, numbers that are not finite, at most `order` + 1 rows, or too few distinct x.
    pub fn of(rows: &[CurveRow], order: usize) -> Result<CurveFit, CurveUndefined> {
        let count = order + 1;
        if order == 0 || count > MOST {
            return Err(CurveUndefined::Order(order));
        }
        let is_wrong = |row: &CurveRow| !(row.x.is_finite() && row.y.is_finite());
        if let Some(row) = rows.iter().position(is_wrong) {
            return Err(CurveUndefined::NotFinite { row: row + 1 });
        }
        // Rows are sorted, because rounded sums depend on the order of rows.
        let mut sorted = rows.to_vec();
        sorted.sort_by(|one, other| {
            let by_x = one.x.total_cmp(&other.x);
            by_x.then(one.y.total_cmp(&other.y))
        });
        let rows = sorted.as_slice();
        let (have, least) = (rows.len(), count + 1);
        if have < least {
            return Err(CurveUndefined::TooFewRows { have, least });
        }
        let x: Vec<f64> = rows.iter().map(|row| row.x).collect();
        let axis = Axis::of(&x).ok_or(CurveUndefined::EqualX)?;
        let (have, least) = (levels(rows).len(), count);
        let too_few = CurveUndefined::TooFewX { have, least };
        if have < least {
            return Err(too_few);
        }
        let all: Vec<(Coefficients, f64)> =
            rows.iter().map(|row| (axis.powers(row.x), row.y)).collect();
        let solution = solve(&all, count).ok_or(too_few)?;
        Ok(CurveFit {
            clustered: jackknife(rows, &all, count),
            rows: sorted,
            axis,
            count,
            solution,
        })
    }

    /// Order of the polynomial.
    pub fn order(&self) -> usize {
        self.count - 1
    }

    /// Degrees of freedom of the residuals: number of rows − order − 1.
    pub fn freedom(&self) -> f64 {
        (self.rows.len() - self.count) as f64
    }

    /// Standard deviation s of the residuals, in the unit of y.
    pub fn residual_deviation(&self) -> f64 {
        (self.solution.squares / self.freedom()).sqrt()
    }

    /// Least and greatest reference value.
    pub fn range(&self) -> [f64; 2] {
        let x = || self.rows.iter().map(|row| row.x);
        [
            x().fold(f64::INFINITY, f64::min),
            x().fold(f64::NEG_INFINITY, f64::max),
        ]
    }

    /// Value y(x) of the curve.
    pub fn value(&self, x: f64) -> f64 {
        let powers = self.axis.powers(x);
        let terms = powers.iter().zip(&self.solution.coefficients);
        terms.map(|(power, of)| power * of).sum()
    }

    /// Coefficients of x⁰, x¹, … in this order.
    pub fn coefficients(&self) -> Vec<f64> {
        let all = self.powers_of_x();
        let own = self.solution.coefficients;
        let coefficient =
            |power: &Coefficients| power.iter().zip(&own).map(|(part, of)| part * of).sum();
        all.iter().take(self.count).map(coefficient).collect()
    }

    /// Covariance of the coefficients, row by row: residual variance times (XᵀX)⁻¹, with powers of x as columns of X.
    pub fn covariance(&self) -> Vec<Vec<f64>> {
        let all = self.powers_of_x();
        let square = self.residual_deviation().powi(2);
        let cell = |i: usize, j: usize| square * form(&all[i], &self.solution.inverse, &all[j]);
        let row = |i: usize| (0..self.count).map(|j| cell(i, j)).collect();
        (0..self.count).map(row).collect()
    }

    /// Converts coefficients of the scaled polynomial to coefficients of x⁰ to x³, by the binomial theorem. Row i gives that of xⁱ.
    pub(super) fn powers_of_x(&self) -> Square {
        const CHOOSE: Square = [
            [1.0, 1.0, 1.0, 1.0],
            [0.0, 1.0, 2.0, 3.0],
            [0.0, 0.0, 1.0, 3.0],
            [0.0, 0.0, 0.0, 1.0],
        ];
        let mut all = CHOOSE;
        for (i, row) in (0..).zip(&mut all) {
            for (k, cell) in (0..).zip(row) {
                if k >= i {
                    *cell *= (-self.axis.centre).powi(k - i) / self.axis.scale.powi(k);
                }
            }
        }
        all
    }
}

/// Rows grouped by their x, ascending.
pub(super) fn levels(rows: &[CurveRow]) -> Vec<Vec<CurveRow>> {
    let mut sorted = rows.to_vec();
    sorted.sort_by(|one, other| one.x.total_cmp(&other.x));
    let levels = sorted.chunk_by(|one, other| one.x >= other.x);
    levels.map(<[CurveRow]>::to_vec).collect()
}

/// Jackknife covariance (G − 1)/G Σ (β₋ₚ − β̄)(β₋ₚ − β̄)ᵀ of the coefficients β₋ₚ without point p of G points.
///
/// `None` if a row has no point, no point has two rows, there are too few points, or a fit is underdetermined.
///
/// # Reference
/// Efron and Tibshirani, An Introduction to the Bootstrap (1993), chapter 11.
fn jackknife(rows: &[CurveRow], all: &[(Coefficients, f64)], count: usize) -> Option<Clustered> {
    let points: BTreeSet<u64> = rows.iter().map(|row| row.point).collect::<Option<_>>()?;
    let clusters = points.len();
    if clusters == rows.len() || clusters < LEAST_CLUSTERS {
        return None;
    }
    let without = |point: &u64| {
        let both = rows.iter().zip(all);
        let kept = both.filter(|(row, _)| row.point != Some(*point));
        let kept: Vec<(Coefficients, f64)> = kept.map(|(_, row)| *row).collect();
        (kept.len() > count)
            .then(|| solve(&kept, count))
            .flatten()
            .map(|solution| solution.coefficients)
    };
    let mut fits: Vec<Coefficients> = points.iter().map(without).collect::<Option<_>>()?;
    // Fits are sorted, because rounded sums depend on the order of fits, and points have no inherent order.
    fits.sort_by(|one, other| {
        let pairs = one.iter().zip(other);
        let mut orders = pairs.map(|(one, other)| one.total_cmp(other));
        orders
            .find(|order| order.is_ne())
            .unwrap_or(Ordering::Equal)
    });
    let g = clusters as f64;
    let mean = |at: usize| fits.iter().map(|fit| fit[at]).sum::<f64>() / g;
    let means: [f64; MOST] = std::array::from_fn(mean);
    let cell = |i: usize, j: usize| {
        let products = fits
            .iter()
            .map(|fit| (fit[i] - means[i]) * (fit[j] - means[j]));
        products.sum::<f64>() * (g - 1.0) / g
    };
    Some(Clustered {
        covariance: std::array::from_fn(|i| std::array::from_fn(|j| cell(i, j))),
        clusters,
    })
}

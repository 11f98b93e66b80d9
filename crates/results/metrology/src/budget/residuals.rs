//! One-way components of residuals: variance between and within contact points.

use std::collections::BTreeMap;

use taceva_core::is_scorable;
use taceva_metrics::ExactSum;

use super::evidence::{Evidence, Figure};
use super::freedom::Freedom;

/// Residuals d = truth − prediction by contact point, as exact sums. States of parts merge, in any order.
///
/// ```
/// use taceva_metrology::budget::Residuals;
/// let mut residuals = Residuals::default();
/// for (point, truth) in [("a", 1.01), ("a", 1.03), ("b", 0.95), ("b", 0.97)] {
///     residuals.add(point, truth, 1.0);
/// }
/// let found = residuals.components()?;
/// assert!((found.within.u - 0.02 / 2_f64.sqrt()).abs() < 1e-12);
/// assert!((found.bias.value + 0.01).abs() < 1e-12);
/// # Ok::<(), taceva_metrology::budget::TooFewRows>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Residuals {
    points: BTreeMap<String, Point>,
    /// Rows whose truth or prediction is no number.
    n_invalid: u64,
}

/// Exact sums of the residuals of one point.
#[derive(Clone, Debug, Default, PartialEq)]
struct Point {
    n: u64,
    sum: ExactSum,
    squares: ExactSum,
}

/// Components of the one-way random model by contact point, in the unit of the channel.
///
/// ```
/// # use taceva_metrology::budget::{Evidence, Residuals};
/// let mut residuals = Residuals::default();
/// for (point, truth) in [("a", 1.0), ("a", 1.2), ("b", 1.1), ("b", 1.1)] {
///     residuals.add(point, truth, 1.0);
/// }
/// let found = residuals.components()?;
/// // Chance alone explains the difference of the points.
/// assert!(found.is_negative && found.between.u == 0.0);
/// assert!(found.feed(Evidence::default()).figure("error.within").is_some());
/// # Ok::<(), taceva_metrology::budget::TooFewRows>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Components {
    /// Mean square between points, with `points − 1` degrees of freedom.
    pub mean_square_between: f64,
    /// Mean square within points, with `n − points` degrees of freedom.
    pub mean_square_within: f64,
    /// Effective number of rows of a point, (n − Σnₚ²/n)/(G − 1).
    pub n0: f64,
    /// Standard deviation between points, √max(0, (MS_b − MS_w)/n0); freedom by Satterthwaite.
    pub between: Figure,
    /// Standard deviation within points, √MS_w.
    pub within: Figure,
    /// Mean residual, a correction of the prediction, with u² = s_b² Σ nₚ²/n² + MS_w/n, which is MS_b/n for points of one size.
    pub bias: Figure,
    /// Root of the mean square of residuals; freedom by Satterthwaite, since the rows of a point depend on each other.
    pub rmse: Figure,
    /// True if MS_b is below MS_w, so that `between` counts as 0.
    pub is_negative: bool,
}

/// Rows that give no components: fewer than two points, or no point with two rows.
///
/// This type gets no further field.
///
/// ```
/// use taceva_metrology::budget::Residuals;
/// let error = Residuals::default().components().unwrap_err();
/// assert_eq!(error.to_string(), "0 rows of 0 points, expected two points or more, and two rows of a point");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{n} rows of {points} points, expected two points or more, and two rows of a point")]
pub struct TooFewRows {
    /// Number of rows.
    pub n: u64,
    /// Number of points.
    pub points: u64,
}

impl Residuals {
    /// Adds a row of a contact point; truth and prediction in the unit of the channel.
    pub fn add(&mut self, point: &str, truth: f64, prediction: f64) {
        let residual = truth - prediction;
        if !(is_scorable(truth) && is_scorable(prediction)) {
            self.n_invalid += 1;
            return;
        }
        let of = match self.points.get_mut(point) {
            Some(of) => of,
            None => self.points.entry(point.to_owned()).or_default(),
        };
        of.n += 1;
        of.sum.add(residual);
        of.squares.add_product(residual, residual);
    }

    /// Adds the rows of another part.
    pub fn merge(&mut self, other: &Residuals) {
        self.n_invalid += other.n_invalid;
        for (name, point) in &other.points {
            let of = self.points.entry(name.clone()).or_default();
            of.n += point.n;
            of.sum.merge(&point.sum);
            of.squares.merge(&point.squares);
        }
    }

    /// Number of rows without a valid truth and prediction, which are left out.
    pub fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    /// The components.
    ///
    /// # Errors
    /// [`TooFewRows`] if there is one point, or no point with two rows.
    ///
    /// # Reference
    /// Searle, Casella and McCulloch, Variance Components (1992), 3.6; Satterthwaite, Biometrics Bulletin 2 (1946).
    pub fn components(&self) -> Result<Components, TooFewRows> {
        let points = self.points.len() as u64;
        let count: u64 = self.points.values().map(|point| point.n).sum();
        if points < 2 || count <= points {
            return Err(TooFewRows { n: count, points });
        }
        let (n, g) = (count as f64, points as f64);
        let (mut sum, mut squares, mut sizes) = (ExactSum::default(), ExactSum::default(), 0.0);
        for point in self.points.values() {
            sum.merge(&point.sum);
            squares.merge(&point.squares);
            sizes += (point.n as f64).powi(2);
        }
        let mean = sum.to_f64() / n;
        let (mut within, mut between) = (ExactSum::default(), ExactSum::default());
        for point in self.points.values() {
            point.add_within(&mut within);
            // nₚ (d̄ₚ − d̄)² by the exact sum of nₚ residuals less the mean.
            let off = above(&point.sum, point.n, mean);
            between.add(off * off / point.n as f64);
        }
        let off = above(&sum, count, mean);
        between.add(-(off * off) / n);
        let freedoms = [g - 1.0, n - g];
        let mean_squares = [
            between.to_f64().max(0.0) / freedoms[0],
            within.to_f64().max(0.0) / freedoms[1],
        ];
        let n0 = (n - sizes / n) / freedoms[0];
        let difference = mean_squares[0] - mean_squares[1];
        let terms = mean_squares.iter().zip(freedoms);
        let scale: f64 = terms
            .map(|(square, freedom)| square * square / freedom)
            .sum();
        let of_between = match difference > 0.0 {
            true => Freedom::Finite(difference * difference / scale),
            false => Freedom::Finite(freedoms[0]),
        };
        // Variance of one residual: MS_b / n0 + (1 − 1 / n0) MS_w, or MS_w alone.
        let share = if difference > 0.0 { 1.0 / n0 } else { 0.0 };
        let parts = [share * mean_squares[0], (1.0 - share) * mean_squares[1]];
        let scale: f64 = parts
            .iter()
            .zip(freedoms)
            .map(|(part, freedom)| part * part / freedom)
            .sum();
        let total: f64 = parts.iter().sum();
        let of_rmse = match scale > 0.0 {
            true => Freedom::Finite(total * total / scale),
            false => Freedom::Finite(freedoms[1]),
        };
        let figure = |u: f64, freedom: Freedom| Figure::new(u, freedom).of_rows(count, points);
        let [square_between, square_within] = mean_squares;
        let between_variance = difference.max(0.0) / n0;
        let of_mean = between_variance * sizes / (n * n) + square_within / n;
        let mut spread = figure(between_variance.sqrt(), of_between);
        if difference < 0.0 {
            spread.note = Some("the component came out negative and counts as 0".to_owned());
        }
        Ok(Components {
            mean_square_between: square_between,
            mean_square_within: square_within,
            n0,
            between: spread,
            within: figure(square_within.sqrt(), Freedom::Finite(freedoms[1])),
            bias: figure(of_mean.sqrt(), Freedom::Finite(freedoms[0])).of_estimate(mean),
            rmse: figure((squares.to_f64() / n).sqrt(), of_rmse),
            is_negative: difference < 0.0,
        })
    }
}

impl Point {
    /// Adds Σ (d − d̄ₚ)² to `total`: Σd² − 2 m Σd + n m² exactly for the rounded mean m, less what m is off.
    fn add_within(&self, total: &mut ExactSum) {
        let n = self.n as f64;
        let high = self.sum.to_f64();
        let mean = high / n;
        let mut rest = self.sum.clone();
        rest.add(-high);
        total.merge(&self.squares);
        total.add_product(-2.0 * mean, high);
        total.add_product(-2.0 * mean, rest.to_f64());
        // m² in two parts, so that its products with n are exact.
        let square = mean * mean;
        total.add_product(n, square);
        total.add_product(n, mean.mul_add(mean, -square));
        let off = above(&self.sum, self.n, mean);
        total.add(-(off * off) / n);
    }
}

/// Sum of n numbers less n times `mean`, rounded once.
fn above(sum: &ExactSum, n: u64, mean: f64) -> f64 {
    let mut off = sum.clone();
    off.add_product(-(n as f64), mean);
    off.to_f64()
}

impl Components {
    /// Adds the components to the figures that sources name: `error`, `error.between`, `error.within` and `bias`.
    #[must_use]
    pub fn feed(&self, evidence: Evidence) -> Evidence {
        evidence
            .with("error", self.rmse.clone())
            .with("error.between", self.between.clone())
            .with("error.within", self.within.clone())
            .with("bias", self.bias.clone())
    }
}

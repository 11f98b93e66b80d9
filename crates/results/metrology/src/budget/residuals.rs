//! One-way variance components of residuals: variance between and within contact points.

use std::collections::BTreeMap;

use taceva_core::is_scorable;
use taceva_metrics::{ExactSum, Moments, OneWaySums};

use super::evidence::{Evidence, Figure};
use super::freedom::Freedom;

/// Exact sums of the residuals d = truth − prediction, by contact point. Partial sums merge in any order.
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
    points: BTreeMap<String, Moments>,
    /// Least and greatest true value; `None` for no row.
    truths: Option<[f64; 2]>,
    /// Number of rows whose truth or prediction is not finite.
    n_invalid: u64,
}

/// Variance components of the one-way random model with contact points as groups, in the unit of the channel.
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
    /// Mean square between points. Its degrees of freedom are the number of points less one.
    pub mean_square_between: f64,
    /// Mean square within points. Its degrees of freedom are the number of rows less the number of points.
    pub mean_square_within: f64,
    /// Effective number of rows of a point, (n − Σnₚ²/n)/(G − 1), for n rows in G points with nₚ rows each.
    pub n0: f64,
    /// Standard deviation between points, √max(0, (mean square between − mean square within)/`n0`), with degrees of freedom by Satterthwaite.
    pub between: Figure,
    /// Standard deviation within points: the square root of the mean square within points.
    pub within: Figure,
    /// Mean residual, a correction of the prediction. Its uncertainty includes the variance between and within points.
    pub bias: Figure,
    /// Root mean square residual, with degrees of freedom by Satterthwaite because rows of a point are correlated.
    pub rmse: Figure,
    /// True if the mean square between points is below the mean square within points, so that `between` is set to 0.
    pub is_negative: bool,
}

/// Reason for missing components: fewer than two points, or no point with two rows.
///
/// This type gets no further field.
///
/// ```
/// use taceva_metrology::budget::Residuals;
/// let error = Residuals::default().components().unwrap_err();
/// assert_eq!(error.to_string(), "0 rows of 0 points, expected at least two points, and a point with two rows");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{n} rows of {points} points, expected at least two points, and a point with two rows")]
pub struct TooFewRows {
    /// Number of rows.
    pub n: u64,
    /// Number of points.
    pub points: u64,
}

impl Residuals {
    /// Adds one row, with truth and prediction in the unit of the channel.
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
        of.add(residual);
        self.widen([truth, truth]);
    }

    /// Adds the rows of `other`.
    pub fn merge(&mut self, other: &Residuals) {
        self.n_invalid += other.n_invalid;
        for (name, point) in &other.points {
            self.points.entry(name.clone()).or_default().merge(point);
        }
        if let Some(truths) = other.truths {
            self.widen(truths);
        }
    }

    fn widen(&mut self, [low, high]: [f64; 2]) {
        let [least, most] = self.truths.unwrap_or([low, high]);
        self.truths = Some([least.min(low), most.max(high)]);
    }

    /// Number of rows skipped for a truth or prediction that is not finite.
    pub fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    /// Computes the variance components.
    ///
    /// # Errors
    /// [`TooFewRows`] if there are fewer than two points, or no point with two rows.
    ///
    /// # Reference
    /// Searle, Casella and McCulloch, Variance Components (1992), 3.6; Satterthwaite, Biometrics Bulletin 2 (1946).
    pub fn components(&self) -> Result<Components, TooFewRows> {
        let points = self.points.len() as u64;
        let count: u64 = self.points.values().map(|point| point.n).sum();
        let few = TooFewRows { n: count, points };
        let (mut sums, mut squares) = (OneWaySums::default(), ExactSum::default());
        for point in self.points.values() {
            sums.add(point);
            squares.merge(&point.squares);
        }
        let model = sums.model().ok_or(few)?;
        let of_points = Freedom::Finite(points as f64 - 1.0);
        let of_rows = Freedom::Finite(model.within_freedom);
        let figure = |u: f64, freedom: Freedom| Figure {
            labels: self.truths,
            ..Figure::new(u, freedom).of_rows(count, points)
        };
        let is_negative = model.between_variance_raw < 0.0;
        let of_between = model.between_freedom.map_or(of_points, Freedom::Finite);
        let mut between = figure(model.between, of_between);
        if is_negative {
            between.note =
                Some("the variance between points was negative and is set to 0".to_owned());
        }
        Ok(Components {
            mean_square_between: model.mean_square_between,
            mean_square_within: model.mean_square_within,
            n0: model.group_size,
            between,
            within: figure(model.within, of_rows),
            bias: figure(model.mean_uncertainty, of_points).of_estimate(model.mean),
            rmse: figure(
                (squares.to_f64() / count as f64).sqrt(),
                model.total_freedom.map_or(of_rows, Freedom::Finite),
            ),
            is_negative,
        })
    }
}

impl Components {
    /// Adds the components to `evidence` as the figures `error`, `error.between`, `error.within` and `bias`.
    #[must_use]
    pub fn feed(&self, evidence: Evidence) -> Evidence {
        evidence
            .with("error", self.rmse.clone())
            .with("error.between", self.between.clone())
            .with("error.within", self.within.clone())
            .with("bias", self.bias.clone())
    }
}

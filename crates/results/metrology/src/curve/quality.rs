//! Lack-of-fit test of a curve.

use super::fit::{CurveFit, levels};
use taceva_metrics::distributions::f_ratio;

/// F test of lack of fit: deviations of level means, compared with the scatter of readings at equal x.
///
/// This type gets no further field.
///
/// ```
/// use taceva_metrology::curve::{CurveFit, CurveRow};
/// let rows: Vec<CurveRow> = [(0.0, 0.0), (0.0, 0.1), (1.0, 5.0), (1.0, 5.1), (2.0, 2.0), (2.0, 2.1)].map(|(x, y)| CurveRow::new(x, y)).into();
/// let test = CurveFit::of(&rows, 1)?.lack_of_fit();
/// assert!(test.is_some_and(|test| test.p < 0.001));
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
///
/// # Reference
/// Draper and Smith, Applied Regression Analysis (1998), 2.1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LackOfFit {
    /// Ratio of mean squares.
    pub f: f64,
    /// p value: probability of a greater ratio for a correct curve.
    pub p: f64,
    /// Degrees of freedom of numerator and denominator.
    pub freedoms: [f64; 2],
    /// Standard deviation of readings at equal x, in the unit of y.
    pub pure_deviation: f64,
}

impl CurveFit {
    /// Computes the test. `None` without repeats at equal x, with too few levels for the coefficients, or if all repeats are equal.
    pub fn lack_of_fit(&self) -> Option<LackOfFit> {
        let levels = levels(&self.rows);
        let freedoms = [
            levels.len().checked_sub(self.count)?,
            self.rows.len() - levels.len(),
        ];
        if freedoms.contains(&0) {
            return None;
        }
        let freedoms = freedoms.map(|freedom| freedom as f64);
        let (mut pure, mut off) = (0.0, 0.0);
        for level in &levels {
            let n = level.len() as f64;
            let mean = level.iter().map(|row| row.y).sum::<f64>() / n;
            pure += level.iter().map(|row| (row.y - mean).powi(2)).sum::<f64>();
            off += level
                .first()
                .map_or(0.0, |row| n * (mean - self.value(row.x)).powi(2));
        }
        let pure = pure / freedoms[1];
        let f = off / freedoms[0] / pure;
        (pure > 0.0).then(|| LackOfFit {
            f,
            p: f_ratio::above(f, freedoms[0], freedoms[1]),
            freedoms,
            pure_deviation: pure.sqrt(),
        })
    }
}

//! Variation of a score over trainings of one model.

use super::repeats::Repeats;

/// Standard error of a score that is caused by the random numbers of a training. Several trainings on the same samples give the estimate.
///
/// ```
/// use taceva_metrics::TrainingSpread;
/// let one = TrainingSpread::of_one(&[1.0, 2.0, 3.0]).ok_or("three trainings")?;
/// // Deviations −1, 0 and 1: √(2 / 2), with two degrees of freedom.
/// assert_eq!((one.standard_error, one.freedom), (1.0, 2.0));
/// let mean = TrainingSpread::of_mean(&[1.0, 2.0, 3.0]).ok_or("three trainings")?;
/// assert_eq!(mean.standard_error, 1.0 / 3_f64.sqrt());
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TrainingSpread {
    /// Mean of the scores.
    pub mean: f64,
    /// Standard error, in the unit of the score.
    pub standard_error: f64,
    /// Degrees of freedom: trainings minus one.
    pub freedom: f64,
}

impl TrainingSpread {
    /// Standard error of the score of one training; `None` for fewer than two `values`, or if a value is not finite.
    ///
    /// ```
    /// assert_eq!(taceva_metrics::TrainingSpread::of_one(&[0.5]), None);
    /// ```
    pub fn of_one(values: &[f64]) -> Option<TrainingSpread> {
        let repeats = Repeats::of(values)?;
        Some(TrainingSpread {
            mean: repeats.mean,
            standard_error: repeats.standard_deviation,
            freedom: values.len() as f64 - 1.0,
        })
    }

    /// Standard error of the mean score of all trainings; `None` if [`of_one`](TrainingSpread::of_one) returns `None`.
    ///
    /// ```
    /// let spread = taceva_metrics::TrainingSpread::of_mean(&[0.0, 2.0]).ok_or("two")?;
    /// assert!((spread.standard_error - 1.0).abs() < 1e-15);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of_mean(values: &[f64]) -> Option<TrainingSpread> {
        let one = TrainingSpread::of_one(values)?;
        Some(TrainingSpread {
            standard_error: one.standard_error / (values.len() as f64).sqrt(),
            ..one
        })
    }

    /// True if the scores of the trainings differ.
    pub fn varies(&self) -> bool {
        self.standard_error > 0.0
    }
}

//! Scores from one kernel.

/// Scores from one kernel; `None` for a result that is not finite. A plain value, which gets no further fields.
///
/// ```
/// use taceva_metrics::{Paired, bench::Kernel};
/// let scores = Kernel::Naive.run(Paired { estimate: &[0.5, 0.5], reference: &[0.25, 0.5] });
/// assert_eq!(scores.mae, Some(0.125));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scores {
    /// Mean absolute error, in the unit of the columns.
    pub mae: Option<f64>,
    /// Coefficient of determination.
    pub r2: Option<f64>,
    /// Symmetric mean absolute percentage error, as a fraction.
    pub smape: Option<f64>,
}

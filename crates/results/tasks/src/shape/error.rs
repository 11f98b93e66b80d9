//! Errors of clouds and thresholds.

/// Reason why a cloud of points or a threshold is refused.
///
/// ```
/// use taceva_tasks::shape::{ShapeState, ShapeTask};
/// let refused = ShapeState::new(ShapeTask::default()).push("cup", 4, &[[0.0; 3]], &[]);
/// let text = "row 4: the predicted cloud has no point, expected at least one";
/// assert_eq!(refused.map_err(|error| error.to_string()), Err(text.to_owned()));
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A cloud without a point.
    #[error("row {row}: the {cloud} cloud has no point, expected at least one")]
    NoPoint {
        /// Row of the sample.
        row: u64,
        /// Name of the cloud: `true`, `predicted`.
        cloud: &'static str,
    },
    /// A coordinate that is not finite, or too great.
    #[error(
        "row {row}: point {point} of the {cloud} cloud has the coordinate {value}, expected a number from -1e9 to 1e9 mm"
    )]
    Coordinate {
        /// Row of the sample.
        row: u64,
        /// Name of the cloud: `true`, `predicted`.
        cloud: &'static str,
        /// Number of the point, from 1.
        point: usize,
        /// Coordinate found, mm.
        value: f64,
    },
    /// A threshold of distances that is not above 0.
    #[error("tau is {0} mm, expected a number above 0 and up to 1e9 mm")]
    Tau(f64),
}

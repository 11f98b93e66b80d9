//! Errors of poses and thresholds.

/// Reason why a pose, a point or a threshold is refused.
///
/// ```
/// use taceva_tasks::pose::Rotation;
/// let refused = Rotation::of_quaternion(7, [0.0, 0.0, 0.0, 0.9]).map_err(|error| error.to_string());
/// let text = "row 7: the quaternion has norm 0.9, expected 1 within 1e-6; divide it by its norm in the file";
/// assert_eq!(refused, Err(text.to_owned()));
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PoseError {
    /// A coordinate is not finite, or too great.
    #[error("row {row}: {axis} is {value}, expected a number from -1e9 to 1e9 mm")]
    Coordinate {
        /// Row of the pose.
        row: u64,
        /// Name of the coordinate: `x`, `y`, `z`.
        axis: &'static str,
        /// Coordinate found, mm.
        value: f64,
    },
    /// The norm of a quaternion is not 1.
    #[error(
        "row {row}: the quaternion has norm {norm}, expected 1 within 1e-6; divide it by its norm in the file"
    )]
    Norm {
        /// Row of the pose.
        row: u64,
        /// Norm found.
        norm: f64,
    },
    /// A matrix with a negative determinant, which mirrors.
    #[error("row {row}: the rotation matrix has determinant -1, expected 1; it mirrors the object")]
    Mirror {
        /// Row of the pose.
        row: u64,
    },
    /// A matrix whose columns are not unit vectors at right angles.
    #[error(
        "row {row}: the columns of the rotation matrix deviate by {deviation} from unit vectors at right angles, expected at most 1e-6"
    )]
    NoRotation {
        /// Row of the pose.
        row: u64,
        /// Greatest deviation of a scalar product of two columns from 0 or 1.
        deviation: f64,
    },
    /// A threshold that is not a decimal.
    #[error(
        "threshold `{text}`, expected a decimal above 0 and below 1000000 with at most 6 places, such as 0.5"
    )]
    Threshold {
        /// Text found.
        text: String,
    },
    /// Thresholds that do not ascend.
    #[error("threshold `{text}` after a greater or equal threshold, expected ascending thresholds")]
    Order {
        /// Text of the threshold that is not greater than the threshold before.
        text: String,
    },
    /// No threshold for an axis.
    #[error("no threshold of the {axis}, expected at least one decimal")]
    NoThreshold {
        /// Name of the axes: `translation`, `rotation`.
        axis: &'static str,
    },
}

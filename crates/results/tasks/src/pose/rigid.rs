//! Pose: a rotation and a translation.

use super::error::PoseError;
use super::rotation::Rotation;
use crate::vector::{GREATEST_MM, length, minus};

/// Pose of a body, or a change of pose: points are rotated, then shifted.
///
/// ```
/// use taceva_tasks::pose::{Pose, Rotation};
/// let pose = Pose::new(1, [1.0, 0.0, 0.0], Rotation::of_quaternion(1, [0.0, 0.0, 1.0, 0.0])?)?;
/// assert_eq!(pose.apply([2.0, 0.0, 5.0]), [-1.0, 0.0, 5.0]);
/// # Ok::<(), taceva_tasks::pose::PoseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    translation_mm: [f64; 3],
    rotation: Rotation,
}

impl Pose {
    /// Identity: no rotation and no translation.
    pub const ZERO: Pose = Pose {
        translation_mm: [0.0; 3],
        rotation: Rotation::IDENTITY,
    };

    /// Pose of row `row` with the translation x, y, z in mm.
    ///
    /// # Errors
    /// [`PoseError::Coordinate`] unless each coordinate is from −1e9 to 1e9 mm.
    pub fn new(row: u64, translation_mm: [f64; 3], rotation: Rotation) -> Result<Pose, PoseError> {
        check_point(row, translation_mm)?;
        Ok(Pose {
            translation_mm,
            rotation,
        })
    }

    /// Translation x, y, z in mm.
    #[must_use]
    pub fn translation_mm(&self) -> [f64; 3] {
        self.translation_mm
    }

    /// The rotation.
    #[must_use]
    pub fn rotation(&self) -> Rotation {
        self.rotation
    }

    /// Distance between the positions of both poses, mm.
    #[must_use]
    pub fn distance_mm(&self, other: &Pose) -> f64 {
        length(minus(other.translation_mm, self.translation_mm))
    }

    /// Moves `point`, in mm.
    #[must_use]
    pub fn apply(&self, point: [f64; 3]) -> [f64; 3] {
        let turned = self.rotation.turn(point);
        std::array::from_fn(|axis| turned[axis] + self.translation_mm[axis])
    }
}

/// Checks the coordinates of a point of row `row`, mm.
pub(super) fn check_point(row: u64, point: [f64; 3]) -> Result<(), PoseError> {
    for (axis, value) in ["x", "y", "z"].into_iter().zip(point) {
        // NaN is in no range.
        if !(-GREATEST_MM..=GREATEST_MM).contains(&value) {
            return Err(PoseError::Coordinate { row, axis, value });
        }
    }
    Ok(())
}

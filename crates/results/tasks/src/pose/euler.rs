//! Differences of Euler angles, as public programs average them.

use serde::{Deserialize, Serialize};

use super::rigid::Pose;
use super::rotation::Rotation;
use crate::error::TaskError;
use crate::totals::Totals;
use crate::vector::{degrees, length};

/// Number of axes.
const AXES: usize = 3;
/// Whole turn, in degrees.
const TURN: f64 = 360.0;

/// Sums of the absolute differences of the angles about the fixed axes x, y and z, in this order of rotations.
///
/// 179 and −179 degrees differ by 358 as numbers, and by 2 the shorter way. Both sums are kept.
///
/// ```
/// use taceva_tasks::pose::{EulerErrors, Pose, Rotation};
/// // Half turns about z, less and more one degree.
/// let about_z = |degrees: f64| {
///     let half = degrees.to_radians() / 2.0;
///     Pose::new(1, [0.0; 3], Rotation::of_quaternion(1, [0.0, 0.0, half.sin(), half.cos()])?)
/// };
/// let mut errors = EulerErrors::default();
/// errors.push(&about_z(179.0)?, &about_z(-179.0)?);
/// let [as_numbers, shorter] = errors.mean_degrees(2).ok_or("one pose")?;
/// assert!((as_numbers - 358.0).abs() < 1e-9 && (shorter - 2.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Totals<6, 1>")]
pub struct EulerErrors(Totals<6, 1>);

impl TryFrom<Totals<6, 1>> for EulerErrors {
    type Error = TaskError;
    fn try_from(totals: Totals<6, 1>) -> Result<EulerErrors, TaskError> {
        TaskError::checked_count(0, totals.counts[0])?;
        Ok(EulerErrors(totals))
    }
}

impl EulerErrors {
    /// Adds a true and a predicted pose.
    pub fn push(&mut self, truth: &Pose, prediction: &Pose) {
        let [truth, prediction] = [truth, prediction].map(|pose| angles(pose.rotation()));
        for (axis, (truth, prediction)) in truth.into_iter().zip(prediction).enumerate() {
            let apart = (truth - prediction).abs();
            self.0.sums[axis].add(apart);
            self.0.sums[AXES + axis].add(apart.min(TURN - apart));
        }
        self.0.counts[0] += 1;
    }

    /// Adds the poses of `other`.
    #[must_use]
    pub fn merge(mut self, other: &EulerErrors) -> EulerErrors {
        self.0.merge(&other.0);
        self
    }

    /// Mean differences about axis `axis`, 0 to 2, in degrees; `None` without a pose.
    ///
    /// The first difference is that of the plain numbers, the second goes the shorter way round.
    ///
    /// # Panics
    /// If `axis` is above 2.
    #[must_use]
    pub fn mean_degrees(&self, axis: usize) -> Option<[f64; 2]> {
        assert!(axis < AXES, "axis {axis}");
        let as_numbers = self.0.mean(axis, 0).ok()?;
        let shorter = self.0.mean(AXES + axis, 0).ok()?;
        Some([as_numbers, shorter])
    }
}

/// Angles about the fixed axes x, then y, then z, in degrees.
fn angles(rotation: Rotation) -> [f64; AXES] {
    let [x, y, z, w] = rotation.quaternion();
    let forward = [w * w + x * x - y * y - z * z, 2.0 * (w * z + x * y), 0.0];
    [
        degrees(2.0 * (w * x + y * z), w * w - x * x - y * y + z * z),
        degrees(2.0 * (w * y - x * z), length(forward)),
        rotation.yaw_degrees(),
    ]
}

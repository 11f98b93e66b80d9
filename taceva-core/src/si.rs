//! Conversion to and from SI units, which the plugin interface uses for poses and speeds.

use crate::driver::{Speed, SpeedError};
use crate::geometry::{Point, Pose, Rotation, nearest};
use crate::quantity::{Degree, Millimetre};

/// Millimetres in a metre.
const PER_METRE: f64 = 1e3;
/// Greatest accepted deviation of a quaternion's norm from 1. Components in single precision meet this limit.
const LENGTH_TOLERANCE: f64 = 1e-6;

/// A pose: its position in metres, and its rotation as a unit quaternion. A plain value, which gets no further fields.
///
/// ```
/// use taceva_core::{Millimetre, Point, Pose, SiPose};
/// let pose = Pose { position: Point { z: Millimetre(0.5), ..Point::default() }, ..Pose::default() };
/// let si = SiPose::from(pose);
/// assert_eq!((si.position_m, si.quaternion), ([0.0, 0.0, 0.0005], [1.0, 0.0, 0.0, 0.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SiPose {
    /// Coordinates x, y and z, m.
    pub position_m: [f64; 3],
    /// Unit quaternion: real part first, then x, y and z.
    pub quaternion: [f64; 4],
}

impl From<Pose> for SiPose {
    fn from(pose: Pose) -> SiPose {
        let Pose { position, rotation } = pose;
        let half = |angle: Degree| (angle.0.to_radians() / 2.0).sin_cos();
        let ((sx, cx), (sy, cy), (sz, cz)) = (half(rotation.x), half(rotation.y), half(rotation.z));
        SiPose {
            position_m: [position.x, position.y, position.z].map(|length| length.0 / PER_METRE),
            quaternion: [
                cx * cy * cz + sx * sy * sz,
                sx * cy * cz - cx * sy * sz,
                cx * sy * cz + sx * cy * sz,
                cx * cy * sz - sx * sy * cz,
            ],
        }
    }
}

impl SiPose {
    /// Pose, rounded to the grid of [`Pose::on_grid`]; `None` if a number is not finite or the norm of the quaternion is not 1.
    ///
    /// Conversion of a pose on the grid to SI units and back keeps the pose. The angles about x and z must be above −180° and at most 180°, and
    /// the angle about y between −90° and 90°, both excluded.
    ///
    /// ```
    /// use taceva_core::{Degree, Millimetre, Pose, SiPose};
    /// let mut pose = Pose::default();
    /// (pose.position.z, pose.rotation.x) = (Millimetre(0.35), Degree(-12.5));
    /// assert_eq!(SiPose::from(pose).to_pose(), Some(pose));
    /// ```
    pub fn to_pose(self) -> Option<Pose> {
        let [w, x, y, z] = self.quaternion;
        let length = (w * w + x * x + y * y + z * z).sqrt();
        let is_place = self.position_m.iter().all(|length| length.is_finite());
        let is_turn = (length - 1.0).abs() <= LENGTH_TOLERANCE;
        if !(is_place && is_turn) {
            return None;
        }
        let [px, py, pz] = self.position_m.map(|length| Millimetre(length * PER_METRE));
        // The first column and the last row of the matrix of the rotation.
        let (xx, yx, zx) = (
            w * w + x * x - y * y - z * z,
            2.0 * (x * y + w * z),
            2.0 * (x * z - w * y),
        );
        let (zy, zz) = (2.0 * (y * z + w * x), w * w - x * x - y * y + z * z);
        let angle = |sine: f64, cosine: f64| {
            let angle = sine.atan2(cosine).to_degrees();
            // Half a turn in either direction is the same rotation; only rounding decides between them.
            let is_half_turn = angle < -180.0 + 1e-10;
            Degree(if is_half_turn { 180.0 } else { angle })
        };
        let pose = Pose {
            position: Point {
                x: px,
                y: py,
                z: pz,
            },
            rotation: Rotation {
                x: angle(zy, zz),
                y: angle(-zx, xx.hypot(yx)),
                z: angle(yx, xx),
            },
        };
        Some(pose.on_grid())
    }
}

impl Speed {
    /// Speed in m/s.
    pub fn metres_per_second(self) -> f64 {
        self.mm_per_s() / PER_METRE
    }

    /// Speed from m/s, rounded to whole nm/s.
    ///
    /// # Errors
    /// The errors of [`try_new`](Speed::try_new).
    pub fn from_metres_per_second(metres: f64) -> Result<Speed, SpeedError> {
        Speed::try_new(nearest(metres * PER_METRE, 1e6))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_on_the_grid_comes_back_by_bits() {
        for step in 0..5_000_i32 {
            let number = f64::from(step * 7_919 % 10_007 - 5_003);
            let pose = Pose {
                position: Point {
                    x: Millimetre(number * 0.001_237),
                    y: Millimetre(-number * 0.1),
                    z: Millimetre(number / 3.0),
                },
                rotation: Rotation {
                    x: Degree(number * 0.035_9),
                    y: Degree(number * 0.017_9),
                    z: Degree(-number * 0.035_7),
                },
            }
            .on_grid();
            assert_eq!(SiPose::from(pose).to_pose(), Some(pose), "step {step}");
        }
    }

    #[test]
    fn half_turns_come_back_one_way_whichever_way_they_went() {
        for x in [-180.0, 180.0] {
            for z in [-180.0, 0.0, 180.0] {
                let mut pose = Pose::default();
                (pose.rotation.x, pose.rotation.y, pose.rotation.z) =
                    (Degree(x), Degree(30.0), Degree(z));
                let back = SiPose::from(pose).to_pose().expect("a pose").rotation;
                assert_eq!((back.x, back.z), (Degree(180.0), Degree(z.abs())));
            }
        }
    }

    #[test]
    fn rotations_are_applied_about_x_then_y_then_z() {
        let mut quarter = Pose::default();
        (quarter.rotation.x, quarter.rotation.z) = (Degree(90.0), Degree(90.0));
        let [w, x, y, z] = SiPose::from(quarter).quaternion;
        // By hand: q_z q_x = (1 + k)(1 + i) / 2 = (1 + i + j + k) / 2.
        for part in [w, x, y, z] {
            assert!((part - 0.5).abs() < 1e-15, "{w} {x} {y} {z}");
        }
    }

    #[test]
    fn what_is_no_pose_is_none() {
        let good = SiPose::from(Pose::default());
        for quaternion in [[0.0; 4], [2.0, 0.0, 0.0, 0.0], [f64::NAN; 4]] {
            assert_eq!(SiPose { quaternion, ..good }.to_pose(), None);
        }
        let position_m = [0.0, f64::INFINITY, 0.0];
        assert_eq!(SiPose { position_m, ..good }.to_pose(), None);
    }

    #[test]
    fn speeds_come_back_by_bits() {
        for step in 1..10_000_u32 {
            let speed = Speed::try_new(f64::from(step) / 1e3).expect("above 0");
            let back = Speed::from_metres_per_second(speed.metres_per_second());
            assert_eq!(back, Ok(speed));
        }
        assert!(Speed::from_metres_per_second(f64::NAN).is_err());
    }
}

//! Pose of the sensor in the base frame of the robot.

use taceva_core::{Degree, Millimetre, Point, Pose, Rotation};

/// Base frame of the robot relative to the sensor: x along the sensor's x, y opposite to its y, and z up, out of the gel.
///
/// ```
/// use taceva_wire::Base;
/// assert_eq!(Base::to_base([0.0, 0.0, -20.0]), [300.0, 0.0, 271.3]);
/// assert_eq!(Base::to_sensor([301.0, 2.0, 251.3]), [1.0, -2.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Base;

impl Base {
    /// Centre of the untouched gel in the base frame, mm.
    pub const ORIGIN_MM: [f64; 3] = [300.0, 0.0, 251.3];
    /// Base axis of each sensor axis, as in a rig file.
    pub const AXES: [&'static str; 3] = ["x", "-y", "-z"];
    const SIGNS: [f64; 3] = [1.0, -1.0, -1.0];

    /// Converts a place from the sensor's frame to the base frame, mm.
    pub fn to_base(sensor_mm: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| Base::ORIGIN_MM[axis] + Base::SIGNS[axis] * sensor_mm[axis])
    }

    /// Converts a place from the base frame to the sensor's frame, mm.
    pub fn to_sensor(base_mm: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| Base::SIGNS[axis] * (base_mm[axis] - Base::ORIGIN_MM[axis]))
    }

    /// Converts a force from the sensor's frame to the frame of a transducer, or back. The axes of the transducer are those of the base frame.
    pub fn turn(force_n: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| Base::SIGNS[axis] * force_n[axis])
    }

    /// Converts the pose of a tool to the sensor's frame. The tool is at `base_mm` in the base frame, mm, rotated by `yaw_rad` about the base's z
    /// axis.
    pub(crate) fn pose(base_mm: [f64; 3], yaw_rad: f64) -> Pose {
        let [x, y, z] = Base::to_sensor(base_mm).map(Millimetre);
        Pose {
            position: Point { x, y, z },
            rotation: Rotation {
                z: Degree(-yaw_rad.to_degrees()),
                ..Rotation::default()
            },
        }
    }
}

//! Where the sensor stands on the table of the robot.

use taceva_core::{Degree, Millimetre, Point, Pose, Rotation};

/// The base frame of the robot, seen from the sensor: x along the sensor's x, y against its y, and z up, out of the gel.
///
/// ```
/// use taceva_wire::Base;
/// assert_eq!(Base::to_base([0.0, 0.0, -20.0]), [300.0, 0.0, 271.3]);
/// assert_eq!(Base::to_sensor([301.0, 2.0, 251.3]), [1.0, -2.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Base;

impl Base {
    /// Where the middle of the untouched gel is, in mm.
    pub const ORIGIN_MM: [f64; 3] = [300.0, 0.0, 251.3];
    /// Which axis of the base each axis of the sensor is, as a rig file says it.
    pub const AXES: [&'static str; 3] = ["x", "-y", "-z"];
    const SIGNS: [f64; 3] = [1.0, -1.0, -1.0];

    /// A place in the sensor's frame, in the base frame; both in mm.
    pub fn to_base(sensor_mm: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| Base::ORIGIN_MM[axis] + Base::SIGNS[axis] * sensor_mm[axis])
    }

    /// A place in the base frame, in the sensor's frame; both in mm.
    pub fn to_sensor(base_mm: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| Base::SIGNS[axis] * (base_mm[axis] - Base::ORIGIN_MM[axis]))
    }

    /// A force in the sensor's frame, in that of a transducer that is mounted as the base frame lies; and the other way round.
    pub fn turn(force_n: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| Base::SIGNS[axis] * force_n[axis])
    }

    /// The pose in the sensor's frame of a tool at `base_mm`, turned by `yaw_rad` about the base's z.
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

//! Where the tool is, seen from the sensor.

use crate::quantity::{Degree, Millimetre};

/// A place in the sensor's frame: x and y along the gel, z into it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Along the gel.
    pub x: Millimetre,
    /// Along the gel, a quarter turn from x.
    pub y: Millimetre,
    /// Into the gel: the indentation depth.
    pub z: Millimetre,
}

/// A turn about the sensor's axes, applied x, then y, then z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rotation {
    /// About x.
    pub x: Degree,
    /// About y.
    pub y: Degree,
    /// About z.
    pub z: Degree,
}

impl Rotation {
    /// The unit quaternion of the same turn: real part, then x, y, z.
    ///
    /// ```
    /// use taceva_core::{Degree, Rotation};
    /// let quarter = Rotation { z: Degree(90.0), ..Rotation::default() };
    /// let half = 0.5_f64.sqrt();
    /// let [w, x, y, z] = quarter.to_quaternion();
    /// assert!((w - half).abs() < 1e-15 && (z - half).abs() < 1e-15 && x == 0.0 && y == 0.0);
    /// ```
    pub fn to_quaternion(self) -> [f64; 4] {
        let halves = [self.x, self.y, self.z].map(|angle| (angle.0 / 2.0).to_radians());
        let [(sx, cx), (sy, cy), (sz, cz)] = halves.map(f64::sin_cos);
        [
            cx * cy * cz + sx * sy * sz,
            sx * cy * cz - cx * sy * sz,
            cx * sy * cz + sx * cy * sz,
            cx * cy * sz - sx * sy * cz,
        ]
    }

    /// The turn of a quaternion (real part, then x, y, z) of any length above 0: about y from −90° to 90°, about x and z above −180°.
    ///
    /// Angles in that range come back to 10⁻⁹ degrees, except close to a quarter turn about y, where the other two are one.
    pub fn from_quaternion([w, x, y, z]: [f64; 4]) -> Rotation {
        // Rows and columns of the rotation matrix, times the square of the length.
        let along_x = w * w + x * x - y * y - z * z;
        let along_y = 2.0 * (w * z + x * y);
        let tilt = f64::hypot(along_x, along_y);
        Rotation {
            x: degrees(2.0 * (w * x + y * z), w * w - x * x - y * y + z * z),
            y: degrees(2.0 * (w * y - x * z), tilt),
            z: degrees(along_y, along_x),
        }
    }
}

/// The angle whose sine and cosine have these proportions.
fn degrees(sine: f64, cosine: f64) -> Degree {
    let angle = sine.atan2(cosine).to_degrees();
    // A half turn either way is one turn, told apart by nothing but rounding.
    let is_half_turn = angle < -180.0 + 1e-10;
    Degree(if is_half_turn { 180.0 } else { angle })
}

/// The tool in the sensor's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Where its tip is.
    pub position: Point,
    /// How it is turned.
    pub rotation: Rotation,
}

impl Pose {
    /// The nearest pose on the grid of whole nanometres and whole 10⁻⁹ degrees.
    ///
    /// Poses cross the plugin boundary in metres and quaternions; on this grid, finer than any robot, the way there and back loses nothing,
    /// so a driver that answers on it gives the same numbers however it is delivered.
    ///
    /// ```
    /// use taceva_core::{Millimetre, Pose};
    /// let mut pose = Pose::default();
    /// pose.position.x = Millimetre(0.1 + 0.2);
    /// assert_eq!(pose.on_grid().position.x, Millimetre(0.3));
    /// ```
    #[must_use]
    pub fn on_grid(self) -> Pose {
        let Pose { position, rotation } = self;
        let length = |length: Millimetre| Millimetre(nearest(length.0, 1e6));
        let angle = |angle: Degree| Degree(nearest(angle.0, 1e9));
        Pose {
            position: Point {
                x: length(position.x),
                y: length(position.y),
                z: length(position.z),
            },
            rotation: Rotation {
                x: angle(rotation.x),
                y: angle(rotation.y),
                z: angle(rotation.z),
            },
        }
    }
}

/// The nearest of the numbers of which there are `per_unit` a unit; one too large to have neighbours so close stays, as does no number.
pub(crate) fn nearest(value: f64, per_unit: f64) -> f64 {
    let steps = value * per_unit;
    if steps.abs() < 2_f64.powi(52) {
        // Adding 0 makes −0 the 0 that a metre or a quaternion would give back.
        steps.round() / per_unit + 0.0
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_on_the_grid_survive_the_way_through_metres() {
        for steps in [0, 1, -1, 300_001, 12_345_678, -40_000_000_001_i64] {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let mm = steps as f64 / 1e6;
            let there = mm / 1e3;
            assert_eq!(nearest(there * 1e3, 1e6).to_bits(), mm.to_bits());
        }
    }

    #[test]
    fn rotations_on_the_grid_survive_the_way_through_quaternions() {
        let angles = [
            0.0,
            1e-9,
            -0.3,
            17.123_456_789,
            45.0,
            -89.9,
            90.0,
            179.999_999_999,
            180.0,
        ];
        for x in angles {
            for y in angles.into_iter().filter(|y: &f64| y.abs() < 89.95) {
                for z in angles {
                    let [x, y, z] = [x, y, z].map(Degree);
                    let rotation = Rotation { x, y, z };
                    let back = Rotation::from_quaternion(rotation.to_quaternion());
                    let pose = |rotation| Pose {
                        rotation,
                        ..Pose::default()
                    };
                    assert_eq!(pose(back).on_grid(), pose(rotation).on_grid());
                }
            }
        }
    }

    #[test]
    fn the_turn_of_a_quaternion_does_not_depend_on_its_length() {
        let rotation = Rotation {
            x: Degree(10.0),
            y: Degree(-20.0),
            z: Degree(30.0),
        };
        let quaternion = rotation.to_quaternion();
        let [one, long] = [1.0, 3.0]
            .map(|length| Rotation::from_quaternion(quaternion.map(|part| part * length)));
        assert!((one.y.0 - long.y.0).abs() < 1e-12 && (one.y.0 + 20.0).abs() < 1e-12);
    }

    #[test]
    fn what_has_no_place_on_the_grid_stays_as_it_is() {
        assert!(nearest(f64::NAN, 1e6).is_nan());
        for value in [f64::INFINITY, 1e300, -1e12] {
            assert_eq!(nearest(value, 1e6).to_bits(), value.to_bits());
        }
        assert_eq!(nearest(-1e-9, 1e6).to_bits(), 0.0_f64.to_bits());
    }
}

//! Points, rotations and poses in the coordinates of the sensor.

use std::fmt;

use crate::quantity::{Degree, Millimetre};

/// A point in the coordinates of the sensor: x and y along the gel's surface, z into the gel. This struct gets no further fields: there are three
/// axes.
///
/// ```
/// use taceva_core::{Millimetre, Point};
/// let pressed = Point { z: Millimetre(0.5), ..Point::default() };
/// assert_eq!((pressed.x, pressed.z), (Millimetre(0.0), Millimetre(0.5)));
/// assert_eq!(pressed.to_string(), "(0, 0, 0.5) mm");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Coordinate along the gel's surface.
    pub x: Millimetre,
    /// Coordinate along the gel's surface, perpendicular to x.
    pub y: Millimetre,
    /// Coordinate into the gel: the indentation depth.
    pub z: Millimetre,
}

/// Rotation about the axes of the sensor: first about x, then y, then z. This struct gets no further fields: three angles determine a rotation.
///
/// ```
/// use taceva_core::{Degree, Rotation};
/// let turned = Rotation { z: Degree(90.0), ..Rotation::default() };
/// assert_eq!(turned.z, Degree(90.0));
/// assert_eq!(turned.to_string(), "(0, 0, 90) deg");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rotation {
    /// Angle about the sensor's x axis.
    pub x: Degree,
    /// Angle about the sensor's y axis.
    pub y: Degree,
    /// Angle about the sensor's z axis.
    pub z: Degree,
}

/// Pose of the robot's tool in the coordinates of the sensor. This struct gets no further fields, because position and rotation determine a pose.
///
/// ```
/// use taceva_core::{Millimetre, Point, Pose};
/// let position = Point { z: Millimetre(0.5), ..Point::default() };
/// let pose = Pose { position, ..Pose::default() };
/// assert_eq!(pose.on_grid(), pose);
/// assert_eq!(pose.to_string(), "(0, 0, 0.5) mm turned by (0, 0, 0) deg");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Position of the tool's tip.
    pub position: Point,
    /// Rotation of the tool about the axes of the sensor.
    pub rotation: Rotation,
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Point { x, y, z } = self;
        write!(f, "({}, {}, {}) mm", x.0, y.0, z.0)
    }
}

impl fmt::Display for Rotation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Rotation { x, y, z } = self;
        write!(f, "({}, {}, {}) deg", x.0, y.0, z.0)
    }
}

impl fmt::Display for Pose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} turned by {}", self.position, self.rotation)
    }
}

impl Pose {
    /// Rounds lengths to whole nanometres and angles to multiples of 10⁻⁹ degrees.
    ///
    /// Poses cross the plugin interface in metres and quaternions. This conversion returns a rounded pose unchanged, so a driver that rounds reports
    /// the same numbers built in or as a plugin. The rounding is finer than the resolution of any robot.
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

/// Multiple of 1 / `per_unit` nearest to `value`. NaN, infinity and values of at least 2⁵² / `per_unit` are returned unchanged.
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
            let mm = steps as f64 / 1e6;
            let there = mm / 1e3;
            assert_eq!(nearest(there * 1e3, 1e6).to_bits(), mm.to_bits());
        }
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

//! Workspace of a robot's tip.

use std::fmt;

use crate::geometry::Point;

/// Box of the allowed positions of a robot's tip, faces included, in the sensor's frame. This type gets no further field: two corners define a box.
///
/// ```
/// use taceva_core::{Millimetre, Point, Workspace};
/// let corner = |side: f64| Point { x: Millimetre(side), y: Millimetre(side), z: Millimetre(side) };
/// let workspace = Workspace { least: corner(-10.0), greatest: corner(10.0) };
/// assert!(workspace.contains(&corner(10.0)) && !workspace.contains(&corner(10.5)));
/// assert_eq!(workspace.to_string(), "from (-10, -10, -10) mm to (10, 10, 10) mm");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Workspace {
    /// Corner with the least coordinates.
    pub least: Point,
    /// Corner with the greatest coordinates.
    pub greatest: Point,
}

impl fmt::Display for Workspace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "from {} to {}", self.least, self.greatest)
    }
}

impl Workspace {
    /// True if `point` is in the box, faces included.
    pub fn contains(&self, point: &Point) -> bool {
        self.sides(point)
            .iter()
            .all(|(least, value, greatest)| least <= value && value <= greatest)
    }

    fn sides(&self, point: &Point) -> [(f64, f64, f64); 3] {
        [
            (self.least.x.0, point.x.0, self.greatest.x.0),
            (self.least.y.0, point.y.0, self.greatest.y.0),
            (self.least.z.0, point.z.0, self.greatest.z.0),
        ]
    }
}

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

/// The tool in the sensor's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Where its tip is.
    pub position: Point,
    /// How it is turned.
    pub rotation: Rotation,
}

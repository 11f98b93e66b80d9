//! Object that touches the gel during a picture.

use crate::contact::Contact;
use crate::specimen::{Grating, GratingPose};

/// Object that touches the gel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Stimulus {
    /// No object.
    #[default]
    Nothing,
    /// A ball, with its contact on the bench.
    Ball(Contact),
    /// A board with a grating.
    Board(Board),
}

/// A board whose grating is pressed flat into the gel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Board {
    /// Grating of the board.
    pub grating: Grating,
    /// Pose on the gel.
    pub pose: GratingPose,
    /// Pressure over the whole area of the board.
    pub pressure_mpa: f64,
    /// Depth of the board below the surface of the gel at rest, mm; for a dome, below its apex. A deeper board is nearer to the camera.
    pub depth_mm: f64,
    /// Effective modulus of the gel.
    pub young_modulus_mpa: f64,
}

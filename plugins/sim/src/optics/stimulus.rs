//! What touches the gel while the camera looks.

use crate::contact::Contact;
use crate::specimen::{Grating, GratingPose};

/// What touches the gel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Stimulus {
    /// Nothing.
    #[default]
    Nothing,
    /// A ball, in contact as the bench says.
    Ball(Contact),
    /// A board with a grating.
    Board(Board),
}

/// A board whose grating is pressed flat into the gel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Board {
    /// What it carries.
    pub grating: Grating,
    /// How it lies on the gel.
    pub pose: GratingPose,
    /// How hard it is pressed, over its whole area.
    pub pressure_mpa: f64,
    /// How far it is pressed into a dome: so much nearer it is seen.
    pub depth_mm: f64,
    /// The modulus that the gel shows.
    pub young_modulus_mpa: f64,
}

//! What touches the gel while the camera looks.

use taceva_core::{GratingKind, Nanometre};

use crate::contact::Contact;

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
///
/// Width and spacing are equal, so the period is twice the spacing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Board {
    /// Lines or dots.
    pub kind: GratingKind,
    /// Between neighbours, edge to edge.
    pub spacing: Nanometre,
    /// How the board is turned about the axis, against the clock.
    pub yaw_deg: f64,
    /// Where its middle is.
    pub centre_mm: [f64; 2],
    /// How hard it is pressed, over its whole area.
    pub pressure_mpa: f64,
    /// How far it is pressed into a dome: so much nearer it is seen.
    pub depth_mm: f64,
    /// The modulus that the gel shows.
    pub young_modulus_mpa: f64,
}

//! Specimens that the robot can carry.

use taceva_core::{GratingKind, Nanometre};
use thiserror::Error;

use crate::specimen::{Grating, GratingError, Indenter};

/// Specimen on the robot of a simulated rig.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mounted {
    /// A ball.
    Ball(Indenter),
    /// A board with a grating.
    Board(Grating),
}

impl Mounted {
    /// Creates a ball of `radius`.
    ///
    /// # Errors
    /// [`MountError::Ball`] if the bench has no such ball.
    pub fn ball(radius: Nanometre) -> Result<Mounted, MountError> {
        Indenter::from_radius(radius)
            .map(Mounted::Ball)
            .ok_or(MountError::Ball { radius })
    }

    /// Creates a board of the catalogue.
    ///
    /// # Errors
    /// [`MountError::Board`] if the catalogue has no such board.
    pub fn board(kind: GratingKind, spacing: Nanometre) -> Result<Mounted, MountError> {
        Ok(Mounted::Board(Grating::new(kind, spacing)?))
    }
}

impl Default for Mounted {
    fn default() -> Mounted {
        Mounted::Ball(Indenter::default())
    }
}

/// Reasons why a specimen was not mounted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MountError {
    /// The bench has no such ball.
    #[error("no ball of {radius} radius, expected 2, 4 or 10 mm")]
    Ball {
        /// Radius of the ball.
        radius: Nanometre,
    },
    /// The catalogue has no such board.
    #[error(transparent)]
    Board(#[from] GratingError),
    /// The tip is in the gel.
    #[error("the tip is in the gel, expected the tip in the air")]
    InContact,
}

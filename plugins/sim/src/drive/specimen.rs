//! The specimen that the robot carries.

use taceva_core::{GratingKind, Nanometre};
use thiserror::Error;

use crate::specimen::{Grating, GratingError, Indenter};

/// What the robot of a simulated rig carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mounted {
    /// A ball.
    Ball(Indenter),
    /// A board with a grating.
    Board(Grating),
}

impl Mounted {
    /// A ball of `radius`.
    ///
    /// # Errors
    /// [`MountError::Ball`] if the bench has none.
    pub fn ball(radius: Nanometre) -> Result<Mounted, MountError> {
        Indenter::from_radius(radius)
            .map(Mounted::Ball)
            .ok_or(MountError::Ball { radius })
    }

    /// A board of the catalogue.
    ///
    /// # Errors
    /// [`MountError::Board`] if the catalogue has none.
    pub fn board(kind: GratingKind, spacing: Nanometre) -> Result<Mounted, MountError> {
        Ok(Mounted::Board(Grating::new(kind, spacing)?))
    }
}

impl Default for Mounted {
    fn default() -> Mounted {
        Mounted::Ball(Indenter::default())
    }
}

/// Why a specimen was not mounted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MountError {
    /// A ball that the bench does not have.
    #[error("no ball of {radius} radius, expected 2, 4 or 10 mm")]
    Ball {
        /// Its radius.
        radius: Nanometre,
    },
    /// A board that the catalogue does not have.
    #[error(transparent)]
    Board(#[from] GratingError),
    /// The tip is in the gel.
    #[error("the tip is in the gel, expected it in the air")]
    InContact,
}

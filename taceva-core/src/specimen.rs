//! Specimens: objects that touch the gel.

use std::fmt;

use crate::grating::GratingKind;
use crate::nanometre::Nanometre;

/// Object that the robot presses into the gel. Its [`Display`](std::fmt::Display) text names it in a [`Changer`](crate::Changer) and never changes.
/// This type gets no further variant in a compatible version: labels and names of presses depend on the specimen, so readers must handle each
/// variant.
///
/// ```
/// use taceva_core::{GratingKind, Nanometre, Specimen};
/// let board = Specimen::Grating { kind: GratingKind::Line, spacing: Nanometre(500_000) };
/// assert!(board.to_string().starts_with("line grating of "));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Specimen {
    /// A sphere.
    Sphere {
        /// Radius of the sphere.
        radius: Nanometre,
    },
    /// A board with a grating.
    Grating {
        /// Kind of the grating: lines or dots.
        kind: GratingKind,
        /// Distance from one ridge or bump to the next.
        spacing: Nanometre,
    },
}

impl fmt::Display for Specimen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Specimen::Sphere { radius } => write!(f, "sphere of radius {radius}"),
            Specimen::Grating { kind, spacing } => write!(f, "{kind} grating of {spacing}"),
        }
    }
}

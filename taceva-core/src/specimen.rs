//! What touches the gel.

use std::fmt;

use crate::grating::GratingKind;
use crate::nanometre::Nanometre;

/// What the robot carries. What it displays is the name by which a [`Changer`](crate::Changer) holds it, and stays as it is. It gets no further variant in a compatible version: what touches the gel decides every label and the identity of a
/// press, so every reader must say what it makes of each.
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
        /// Its radius.
        radius: Nanometre,
    },
    /// A board with a grating.
    Grating {
        /// Its relief.
        kind: GratingKind,
        /// From one ridge or bump to the next.
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

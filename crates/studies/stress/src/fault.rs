//! Kinds of faults of pictures.

use crate::canvas::{Canvas, Realisation};

/// Random numbers of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// None: the same change in every picture.
    Fixed,
    /// Places drawn once: the same pixels in every picture.
    Drawn,
    /// Drawn for each picture.
    Each,
}

/// A fault of pictures, a pure function of picture, parameter, seed and sample name.
#[derive(Debug)]
pub struct Fault {
    /// Name of the fault, such as `defocus`.
    pub id: &'static str,
    /// Cause and appearance, in one line.
    pub title: &'static str,
    /// Meaning and unit of the parameter; 0 is not a fault.
    pub parameter: &'static str,
    /// Random numbers of the fault.
    pub scope: Scope,
    /// Parameters of severities 1 to 5 if severity is set by parameter.
    pub table: [f64; 5],
    /// Greatest parameter.
    pub most: f64,
    /// Limitation of the numbers of the fault, for readers.
    pub note: Option<&'static str>,
    pub(crate) effect: Effect,
}

/// Change that a fault makes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Effect {
    /// Changes the pixel values of the picture.
    Numbers(fn(&mut Canvas, &Realisation)),
    /// Replaces the picture by the previous one.
    Before,
}

/// Remark on faults of a gel that are drawn at the same pixels of every picture.
pub(crate) const LIES_STILL: &str = "it lies still in the picture; on a real gel it moves with the contact, so errors after a new untouched picture \
                                     are lower bounds";

//! Errors of rejected presses.

use thiserror::Error;

use crate::parameters::Outline;

/// Reason why the rig cannot execute a press.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PressError {
    /// A number is not finite.
    #[error("`{name}` of a press is {value}, expected a finite number of mm")]
    NotFinite {
        /// Name of the number.
        name: &'static str,
        /// Value found.
        value: f64,
    },
    /// The place is outside the probed surface.
    #[error("a press at x = {} mm and y = {} mm, expected a place on {outline}", place_mm[0], place_mm[1])]
    Outside {
        /// Place, in mm.
        place_mm: [f64; 2],
        /// Probed surface.
        outline: Outline,
    },
    /// The depth is out of range.
    #[error("a press {depth_mm} mm deep, expected 0 to {depth_max_mm} mm")]
    Depth {
        /// Depth, in mm.
        depth_mm: f64,
        /// Maximum depth, in mm.
        depth_max_mm: f64,
    },
    /// The shear is out of range.
    #[error("a shear of {shear_mm} mm, expected at most {shear_most_mm} mm in either direction")]
    Shear {
        /// Shear along one axis, in mm.
        shear_mm: f64,
        /// Maximum shear, in mm.
        shear_most_mm: f64,
    },
}

//! Presses that are refused.

use thiserror::Error;

use crate::parameters::Outline;

/// A press that no rig would make.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PressError {
    /// A number that is no number.
    #[error("`{name}` of a press is {value}, expected a finite number of mm")]
    NotFinite {
        /// Which number.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A place beside the probed surface.
    #[error("a press at {} × {} mm, expected a place on {outline}", place_mm[0], place_mm[1])]
    Outside {
        /// The place.
        place_mm: [f64; 2],
        /// Where presses may be.
        outline: Outline,
    },
    /// A depth that the sensor does not bear.
    #[error("a press {depth_mm} mm deep, expected 0 to {depth_max_mm} mm")]
    Depth {
        /// The depth.
        depth_mm: f64,
        /// The greatest depth.
        depth_max_mm: f64,
    },
    /// A drag beyond all measure.
    #[error("a shear of {shear_mm} mm, expected at most {shear_most_mm} mm either way")]
    Shear {
        /// The drag along one axis.
        shear_mm: f64,
        /// The greatest one.
        shear_most_mm: f64,
    },
}

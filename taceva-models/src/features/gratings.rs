//! Features of gratings: the power of a picture at each spatial frequency, whatever the direction.

mod fourier;
mod radial;

pub use radial::{FourierPlane, RadialSpectrum};

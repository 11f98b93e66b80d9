//! Features of gratings: power at each spatial frequency, independent of the grating's direction.

mod fourier;
mod radial;

pub use radial::{FourierPlane, RadialSpectrum};

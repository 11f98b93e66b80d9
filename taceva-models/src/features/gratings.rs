//! Features of gratings: how strong each fineness is in a picture, whatever the direction.

mod fourier;
mod radial;

pub use radial::{FourierPlane, RadialSpectrum};

//! Features of pictures of gratings: the power spectrum by spatial frequency. It does not depend on the direction of the grating.

mod fourier;
mod radial;

pub use radial::{FourierPlane, RadialSpectrum};

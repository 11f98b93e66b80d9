//! Telling the spacing of a grating: how strong each fineness is in a picture, whatever the direction, and what tells classes apart.

mod discriminant;
mod fourier;
mod radial;

pub use discriminant::Discriminant;
pub use radial::{FourierPlane, RadialSpectrum};

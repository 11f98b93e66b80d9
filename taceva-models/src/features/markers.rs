//! Markers of a gel: where they are to a fraction of a pixel, how far each has moved since nobody touched it, and that as features.

mod field;
mod lattice;
mod local;
mod plane;
mod spots;
mod tracker;

pub(super) use field::MarkerField;
pub use spots::{Marker, Polarity};
pub use tracker::{MarkerTracker, Tracked};

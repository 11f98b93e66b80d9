//! Markers of a gel: subpixel positions, displacements from the untouched gel, and features computed from displacements.

mod field;
mod lattice;
mod local;
mod plane;
mod spots;
mod tracker;

pub(super) use field::MarkerField;
pub use spots::{Marker, Polarity};
pub use tracker::{MarkerTracker, Tracked};

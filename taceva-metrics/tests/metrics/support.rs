//! Shared helpers: samples, evaluators and golden files.

#[cfg(feature = "bench")]
pub(crate) mod golden_pairs;
#[cfg(feature = "serde")]
pub(crate) mod golden_vectors;
#[cfg(feature = "serde")]
pub(crate) mod laws;
pub(crate) mod press;
#[cfg(feature = "serde")]
pub(crate) mod program;
pub(crate) mod rows;
pub(crate) mod simulation;

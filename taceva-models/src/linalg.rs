//! Matrices of centred features, their Gram matrix and its spectrum; equal bits for any number of threads.
//!
//! Work is cut into blocks of fixed size; each block is computed by one thread in one order, and blocks are added in
//! one order, so threads only decide when a block is computed.

mod design;
pub(crate) mod distance;
mod dot;
mod gram;
mod least_squares;
pub(crate) mod progress;
mod spectrum;
pub(crate) mod standard;

use taceva_core::{ErrorKind, ModelError};

pub(crate) use design::{Design, FeatureScale};
pub(crate) use dot::dot;
pub(crate) use gram::{feature_gram, multiply};
pub(crate) use least_squares::{Wide, least_squares};
pub(crate) use spectrum::{Spectrum, symmetric_eigen};

/// The error of an argument that nothing can be computed from.
pub(crate) fn invalid(message: impl Into<String>) -> ModelError {
    ModelError::new(ErrorKind::InvalidArgument, message)
}

//! Matrices of centred features, their Gram matrix and its spectrum, with equal bits for any number of threads.
//!
//! Work is divided into blocks of fixed size. One thread computes each block in a fixed order, and blocks are added in a fixed
//! order. Threads only affect when a block is computed.

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

/// Error for an invalid argument.
pub(crate) fn invalid(message: impl Into<String>) -> ModelError {
    ModelError::new(ErrorKind::InvalidArgument, message)
}

//! Matrices of centred features, their Gram matrix and its spectrum. Results have the same bits for any number of threads.
//!
//! Work is divided into blocks of fixed size. One thread computes each block in a fixed order, and blocks are added in a fixed order. The number of threads
//! only affects the time at which a block is computed.

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

/// Creates an error for an invalid argument.
pub(crate) fn invalid(message: impl Into<String>) -> ModelError {
    ModelError::new(ErrorKind::InvalidArgument, message)
}

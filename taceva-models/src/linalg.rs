//! Matrices of centred features, their Gram matrix and its spectrum; equal bits for any number of threads.
//!
//! Work is cut into blocks of fixed size; each block is computed by one thread in one order, and blocks are added in
//! one order, so threads only decide when a block is computed.

mod design;
mod gram;
mod spectrum;

pub(crate) use design::{Design, FeatureScale};
pub(crate) use gram::multiply;
pub(crate) use spectrum::{Spectrum, symmetric_eigen};

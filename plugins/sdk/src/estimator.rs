//! Estimators that a plugin provides.

mod kept;
mod progress;
mod table;

pub(crate) use table::table;
pub use taceva_core::{EstimatorFactory, FitRequest};

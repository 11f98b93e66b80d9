//! Estimators that a plugin provides.

mod model_bytes;
mod progress;
mod table;

pub(crate) use table::table;
pub use taceva_core::{EstimatorFactory, FitRequest};

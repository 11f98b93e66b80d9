//! Models of plugins, stored as bytes that only the plugin can read.

mod estimator;
mod regressor;

pub(crate) use self::estimator::PluginEstimator;
pub use self::regressor::PluginRegressor;

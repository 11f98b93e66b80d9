//! Models that a plugin fits. TacEva stores them as bytes, which only the plugin can read.

mod estimator;
mod regressor;

pub(crate) use self::estimator::PluginEstimator;
pub use self::regressor::PluginRegressor;

//! Models of estimators that this crate does not have: those of plugins. They are kept as their makers' bytes.

mod estimator;
mod regressor;

pub(crate) use self::estimator::PluginEstimator;
pub use self::regressor::PluginRegressor;

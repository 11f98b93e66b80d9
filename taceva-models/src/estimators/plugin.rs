//! Models of plugins, stored as opaque bytes of the plugin.

mod estimator;
mod regressor;

pub(crate) use self::estimator::PluginEstimator;
pub use self::regressor::PluginRegressor;

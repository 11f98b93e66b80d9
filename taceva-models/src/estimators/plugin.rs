//! Models of estimators that this crate does not have: those of plugins. They are kept as their makers' bytes.

mod card;
mod estimator;
mod regressor;

pub use self::card::PluginCard;
pub(crate) use self::estimator::PluginEstimator;
pub use self::regressor::PluginRegressor;
pub(crate) use self::regressor::TENSOR;

//! Decision trees, grown on histograms of binned features. Random forests average many trees, and gradient boosting sums them.

mod bins;
mod boosting;
mod forest;
mod grow;
mod histogram;
mod regressor;

pub use self::boosting::GradientBoosting;
pub use self::forest::RandomForest;
pub use self::regressor::TreeRegressor;

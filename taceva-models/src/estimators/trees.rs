//! Decision trees, each node of which compares one feature with a threshold: grown on histograms, many at once or one after the other.

mod bins;
mod boosting;
mod forest;
mod grow;
mod histogram;
mod regressor;

pub use self::boosting::GradientBoosting;
pub use self::forest::RandomForest;
pub use self::regressor::TreeRegressor;

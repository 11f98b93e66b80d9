//! Decision trees grown on histograms, combined to forests or by boosting. Each node compares one feature with a threshold.

mod bins;
mod boosting;
mod forest;
mod grow;
mod histogram;
mod regressor;

pub use self::boosting::GradientBoosting;
pub use self::forest::RandomForest;
pub use self::regressor::TreeRegressor;

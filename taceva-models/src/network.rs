//! Networks that read features as pictures: a small one of five convolutions, and residual ones.

mod card;
mod estimator;
mod preprocessing;
mod regressor;

pub use card::NetworkCard;
pub use estimator::NetworkEstimator;
pub use preprocessing::Preprocessing;
pub use regressor::NetworkRegressor;

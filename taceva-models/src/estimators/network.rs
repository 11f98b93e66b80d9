//! Networks that read features as pictures: a small one of five convolutions, and residual ones.

mod appearance;
mod card;
mod checkpoint;
mod ensemble;
mod estimator;
mod fit;
mod preprocessing;
mod regressor;
mod shortened;
mod spacing;
mod training;

pub use card::NetworkCard;
pub use checkpoint::{CheckpointError, Checkpoints, Foreign};
pub use ensemble::{EnsembleRegressor, NetworkEnsemble};
pub use estimator::NetworkEstimator;
pub use preprocessing::Preprocessing;
pub use regressor::NetworkRegressor;
pub use spacing::{SpacingNetwork, SpacingOutput};

//! Neural networks that read the features of a sample as a picture: a small network of five convolutions, and residual networks.

mod appearance;
mod calibration;
mod classes;
mod classifier;
mod ensemble;
mod estimator;
mod fit;
mod head;
mod regressor;
mod spacing;
mod training;
mod variants;

pub use classifier::NetworkClassifier;
pub use ensemble::{EnsembleRegressor, NetworkEnsemble};
pub use estimator::NetworkEstimator;
pub use regressor::NetworkRegressor;
pub use spacing::{SpacingNetwork, SpacingOutput};

/// Error message for principal components, which do not form a picture.
const NO_PICTURE: &str = "a network reads pictures, not principal components: remove `pca`";

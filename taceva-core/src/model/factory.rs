//! What makes estimators that are not built in.

use super::{Estimator, FeatureShape, ModelError, Regressor};
use crate::args::{ArgSpec, Args};
use crate::channel::Channels;
use crate::id::DriverKey;

/// An estimator that is found by its key, with settings that it declares, and whose fitted models can be kept.
pub trait EstimatorFactory: Send + Sync {
    /// The name by which people choose it: `org.example.forest/forest`.
    fn key(&self) -> &DriverKey;

    /// What it is, in one line.
    fn title(&self) -> &str;

    /// What it may be told; every one has a default or is optional.
    fn settings(&self) -> &[ArgSpec];

    /// The estimator with `settings`, not fitted yet.
    ///
    /// # Errors
    /// [`ModelError`] of kind `InvalidArgument` for settings that contradict each other.
    fn estimator(&self, settings: &Args) -> Result<Box<dyn Estimator>, ModelError>;

    /// The fitted model that was kept.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` for bytes that are none of its models; hostile ones are refused like damaged ones.
    fn load(&self, saved: &SavedModel<'_>) -> Result<Box<dyn Regressor>, ModelError>;
}

/// A fitted model as it was kept.
#[derive(Clone, Copy, Debug)]
pub struct SavedModel<'a> {
    /// What [`Regressor::to_bytes`] gave.
    pub bytes: &'a [u8],
    /// What it predicts.
    pub channels: &'a Channels,
    /// The shape of features it takes.
    pub shape: FeatureShape,
}

//! Interface of training engines.

use std::fmt;

use crate::error::NetworkError;
use crate::labels::Labels;
use crate::network::{NamedTensor, Network};

/// Computes training steps, on the CPU or on another device.
///
/// A [`Trainer`](super::Trainer) draws samples, composes batches, evaluates and stops. An engine only computes. Recipes are independent of the engine.
pub trait Engine: fmt::Debug + Send {
    /// Runs a step: the forward pass with batch moments, then the update of weights and running moments. Returns the loss before the update.
    ///
    /// # Errors
    /// [`NetworkError::LossNotFinite`] before any weight changes. [`NetworkError::WeightNotFinite`] after this step or a later one, at the latest from
    /// [`network`](Engine::network). [`NetworkError::Device`] if the device fails.
    fn step(&mut self, batch: &Batch<'_>) -> Result<f64, NetworkError>;

    /// Predicts the outputs of each picture. Normalises by running moments.
    ///
    /// # Shapes
    /// `pictures`: `[samples, height, width, channels]`. `into`: `[samples, outputs]`.
    /// # Errors
    /// Errors of [`Predictor::predict`](crate::Predictor::predict). [`NetworkError::Device`] if the device fails.
    fn predict(&mut self, pictures: &[f32], into: &mut [f64]) -> Result<(), NetworkError>;

    /// Copy of the present network.
    ///
    /// # Errors
    /// [`NetworkError::WeightNotFinite`] from an engine that checks its weights only here. [`NetworkError::Device`] if the device fails.
    fn network(&self) -> Result<Network, NetworkError>;

    /// Copy of the optimiser state.
    ///
    /// # Errors
    /// [`NetworkError::Device`] if the device fails.
    fn moments(&self) -> Result<Moments, NetworkError>;
}

/// Optimiser state of each parameter, sorted by name: one list (velocities), or two lists (mean gradients, mean squared gradients). Empty before the
/// first step.
pub type Moments = Vec<Vec<NamedTensor>>;

/// Samples and settings of one step.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// Pictures, each of shape `[height, width, channels]`.
    pub pictures: &'a [Vec<f32>],
    /// Scaled labels, or classes.
    pub labels: Labels<'a>,
    /// Index of the step, counted from 0.
    pub step: u64,
    /// Learning rate of the step.
    pub rate: f64,
}

/// State of a training, in a form that is independent of the device.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Network with its present weights.
    pub network: Network,
    /// Optimiser state.
    pub moments: Moments,
}

//! What computes the steps of a training.

use std::fmt;

use crate::error::NetworkError;
use crate::labels::Labels;
use crate::network::{NamedTensor, Network};

/// What passes pictures through a network and changes its weights: the processor of this machine, or another device.
///
/// A [`Trainer`](super::Trainer) draws samples, composes batches, evaluates and stops; an engine computes. A recipe means the same on each.
pub trait Engine: fmt::Debug + Send {
    /// Makes a step: passes a batch, normalised by its own moments, and updates weights and running moments. Gives the loss
    /// before the update.
    ///
    /// # Errors
    /// [`NetworkError::LossNotFinite`] before any weight changed; [`NetworkError::WeightNotFinite`], which an engine may also see
    /// later, at the latest when [`network`](Engine::network) is asked for; [`NetworkError::Device`].
    fn step(&mut self, batch: &Batch<'_>) -> Result<f64, NetworkError>;

    /// The outputs of each picture, normalised by running moments.
    ///
    /// # Shapes
    /// `pictures`: `[samples, height, width, channels]`; `into`: `[samples, outputs]`.
    /// # Errors
    /// As those of [`Predictor::predict`](crate::Predictor::predict); [`NetworkError::Device`].
    fn predict(&mut self, pictures: &[f32], into: &mut [f64]) -> Result<(), NetworkError>;

    /// The network as it stands.
    ///
    /// # Errors
    /// [`NetworkError::WeightNotFinite`] where an engine checks its weights no earlier; [`NetworkError::Device`].
    fn network(&self) -> Result<Network, NetworkError>;

    /// What the optimiser remembers of each parameter.
    ///
    /// # Errors
    /// [`NetworkError::Device`].
    fn moments(&self) -> Result<Moments, NetworkError>;
}

/// What an optimiser remembers of each parameter, under its name, sorted: the velocities, or the means of gradients and then those
/// of their squares. Nothing before the first step.
pub type Moments = Vec<Vec<NamedTensor>>;

/// What a step learns from, and how far it goes.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// Pictures, each `[height, width, channels]`.
    pub pictures: &'a [Vec<f32>],
    /// Scaled labels, or classes.
    pub labels: Labels<'a>,
    /// Which step, counted from 0.
    pub step: u64,
    /// The rate of the step.
    pub rate: f64,
}

/// A network in training that lies on no device.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// The network.
    pub network: Network,
    /// What the optimiser remembers.
    pub moments: Moments,
}

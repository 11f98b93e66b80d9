//! Progress and results of a training.

use serde::{Deserialize, Serialize};

use super::{Breakage, LabelScale};
use crate::network::Network;

/// Progress of a training.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrainingState {
    /// Number of completed steps.
    pub step: u64,
    /// Sum of the losses in the current epoch.
    pub loss_sum: f64,
    /// Losses of each completed epoch.
    pub epochs: Vec<Epoch>,
    /// Epoch with the lowest validation loss, counted from 0; `None` before the first such epoch.
    pub best: Option<u64>,
    /// True if the patience of the recipe stopped the training early.
    pub is_stopped: bool,
    /// Location of the first number that was not finite; `None` if all were finite.
    pub broken: Option<Breakage>,
}

/// Losses of an epoch, on scaled labels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Epoch {
    /// Mean loss of the steps of the epoch.
    pub training_loss: f64,
    /// Loss of the validation part after the epoch; `None` without a validation part.
    pub validation_loss: Option<f64>,
}

/// Result of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Index of the step, counted from 0.
    pub step: u64,
    /// Loss of the batch, before the update.
    pub loss: f64,
    /// Losses of the epoch; `None` unless this was the last step of the epoch.
    pub epoch: Option<Epoch>,
}

/// Result of a training.
#[derive(Clone, Debug)]
pub struct Trained {
    /// Network after the best epoch. Without a validation part, network after the last step.
    pub network: Network,
    /// Scale of the labels. Convert predictions by [`unscaled`](LabelScale::unscaled).
    pub scale: LabelScale,
    /// Progress and losses.
    pub state: TrainingState,
}

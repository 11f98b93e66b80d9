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
    /// Epoch with the lowest validation loss, counted from 0.
    pub best: Option<u64>,
    /// True if training stopped early, by the recipe's patience.
    pub is_stopped: bool,
    /// Position of the first number that was not finite.
    pub broken: Option<Breakage>,
}

/// Losses of an epoch, on scaled labels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Epoch {
    /// Mean loss of its steps.
    pub training_loss: f64,
    /// Loss of the validation part after the epoch. `None` without a validation part.
    pub validation_loss: Option<f64>,
}

/// Result of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Index of the step, from 0.
    pub step: u64,
    /// Loss of the batch, before the update.
    pub loss: f64,
    /// Losses of the epoch, if this was its last step.
    pub epoch: Option<Epoch>,
}

/// Result of a training.
#[derive(Clone, Debug)]
pub struct Trained {
    /// Network after the best epoch. Without a validation part: after the last step.
    pub network: Network,
    /// Scale of the labels. Predictions need [`unscaled`](LabelScale::unscaled).
    pub scale: LabelScale,
    /// Progress and losses.
    pub state: TrainingState,
}

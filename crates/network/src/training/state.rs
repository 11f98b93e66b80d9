//! How far a training has come, and its results.

use serde::{Deserialize, Serialize};

use super::{Breakage, LabelScale};
use crate::network::Network;

/// How far a training has come.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrainingState {
    /// Steps that were made.
    pub step: u64,
    /// The sum of the losses of the current epoch's steps.
    pub loss_sum: f64,
    /// The losses of each whole epoch.
    pub epochs: Vec<Epoch>,
    /// The epoch that did best on the validation part, counted from 0.
    pub best: Option<u64>,
    /// Whether it was stopped early, by the recipe's patience.
    pub is_stopped: bool,
    /// Where a number was not finite.
    pub broken: Option<Breakage>,
}

/// The losses of an epoch, of the scaled labels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Epoch {
    /// The mean loss of its steps.
    pub training_loss: f64,
    /// The loss of the validation part after it, where there is one.
    pub validation_loss: Option<f64>,
}

/// The result of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Which step, counted from 0.
    pub step: u64,
    /// The loss of its batch, before the weights were changed.
    pub loss: f64,
    /// The losses of its epoch, where it was the last step of one.
    pub epoch: Option<Epoch>,
}

/// The result of a training.
#[derive(Clone, Debug)]
pub struct Trained {
    /// The network after the best epoch; after the last one where there is no validation part to choose by.
    pub network: Network,
    /// How labels were scaled: predictions are to be scaled back by it.
    pub scale: LabelScale,
    /// How far the training came.
    pub state: TrainingState,
}

//! How far a training has come, and what it gave.

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
    /// What each whole epoch came to.
    pub epochs: Vec<Epoch>,
    /// The epoch that did best on the validation part, counted from 0.
    pub best: Option<u64>,
    /// Whether the recipe's patience came to an end.
    pub is_stopped: bool,
    /// Where a number was not finite.
    pub broken: Option<Breakage>,
}

/// What an epoch came to, in the unit of the scaled labels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Epoch {
    /// The mean loss of its steps.
    pub training_loss: f64,
    /// The loss of the validation part after it, where there is one.
    pub validation_loss: Option<f64>,
}

/// What a step came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Which step, counted from 0.
    pub step: u64,
    /// The loss of its batch, before weights followed it.
    pub loss: f64,
    /// What its epoch came to, where it was the last.
    pub epoch: Option<Epoch>,
}

/// What a training gave.
#[derive(Clone, Debug)]
pub struct Trained {
    /// The network after the best epoch; after the last one where nothing was there to choose by.
    pub network: Network,
    /// How labels were scaled: predictions are to be scaled back by it.
    pub scale: LabelScale,
    /// How far the training came.
    pub state: TrainingState,
}

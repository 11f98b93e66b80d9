//! Training settings, described as data.

use serde::{Deserialize, Serialize};

use super::{Augmentation, LabelScaling};
use crate::error::NetworkError;
use crate::labels::Labels;
use crate::loss::{Loss, cross_entropy};
use crate::optimizer::Optimizer;
use crate::schedule::Schedule;

/// Training settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recipe {
    /// Number of passes over the training samples.
    pub epochs: u64,
    /// Number of samples per step, at least 2.
    pub batch: usize,
    /// Update rule of the weights.
    pub optimizer: Optimizer,
    /// Full learning rate, which the schedule multiplies.
    pub rate: f64,
    /// Ratio of the learning rate to the full rate, for each step.
    pub schedule: Schedule,
    /// Loss function.
    pub loss: Loss,
    /// Weight of each class in cross entropy; empty for equal weights.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub class_weights: Vec<f64>,
    /// Scaling of labels. Classes are not scaled.
    pub scaling: LabelScaling,
    /// Random changes of pictures before each step.
    pub augmentation: Augmentation,
    /// Number of epochs without a lower validation loss after which the training stops; `None` to never stop early.
    pub patience: Option<u64>,
    /// Seed of all random numbers.
    pub seed: u64,
}

impl Default for Recipe {
    /// Forty epochs in batches of 32 with AdamW, a one-cycle schedule with a maximum rate of 0.003, and Huber's loss on standardised labels.
    fn default() -> Recipe {
        Recipe {
            epochs: 40,
            batch: 32,
            optimizer: Optimizer::ADAM_W,
            rate: 3e-3,
            schedule: Schedule::OneCycle { rise: 0.3 },
            loss: Loss::Huber { delta: 1.0 },
            class_weights: Vec::new(),
            scaling: LabelScaling::Standard,
            augmentation: Augmentation::default(),
            patience: None,
            seed: 1,
        }
    }
}

impl Recipe {
    /// Computes the loss of some samples with the class weights, and writes the gradient of the loss.
    ///
    /// # Shapes
    /// `outputs`, `gradient`: `[samples, width]`, with `width` outputs per sample.
    /// # Panics
    /// As [`Loss::measure`].
    pub(crate) fn measure(
        &self,
        outputs: &[f64],
        width: usize,
        truth: Labels<'_>,
        gradient: &mut Vec<f64>,
    ) -> f64 {
        match (self.loss, truth) {
            (Loss::CrossEntropy, Labels::Classes(classes)) => {
                cross_entropy(outputs, width, classes, &self.class_weights, gradient)
            }
            (loss, truth) => loss.measure(outputs, width, truth, gradient),
        }
    }

    /// Checks that there is one weight above 0 for each of `outputs` classes, or none.
    pub(super) fn check_weights(&self, outputs: usize) -> Result<(), NetworkError> {
        let weights = &self.class_weights;
        let are_positive = weights
            .iter()
            .all(|weight| weight.is_finite() && *weight > 0.0);
        if weights.is_empty() || (weights.len() == outputs && are_positive) {
            return Ok(());
        }
        Err(NetworkError::Recipe {
            name: "class_weights",
            found: format!("{weights:?}"),
            expected: "a number above 0 for each output, or none",
        })
    }

    /// Checks the range of every setting.
    ///
    /// # Errors
    /// [`NetworkError::Recipe`] with the first setting out of range.
    pub fn check(&self) -> Result<(), NetworkError> {
        let refuse = |name, found: String, expected| {
            Err(NetworkError::Recipe {
                name,
                found,
                expected,
            })
        };
        let is_share = |value: f64| (0.0..1.0).contains(&value);
        if self.epochs == 0 {
            return refuse("epochs", "0".into(), "at least 1");
        }
        if self.batch < 2 {
            // A batch of one sample has no variance for pictures of one pixel.
            return refuse("batch", self.batch.to_string(), "at least 2");
        }
        if !(self.rate.is_finite() && self.rate > 0.0) {
            return refuse("rate", self.rate.to_string(), "a number above 0");
        }
        let decay = match self.optimizer {
            Optimizer::Sgd {
                momentum,
                weight_decay,
            } => {
                if !is_share(momentum) {
                    return refuse("momentum", momentum.to_string(), "0 to below 1");
                }
                weight_decay
            }
            Optimizer::AdamW {
                betas,
                epsilon,
                weight_decay,
            } => {
                if !(is_share(betas.0) && is_share(betas.1)) {
                    return refuse(
                        "betas",
                        format!("{betas:?}"),
                        "two numbers from 0 to below 1",
                    );
                }
                if !(epsilon.is_finite() && epsilon > 0.0) {
                    return refuse("epsilon", epsilon.to_string(), "a number above 0");
                }
                weight_decay
            }
        };
        if !(decay.is_finite() && decay >= 0.0) {
            return refuse(
                "weight_decay",
                decay.to_string(),
                "a finite number, at least 0",
            );
        }
        match self.schedule {
            Schedule::OneCycle { rise } if !(rise > 0.0 && rise < 1.0) => {
                return refuse("rise", rise.to_string(), "a number between 0 and 1");
            }
            Schedule::Step { every, factor } if every == 0 || !(factor > 0.0 && factor <= 1.0) => {
                let found = format!("{factor} every {every} steps");
                return refuse(
                    "schedule",
                    found,
                    "a factor above 0 and at most 1, every 1 or more steps",
                );
            }
            _ => {}
        }
        match self.loss {
            Loss::Huber { delta } if !(delta.is_finite() && delta > 0.0) => {
                refuse("delta", delta.to_string(), "a number above 0")
            }
            _ => Ok(()),
        }
    }
}

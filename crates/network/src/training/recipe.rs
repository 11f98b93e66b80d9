//! How a network is trained, as data.

use serde::{Deserialize, Serialize};

use super::{Augmentation, LabelScaling};
use crate::error::NetworkError;
use crate::loss::Loss;
use crate::optimizer::Optimizer;
use crate::schedule::Schedule;

/// How a network is trained.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recipe {
    /// How often each sample is seen.
    pub epochs: u64,
    /// Samples of a step.
    pub batch: usize,
    /// The rule by which a step changes weights.
    pub optimizer: Optimizer,
    /// The full learning rate.
    pub rate: f64,
    /// The share of the full rate at each step.
    pub schedule: Schedule,
    /// The loss that is minimised.
    pub loss: Loss,
    /// How labels are scaled; classes are not.
    pub scaling: LabelScaling,
    /// How pictures are changed before each step.
    pub augmentation: Augmentation,
    /// Epochs without a better one on the validation part after which training stops.
    pub patience: Option<u64>,
    /// The seed of everything that is drawn at random.
    pub seed: u64,
}

impl Default for Recipe {
    /// Forty epochs in batches of 32 with AdamW, one cycle up to a rate of 0.003, and Huber's loss on standardised labels.
    fn default() -> Recipe {
        Recipe {
            epochs: 40,
            batch: 32,
            optimizer: Optimizer::ADAM_W,
            rate: 3e-3,
            schedule: Schedule::OneCycle { rise: 0.3 },
            loss: Loss::Huber { delta: 1.0 },
            scaling: LabelScaling::Standard,
            augmentation: Augmentation::default(),
            patience: None,
            seed: 1,
        }
    }
}

impl Recipe {
    /// Whether every number is in its range.
    ///
    /// # Errors
    /// [`NetworkError::Recipe`], naming the first that is not.
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
            // Moments of one picture of one pixel would have no variance.
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
            return refuse("weight_decay", decay.to_string(), "a number not below 0");
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

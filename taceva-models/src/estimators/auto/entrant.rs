//! Candidates of an automatic model choice, with their results.

use super::candidates::Candidate;
use super::excess::{Excess, mean};
use crate::training::card::AutoTrial;
use crate::training::fit::ModelEstimator;

/// A model and its results.
pub(super) struct Entrant {
    pub(super) candidate: Candidate,
    pub(super) estimator: Box<dyn ModelEstimator>,
    /// Normalised squared errors, `[folds][units]`. A unit is a group, or a run of consecutive samples.
    pub(super) losses: Vec<Vec<f64>>,
    /// Work of all trials of the model so far, in s at 10⁹ multiplications per second.
    pub(super) spent_s: f64,
    /// Fraction of the epochs in a shortened training; `None` for a complete training.
    pub(super) share: Option<f64>,
    /// Reason why the model was dropped; `None` while the model is a candidate.
    pub(super) left: Option<String>,
}

impl Entrant {
    pub(super) fn name(&self) -> &'static str {
        self.candidate.info.name
    }

    /// Mean loss over all units of the first `folds` folds.
    pub(super) fn loss(&self, folds: usize) -> f64 {
        mean(&self.losses[..folds].concat())
    }

    /// Difference between the losses of this model and of `other`: mean over all units of the first `folds` folds.
    pub(super) fn excess_over(&self, other: &Entrant, folds: usize) -> Excess {
        Excess::of(
            &self.losses[..folds].concat(),
            &other.losses[..folds].concat(),
        )
    }

    /// Record of the trials for the model card.
    pub(super) fn trial(&self) -> AutoTrial {
        AutoTrial {
            model: self.name().to_owned(),
            error: self.loss(self.losses.len()).sqrt(),
            cost_s: self.spent_s,
            folds: self.losses.len(),
            share: self.share,
            left: self.left.clone(),
        }
    }
}

//! Candidates of an automatic model choice, with their results.

use super::candidates::Candidate;
use super::excess::{Excess, mean};
use crate::training::card::AutoTrial;
use crate::training::fit::ModelEstimator;

/// A model and its results.
pub(super) struct Entrant {
    pub(super) candidate: Candidate,
    pub(super) estimator: Box<dyn ModelEstimator>,
    /// Loss of each unit (inner) of each fold (outer). A unit is a group or a run of samples.
    pub(super) losses: Vec<Vec<f64>>,
    /// Work spent on trials of the model, in seconds of the budget.
    pub(super) spent_s: f64,
    /// Completed share of the training; `None` for a complete training.
    pub(super) share: Option<f64>,
    /// Reason why the model left the race; `None` while the model is a candidate.
    pub(super) left: Option<String>,
}

impl Entrant {
    pub(super) fn name(&self) -> &'static str {
        self.candidate.info.name
    }

    /// Mean loss on the first `folds` folds.
    pub(super) fn loss(&self, folds: usize) -> f64 {
        mean(&self.losses[..folds].concat())
    }

    /// Mean difference between the losses of this model and the losses of `other` on the first `folds` folds.
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

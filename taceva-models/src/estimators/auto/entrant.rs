//! A model that is tried.

use super::candidates::Candidate;
use super::excess::{Excess, mean};
use crate::training::card::AutoTrial;
use crate::training::fit::ModelEstimator;

/// A model with what is known of it so far.
pub(super) struct Entrant {
    pub(super) candidate: Candidate,
    pub(super) estimator: Box<dyn ModelEstimator>,
    /// The losses of units, fold by fold.
    pub(super) losses: Vec<Vec<f64>>,
    /// The work that trying it has taken.
    pub(super) spent_s: f64,
    /// The share of its training that is done, where it is not all.
    pub(super) share: Option<f64>,
    /// Why it is no longer in the race.
    pub(super) left: Option<String>,
}

impl Entrant {
    pub(super) fn name(&self) -> &'static str {
        self.candidate.info.name
    }

    /// The mean loss on the first so many folds.
    pub(super) fn loss(&self, folds: usize) -> f64 {
        mean(&self.losses[..folds].concat())
    }

    /// By how much its losses exceed those of `other` on the first so many folds.
    pub(super) fn excess_over(&self, other: &Entrant, folds: usize) -> Excess {
        Excess::of(
            &self.losses[..folds].concat(),
            &other.losses[..folds].concat(),
        )
    }

    /// What the card says of it.
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

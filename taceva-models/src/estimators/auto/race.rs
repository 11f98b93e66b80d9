//! Comparison of models on the first fold. Every model whose work fits the budget is tried.

use taceva_core::{ModelError, Progress, TrainingSet};

use super::candidates::{Candidate, LOOK};
use super::entrant::Entrant;
use super::validate::Folds;
use crate::features::FeatureError;
use crate::linalg::invalid;
use crate::linalg::progress::{ReportedStage, interrupted};
use crate::training::card::{AutoCard, Untried};
use crate::training::fit::ModelEstimator;
use crate::training::info::ModelInfo;

/// Models tried regardless of the budget.
pub(super) const ALWAYS: [&str; 2] = ["baseline", "ridge"];

/// Unfitted model with default settings, or a [`FeatureError`] if the model does not support the features. Other failures are a [`ModelError`].
pub(super) type Made = Result<Result<Box<dyn ModelEstimator>, FeatureError>, ModelError>;

/// State of the comparison of models on the folds of one training part.
pub(super) struct Race<'a> {
    /// Limit on the work of all trials and the final fit, in s at 10⁹ multiplications per second.
    pub(super) budget_s: f64,
    pub(super) make: &'a dyn Fn(&ModelInfo) -> Made,
    pub(super) folds: Folds,
    /// Training part with features for networks. `training` has the features for other models.
    pub(super) pictures: TrainingSet<'a>,
    pub(super) training: TrainingSet<'a>,
    pub(super) progress: &'a dyn Progress,
    pub(super) spent_s: f64,
    pub(super) entrants: Vec<Entrant>,
    /// Results of the shortened training of the network, and of its complete training if that was needed.
    pub(super) network: Vec<Entrant>,
    pub(super) untried: Vec<Untried>,
}

impl Race<'_> {
    /// Compares `candidates`. Returns the chosen model and its record for the model card.
    pub(super) fn run(
        mut self,
        candidates: Vec<Candidate>,
    ) -> Result<(Candidate, AutoCard), ModelError> {
        let stage = ReportedStage::begin(self.progress, "models tried", candidates.len());
        for candidate in candidates {
            interrupted(self.progress)?;
            match self.unworthy(&candidate) {
                Some(reason) => self.leave(candidate, reason),
                None => self.enter(candidate)?,
            }
            stage.advance();
        }
        drop(stage);
        self.look_again()?;
        if !self.network_leads() {
            self.more_folds()?;
        }
        let taken = self.settle();
        let taken = taken.ok_or_else(|| invalid("no model could be tried"))?;
        Ok((taken, self.card(taken)))
    }

    /// Reason for skipping a candidate; `None` if the candidate is to be tried.
    fn unworthy(&self, candidate: &Candidate) -> Option<String> {
        let Candidate { info, fit_s, .. } = *candidate;
        if candidate.is_named_only() {
            return Some(format!(
                "fitting it takes {fit_s:.0} s of work: name this model to fit it"
            ));
        }
        if self.network_leads() {
            let network = self.network.last().map_or("", Entrant::name);
            return Some(format!("{network} is clearly ahead of all cheaper models"));
        }
        let needed = candidate.first_s() + fit_s;
        (!self.affords(needed) && !ALWAYS.contains(&info.name)).then(|| {
            let left = (self.budget_s - self.spent_s).max(0.0);
            format!(
                "beyond the budget: trying and fitting it takes {needed:.1} s of work, but {left:.1} s of budget_s={} are left",
                self.budget_s
            )
        })
    }

    pub(super) fn affords(&self, work_s: f64) -> bool {
        self.spent_s + work_s <= self.budget_s
    }

    fn leave(&mut self, candidate: Candidate, reason: String) {
        self.untried.push(Untried {
            model: candidate.info.name.to_owned(),
            cost_s: candidate.first_s(),
            reason,
        });
    }

    /// Tries a model on the first fold. A network trains only the fraction `LOOK` of its epochs.
    fn enter(&mut self, candidate: Candidate) -> Result<(), ModelError> {
        let estimator = match (self.make)(candidate.info)? {
            Ok(estimator) => estimator,
            Err(unsuited) => {
                self.leave(candidate, unsuited.to_string());
                return Ok(());
            }
        };
        if !candidate.is_network() {
            let entrant = self.first_fold(candidate, estimator, None)?;
            self.entrants.extend(entrant);
        } else if let Some(look) = estimator.first_look(LOOK) {
            let entrant = self.first_fold(candidate, look, Some(LOOK))?;
            self.network.extend(entrant);
        }
        Ok(())
    }

    pub(super) fn first_fold(
        &mut self,
        candidate: Candidate,
        estimator: Box<dyn ModelEstimator>,
        share: Option<f64>,
    ) -> Result<Option<Entrant>, ModelError> {
        let seen = match candidate.is_network() {
            true => &self.pictures,
            false => &self.training,
        };
        let losses = self.folds.losses(0, seen, &*estimator, self.progress)?;
        match losses {
            Ok(losses) => {
                let spent_s = share.unwrap_or(1.0) * candidate.fold_s;
                self.spent_s += spent_s;
                Ok(Some(Entrant {
                    candidate,
                    estimator,
                    losses: vec![losses],
                    spent_s,
                    share,
                    left: None,
                }))
            }
            Err(reason) => {
                self.leave(candidate, reason);
                Ok(None)
            }
        }
    }
}

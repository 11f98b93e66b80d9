//! Errors of one channel as a normal sample, and the slope of the errors over the measured magnitude.

use super::sums::Totals;
use crate::score::value::{Finished, UndefinedReason};
use crate::stats::{NormalSample, Proportional};

/// Errors of one channel.
#[derive(Clone, Copy)]
pub(crate) struct Errors<'a> {
    totals: &'a Totals,
    /// True if the caller declared the samples independent.
    are_declared_independent: bool,
    /// Tolerance factor of all clusters together; `None` to compute the factor from these errors.
    factor: Option<f64>,
}

impl<'a> Errors<'a> {
    pub(super) fn of(totals: &'a Totals, are_declared_independent: bool) -> Errors<'a> {
        Errors {
            totals,
            are_declared_independent,
            factor: None,
        }
    }

    /// The same errors with a given tolerance factor.
    pub(super) fn with_factor(self, factor: Option<f64>) -> Errors<'a> {
        Errors { factor, ..self }
    }

    /// Mean error.
    pub(crate) fn mean(&self) -> Finished {
        self.totals.errors.mean().ok_or(UndefinedReason::Empty)
    }

    /// Errors as a normal sample, with the clusters as random groups.
    ///
    /// Errors count as independent if no two belong to one cluster, if clusters are unknown, or if the caller declared so.
    pub(crate) fn sample(&self) -> Result<NormalSample, UndefinedReason> {
        let errors = &self.totals.errors;
        match errors.n {
            0 => return Err(UndefinedReason::Empty),
            1 => {
                return Err(UndefinedReason::TooFew {
                    least: super::LEAST_SAMPLES,
                });
            }
            _ => {}
        }
        if errors.scaled_spread().is_zero() {
            return Err(UndefinedReason::EqualErrors);
        }
        let sample = match self.are_independent() || self.totals.is_unnamed {
            true => NormalSample::of_independent(errors),
            false => {
                let model = self.totals.groups.model();
                NormalSample::of_clusters(&model.ok_or(UndefinedReason::OneCluster)?)
            }
        };
        sample.ok_or(UndefinedReason::Overflow)
    }

    /// True if the clusters are unknown and the caller did not declare the samples independent.
    fn are_without_clusters(&self) -> bool {
        self.totals.is_unnamed && !self.are_declared_independent
    }

    /// Tolerance factor by `factor`; `None` if these errors have no tolerance limits.
    pub(super) fn tolerance_factor(&self, factor: fn(&NormalSample) -> Option<f64>) -> Option<f64> {
        let sample = self.sample().ok().filter(|_| !self.are_without_clusters());
        sample.and_then(|sample| factor(&sample))
    }

    /// Tolerance limits: mean ± k standard deviations of the errors. `factor` computes k unless a factor was given.
    pub(crate) fn tolerance_ends(
        &self,
        factor: fn(&NormalSample) -> Option<f64>,
    ) -> Result<[f64; 2], UndefinedReason> {
        let sample = self.sample()?;
        if self.are_without_clusters() {
            return Err(UndefinedReason::NoClusters);
        }
        let factor = self.factor.or_else(|| factor(&sample));
        let factor = factor.ok_or(UndefinedReason::Overflow)?;
        let half = factor * sample.sd;
        Ok([sample.mean - half, sample.mean + half])
    }

    /// Slope of the errors over the means of truth and prediction, and its p value.
    ///
    /// The p value assumes independent errors. For clusters it is undefined here, and the jackknife computes it.
    pub(crate) fn slope(&self) -> [Finished; 2] {
        let line = self.line();
        let chance = line.and_then(|line| match self.are_independent() {
            true => Ok(line.p),
            false if self.totals.is_unnamed => Err(UndefinedReason::NoClusters),
            false => Err(UndefinedReason::NoInterval),
        });
        [line.map(|line| line.slope), chance]
    }

    /// True if no two errors belong to one cluster, or if the caller declared the samples independent.
    pub(super) fn are_independent(&self) -> bool {
        let totals = self.totals;
        let are_apart = !totals.is_unnamed && totals.groups.groups() == totals.errors.n;
        self.are_declared_independent || are_apart
    }

    fn line(&self) -> Result<Proportional, UndefinedReason> {
        let errors = &self.totals.errors;
        let few = match errors.n {
            0 => UndefinedReason::Empty,
            1 | 2 => UndefinedReason::TooFew { least: 3 },
            _ => UndefinedReason::EqualMeans,
        };
        self.totals.line.proportional(errors).ok_or(few)
    }
}

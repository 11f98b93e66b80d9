//! Probabilities of classes by cluster: their losses and their calibration.

mod calibration;
mod losses;

use serde::{Deserialize, Serialize};

use crate::clusters::ByCluster;
use crate::error::TaskError;
use crate::estimate::{Part, estimate};
use crate::names::Names;
use crate::probabilities::calibration::{BINS, expected_error};
use crate::probabilities::losses::Losses;
use crate::ranking::Ranking;
use crate::score::TaskScore;
use crate::undefined::Undefined;
use taceva_metrics::Range;

/// Probabilities of all classes by cluster.
///
/// Each number of a row must be in 0 to 1, and their sum must be 1 ± 10⁻⁶. Otherwise the scores of the state are undefined, with the reason.
///
/// ```
/// use taceva_tasks::{Probabilities, Undefined};
/// let mut slip = Probabilities::new(["no_slip", "slip"], Some("slip"))?;
/// slip.push("stroke 1", "slip", &[0.25, 0.75])?;
/// slip.push("stroke 1", "no_slip", &[0.75, 0.25])?;
/// let scores = slip.scores();
/// assert_eq!((scores[0].metric, scores[0].estimate.value), ("brier", Ok(0.0625)));
/// slip.push("stroke 2", "slip", &[0.25, 0.45])?;
/// assert_eq!(slip.scores()[0].estimate.value, Err(Undefined::NotProbabilities));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct Probabilities {
    names: Names,
    #[serde(skip_serializing)]
    n: u64,
    clusters: ByCluster<Losses>,
    ranking: Ranking,
}

/// Deserialized state, not yet validated: counts may contradict each other.
#[derive(Deserialize)]
struct Stored {
    names: Names,
    clusters: ByCluster<Losses>,
    ranking: Ranking,
}

impl TryFrom<Stored> for Probabilities {
    type Error = TaskError;
    fn try_from(stored: Stored) -> Result<Probabilities, TaskError> {
        let mut n = 0;
        for losses in stored.clusters.values() {
            losses.check(stored.names.len())?;
            n = TaskError::checked_count(n, losses.n())?;
        }
        let expected = stored.names.positive().map_or(0, |_| n);
        if stored.ranking.n() != expected {
            let ranked = stored.ranking.n();
            return Err(TaskError::damaged(format!(
                "{ranked} scores, not {expected}"
            )));
        }
        Ok(Probabilities {
            names: stored.names,
            n,
            clusters: stored.clusters,
            ranking: stored.ranking,
        })
    }
}

/// Greatest difference of the sum of probabilities from 1.
const SUM_WITHIN: f64 = 1e-6;

impl Probabilities {
    /// State without samples, for the classes `names`. Calibration and ranking use the class `positive`.
    ///
    /// # Errors
    /// [`TaskError::TooFewNames`], [`TaskError::SameName`] or [`TaskError::UnknownPositive`].
    pub fn new<N: Into<String>>(
        names: impl IntoIterator<Item = N>,
        positive: Option<&str>,
    ) -> Result<Probabilities, TaskError> {
        Ok(Probabilities {
            names: Names::new(names, positive)?,
            n: 0,
            clusters: ByCluster::default(),
            ranking: Ranking::default(),
        })
    }

    /// Adds a sample of `cluster` with a number for each class, in the order of the names.
    ///
    /// # Errors
    /// [`TaskError::UnknownClass`], [`TaskError::SomeScores`] or [`TaskError::NotFinite`]. No sample is added on an error.
    pub fn push(&mut self, cluster: &str, truth: &str, row: &[f64]) -> Result<(), TaskError> {
        let at = self.n + 1;
        let truth = self.names.position(at, "truth", truth)? as usize;
        self.names.check_scores(at, row)?;
        if let Some(positive) = self.names.positive() {
            self.ranking
                .push(cluster, row[positive], truth == positive)?;
        }
        let losses = self.clusters.entry(cluster);
        let sum: f64 = row.iter().sum();
        let are_shares = row.iter().all(|p| (0.0..=1.0).contains(p));
        match are_shares && (sum - 1.0).abs() <= SUM_WITHIN {
            true => losses.add(self.names.positive_of_two(), truth, row),
            false => losses.add_other(),
        }
        self.n += 1;
        Ok(())
    }

    /// Adds all samples of `other`.
    ///
    /// # Errors
    /// [`TaskError::OtherDefinition`] if names or the positive class differ.
    pub fn merge(mut self, other: Probabilities) -> Result<Probabilities, TaskError> {
        self.names.check_same(&other.names)?;
        self.n += other.n;
        self.ranking = self.ranking.merge(other.ranking);
        self.clusters
            .merge(other.clusters, |ours, theirs| ours.merge(&theirs));
        Ok(self)
    }

    /// Probabilities of the positive class, for `roc_auc` and `average_precision`; `None` without a positive class.
    #[must_use]
    pub fn ranking(&self) -> Option<&Ranking> {
        self.names.positive().map(|_| &self.ranking)
    }

    /// `brier` and `log_loss`, and `ece` of the positive class if there are two classes.
    #[must_use]
    pub fn scores(&self) -> Vec<TaskScore> {
        let mut all = Losses::default();
        for part in self.clusters.values() {
            all.merge(part);
        }
        let of_two = self.names.positive_of_two();
        let score = |metric,
                     definition: &str,
                     value: fn(&Losses) -> Result<f64, Undefined>,
                     of_constant| {
            let parts = self.clusters.values().map(|part| Part {
                n: part.n(),
                value: value(&all.without(part)),
            });
            let parts: Vec<Part> = parts.collect();
            // Rows that are no probabilities have no constant either.
            let value = value(&all);
            let of_constant = value.and(Ok(of_constant)).unwrap_or_default();
            let found = estimate(value, Range::Positive, &parts, of_constant);
            TaskScore::new(metric, definition, found)
        };
        let brier = match of_two {
            Some(_) => "mean square of the probability of the positive class minus 1 or 0",
            None => "mean over samples of the sum over classes of (probability - 1 or 0) squared",
        };
        let mut scores = vec![
            score("brier", brier, Losses::brier, all.brier_of_shares(of_two)),
            score(
                "log_loss",
                "mean of -ln of the probability of the true class",
                Losses::log_loss,
                all.log_loss_of_shares(),
            ),
        ];
        if of_two.is_some() {
            scores.push(self.calibration(&all));
        }
        scores
    }

    fn calibration(&self, all: &Losses) -> TaskScore {
        let (value, mut parts) = self.ranking.value_and_parts(expected_error, expected_error);
        let value = all.brier().and(value);
        for part in &mut parts {
            part.value = value.and(part.value);
        }
        let definition = format!(
            "mean over samples of the distance between mean probability and share of the positive class in {BINS} bins of equal numbers, equal probabilities in one bin"
        );
        let found = estimate(value, Range::RatioWithEnds, &parts, None);
        TaskScore::new("ece", definition, found).flagged(&self.ranking.flags())
    }
}

//! Scores of positive and negative samples by cluster, and measures of their ranking.

mod key;
mod levels;
mod sorted_keys;
mod stored;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::clusters::ByCluster;
use crate::error::TaskError;
use crate::estimate::{Part, estimate, share};
use crate::evidence::{CurvePoint, curve_of};
use crate::ranking::key::ScoreKey;
pub(crate) use crate::ranking::levels::{Level, Sides};
use crate::ranking::levels::{average_precision, average_precision_of_rest, roc_auc};
use crate::ranking::sorted_keys::SortedKeys;
use crate::ranking::stored::Stored;
use crate::score::{ScoreFlag, TaskScore};
use crate::undefined::Undefined;

/// Scores of positive and negative samples by cluster. A score is any finite number, greater for the positive class.
///
/// The state counts samples by distinct score. Above 65,536 distinct scores, all scores are rounded to multiples of 2⁻¹⁶, half to even, and flagged.
/// The result depends only on the samples, not on order and merges.
///
/// ```
/// use taceva_tasks::Ranking;
/// let mut slip = Ranking::default();
/// slip.push_rows("stroke 1", &[0.1, 0.4, 0.35, 0.8], &[false, false, true, true])?;
/// let scores = slip.scores();
/// assert_eq!((scores[0].metric, scores[0].estimate.value), ("roc_auc", Ok(0.75)));
/// assert_eq!((scores[1].metric, scores[1].estimate.value), ("average_precision", Ok(5.0 / 6.0)));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(into = "Stored", try_from = "Stored")]
pub struct Ranking {
    n: u64,
    is_on_grid: bool,
    all: Counts,
    clusters: ByCluster<Counts>,
}

/// Function that computes a measure from the counts of each score, in ascending order of scores.
type Value = fn(&[Level]) -> Result<f64, Undefined>;

/// Number of positive and negative samples of each score.
type Counts = BTreeMap<ScoreKey, Sides>;

/// Maximum number of distinct scores that are not rounded.
const MOST_SCORES: usize = 65_536;

fn add(counts: &mut Counts, key: ScoreKey, sides: Sides) {
    let found = counts.entry(key).or_default();
    found.positive += sides.positive;
    found.negative += sides.negative;
}

impl Ranking {
    /// Number of samples.
    #[must_use]
    pub fn n(&self) -> u64 {
        self.n
    }

    /// Adds a sample of `cluster`.
    ///
    /// # Errors
    /// [`TaskError::NotFinite`] for a score that is NaN or infinite. No sample is added on an error.
    pub fn push(&mut self, cluster: &str, score: f64, is_positive: bool) -> Result<(), TaskError> {
        self.push_rows(cluster, &[score], &[is_positive])
    }

    /// Adds the samples of `cluster`. One call for many samples sorts only once.
    ///
    /// # Errors
    /// [`TaskError::OtherLength`], or [`TaskError::NotFinite`] for a score that is NaN or infinite. No sample is added on an error.
    pub fn push_rows(
        &mut self,
        cluster: &str,
        scores: &[f64],
        is_positive: &[bool],
    ) -> Result<(), TaskError> {
        if scores.len() != is_positive.len() {
            return Err(TaskError::OtherLength {
                column: "the score",
                have: scores.len(),
                expected: is_positive.len(),
            });
        }
        if scores.is_empty() {
            return Ok(());
        }
        let mut keys = SortedKeys::of(scores, is_positive, self.n + 1)?;
        if keys.levels().nth(MOST_SCORES).is_some() {
            self.round_to_grid();
        }
        if self.is_on_grid {
            keys.round_to_grid();
        }
        let counts = self.clusters.entry(cluster);
        for (key, sides) in keys.levels() {
            add(counts, key, sides);
            add(&mut self.all, key, sides);
        }
        self.n += keys.n();
        self.round_if_many();
        Ok(())
    }

    /// Merges the samples of both states.
    #[must_use]
    pub fn merge(mut self, mut other: Ranking) -> Ranking {
        if self.is_on_grid {
            other.round_to_grid();
        } else if other.is_on_grid {
            self.round_to_grid();
        }
        self.n += other.n;
        for (key, sides) in other.all {
            add(&mut self.all, key, sides);
        }
        self.clusters.merge(other.clusters, |ours, theirs| {
            for (key, sides) in theirs {
                add(ours, key, sides);
            }
        });
        self.round_if_many();
        self
    }

    fn round_if_many(&mut self) {
        if !self.is_on_grid && self.all.len() > MOST_SCORES {
            self.round_to_grid();
        }
    }

    fn round_to_grid(&mut self) {
        if self.is_on_grid {
            return;
        }
        self.is_on_grid = true;
        for counts in self.clusters.values_mut().chain([&mut self.all]) {
            let mut rounded = Counts::new();
            for (key, sides) in std::mem::take(counts) {
                add(&mut rounded, key.on_grid(), sides);
            }
            *counts = rounded;
        }
    }

    /// `roc_auc` and `average_precision`.
    #[must_use]
    pub fn scores(&self) -> Vec<TaskScore> {
        let sides = Sides::of(&self.levels());
        let flags = self.flags();
        let score = |metric, definition: &str, [value, of_rest]: [Value; 2], of_constant| {
            let (value, parts) = self.value_and_parts(value, of_rest);
            let found = estimate(value, share(value), &parts, of_constant);
            TaskScore::new(metric, definition, found).flagged(&flags)
        };
        let auc_words = "share of pairs of a positive and a negative sample in which the positive one has the greater score, equal scores counted half";
        let precision_words = "sum over the different scores, greatest first, of the precision down to each times the recall that it adds";
        vec![
            score("roc_auc", auc_words, [roc_auc, roc_auc], Some(0.5)),
            score(
                "average_precision",
                precision_words,
                [average_precision, average_precision_of_rest],
                sides.prevalence(),
            ),
        ]
    }

    /// Curve of precision and recall, one point for each different score, the greatest first; empty without a positive sample.
    #[must_use]
    pub fn curve(&self) -> Vec<CurvePoint> {
        let levels = self.levels();
        match Sides::of(&levels).positive {
            0 => Vec::new(),
            positives => {
                let levels = levels.iter().rev();
                curve_of(
                    levels.map(|level| [level.positive, level.negative]),
                    positives,
                )
            }
        }
    }

    /// Share of positive samples; `None` without samples.
    #[must_use]
    pub fn prevalence(&self) -> Option<f64> {
        Sides::of(&self.levels()).prevalence()
    }

    /// Properties of the scores that limit the results.
    pub(crate) fn flags(&self) -> Vec<ScoreFlag> {
        let mut flags = Vec::new();
        if self.all.len() == 1 {
            flags.push(ScoreFlag::AllScoresEqual);
        }
        if self.is_on_grid {
            flags.push(ScoreFlag::ScoresOnGrid);
        }
        let unit = ScoreKey::of(0.0)..=ScoreKey::of(1.0);
        if self.n > 0 && self.all.range(unit).next().is_none() {
            flags.push(ScoreFlag::OutsideUnit);
        }
        flags
    }

    /// Applies `value` to all samples, and for each cluster `of_rest` to the samples of all other clusters.
    ///
    /// Each cluster is subtracted from a single list of levels and added again, to save memory.
    pub(crate) fn value_and_parts(
        &self,
        value: Value,
        of_rest: Value,
    ) -> (Result<f64, Undefined>, Vec<Part>) {
        let keys: Vec<ScoreKey> = self.all.keys().copied().collect();
        let mut levels = self.levels();
        let of_all = value(&levels);
        let parts = self.clusters.values().map(|counts| {
            let at = |key: &ScoreKey| keys.partition_point(|known| known < key);
            let mut n = 0;
            for (key, sides) in counts {
                let level = &mut levels[at(key)];
                level.positive -= sides.positive;
                level.negative -= sides.negative;
                n += sides.n();
            }
            let value = of_rest(&levels);
            for (key, sides) in counts {
                let level = &mut levels[at(key)];
                level.positive += sides.positive;
                level.negative += sides.negative;
            }
            Part { n, value }
        });
        let parts = parts.collect();
        (of_all, parts)
    }

    /// Counts of each distinct score, in ascending order of scores.
    fn levels(&self) -> Vec<Level> {
        let levels = self.all.iter();
        levels
            .map(|(key, sides)| Level::of(key.score(), *sides))
            .collect()
    }
}

//! Scores over the seeds of a training.

use serde::{Deserialize, Serialize};
use taceva_core::Unit;

/// Scores of one model fitted with several seeds, on the same presses, divided alike.
///
/// Their spread is that of the training. Intervals by contact point state another: that of scores over other presses.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OverSeeds {
    /// The seeds, in order; the scores of the report are those of the first.
    pub seeds: Vec<u64>,
    /// The effect of a seed, in words.
    pub decides: String,
    /// The scores that are formed from predictions.
    pub scores: Vec<SeedScore>,
}

/// One score over the seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedScore {
    /// The metric: `r2`.
    pub metric: String,
    /// The channel or plane.
    pub channel: String,
    /// The unit of every number.
    pub unit: Unit,
    /// The value with each seed; `None` where the score has no value.
    pub values: Vec<Option<f64>>,
    /// The mean of the values.
    pub mean: f64,
    /// Their standard deviation.
    pub standard_deviation: f64,
    /// The 95 % interval of the mean over all seeds.
    pub interval: [f64; 2],
}

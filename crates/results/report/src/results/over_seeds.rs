//! Scores over the seeds of the training, as they are read back.

use taceva_core::Unit;

/// The scores of a model with each of several seeds of its training.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OverSeeds {
    /// The seeds; the scores of the study are those of the first.
    pub seeds: Vec<u64>,
    /// What a seed decides, in words.
    pub decides: String,
    /// The scores that are formed from predictions.
    pub scores: Vec<SeedScore>,
}

/// One score over the seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct SeedScore {
    /// The metric: `r2`.
    pub metric: String,
    /// The channel or plane.
    pub channel: String,
    /// The unit of every number.
    pub unit: Unit,
    /// The value with each seed, in `unit`; `None` where the score has no value.
    pub values: Vec<Option<f64>>,
    /// The mean of the values.
    pub mean: f64,
    /// Their standard deviation.
    pub standard_deviation: f64,
    /// The 95 % confidence interval of the mean over seeds.
    pub interval: [f64; 2],
}

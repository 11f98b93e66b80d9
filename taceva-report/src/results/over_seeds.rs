//! Scores over the seeds of the training, as they are read back.

use taceva_core::Unit;

/// What the scores of a model become with other seeds of its training.
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
    /// The value with each seed; none where there is none.
    pub values: Vec<Option<f64>>,
    /// The mean of them.
    pub mean: f64,
    /// Their standard deviation.
    pub standard_deviation: f64,
    /// Where the mean over ever more seeds lies, at 95 %.
    pub interval: [f64; 2],
}

//! Scores over several training seeds.

use serde::{Deserialize, Serialize};
use taceva_core::Unit;

/// Scores of one model fitted with several seeds on the same presses and split.
///
/// The spread of the scores comes from the training. In contrast, intervals by contact point show the spread between presses. Comparisons add both
/// spreads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OverSeeds {
    /// Training seeds. The scores of the report itself belong to the first seed.
    pub seeds: Vec<u64>,
    /// Steps of the training that depend on the seed, in words.
    pub decides: String,
    /// Values over the seeds, one entry per score that uses predictions.
    pub scores: Vec<SeedScore>,
}

/// Values of one score over all seeds, with their mean and spread.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedScore {
    /// Name of the metric, or of the variant on which verdicts rest: `r2`, `repeatability.pooled`.
    pub metric: String,
    /// Channel or plane.
    pub channel: String,
    /// Unit of the values, the mean, the standard deviation and the interval.
    pub unit: Unit,
    /// Value for each seed, in the order of the seeds; `None` for an absent value.
    pub values: Vec<Option<f64>>,
    /// Mean of the values over the seeds.
    pub mean: f64,
    /// Standard deviation of the values over the seeds.
    pub standard_deviation: f64,
    /// Ends of the 95 % confidence interval of the mean over seeds.
    pub interval: [f64; 2],
}

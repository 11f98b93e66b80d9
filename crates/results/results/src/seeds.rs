//! Scores over several training seeds.

use serde::{Deserialize, Serialize};
use taceva_core::Unit;

/// Scores of one model fitted with several seeds on the same presses and split.
///
/// The spread of the scores comes from the training. Intervals by contact point show the spread over other presses. Comparisons add both spreads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OverSeeds {
    /// Seeds in order. The report's scores belong to the first seed.
    pub seeds: Vec<u64>,
    /// Parts of the training that the seed determines, in words.
    pub decides: String,
    /// Scores that use predictions.
    pub scores: Vec<SeedScore>,
}

/// One score over the seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedScore {
    /// Metric, or the variant that decides its verdicts: `r2`, `repeatability.pooled`.
    pub metric: String,
    /// Channel or plane.
    pub channel: String,
    /// Unit of all numbers.
    pub unit: Unit,
    /// Value with each seed; `None` for an absent value.
    pub values: Vec<Option<f64>>,
    /// Mean of the values.
    pub mean: f64,
    /// Standard deviation of the values.
    pub standard_deviation: f64,
    /// Interval of 95 % of the mean over seeds.
    pub interval: [f64; 2],
}

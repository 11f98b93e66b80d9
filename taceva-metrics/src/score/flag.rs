//! Warnings about a score.

use std::fmt;

/// Circumstance that weakens the evidence of a score.
///
/// ```
/// use taceva_metrics::Flag;
/// assert_eq!(Flag::OneBin.to_string(), "one bin");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Flag {
    /// Only one bin has enough samples, so the score cannot vary between bins.
    OneBin,
    /// The stimulus is too small. A lighting scene changed the light by less than 5 %, or labels vary less over the samples than predictions vary
    /// within a press.
    LowStimulus,
    /// The error in a lighting scene is smaller than in the reference scene. The score penalises this change like a larger error.
    ImprovedError,
    /// The truths of some channels are collinear, so their effects on a prediction cannot be separated.
    CollinearTruths,
    /// The training labels are unknown, so skill compares the model with the mean of the evaluated true values.
    MeanOfTruth,
    /// The score does not vary between clusters, so the interval has no width. The value may still be uncertain.
    EqualClusters,
}

impl Flag {
    /// Every flag.
    pub const ALL: [Flag; 6] = [
        Flag::OneBin,
        Flag::LowStimulus,
        Flag::ImprovedError,
        Flag::CollinearTruths,
        Flag::MeanOfTruth,
        Flag::EqualClusters,
    ];
}

impl fmt::Display for Flag {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Flag::OneBin => "one bin",
            Flag::LowStimulus => "low stimulus",
            Flag::ImprovedError => "improved error",
            Flag::CollinearTruths => "collinear truths",
            Flag::MeanOfTruth => "constant is the mean of truth",
            Flag::EqualClusters => "equal clusters",
        })
    }
}

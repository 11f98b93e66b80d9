//! Warnings about a score.

use std::fmt;

/// Circumstance that weakens a defined score.
///
/// ```
/// use taceva_metrics::Flag;
/// assert_eq!(Flag::OneBin.to_string(), "one bin");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Flag {
    /// All samples are in one bin, so nothing can vary.
    OneBin,
    /// The stimulus hardly changed: the light by less than 5 % in some scene, or labels between presses less than predictions of one press.
    LowStimulus,
    /// In some scene the error is smaller than in the reference scene, which the score counts like a larger one.
    ImprovedError,
    /// The truths of some channels move together, so that their effects on a prediction cannot be separated.
    CollinearTruths,
    /// The training labels are unknown: skill is measured against the mean of the evaluated truth.
    MeanOfTruth,
    /// Every cluster gives the same value: the interval has no width, which does not show that the value is certain.
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

//! Errors of comparisons of two scores.

use std::error::Error;
use std::fmt;

use super::sides::{Side, Sides};
use crate::score::least::LEAST_CLUSTERS;
use crate::score::value::{InapplicableReason, UndefinedReason};

/// Reason why a comparison has no result.
///
/// ```
/// use taceva_metrics::{ComparisonError, Estimate};
/// let few = Estimate::try_new(0.041, 0.003, 4);
/// assert_eq!(few, Err(ComparisonError::TooFewClusters { have: 4 }));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ComparisonError {
    /// The score of one side of the comparison, A or B, has no value or no interval.
    Undefined {
        /// Side without a value or an interval.
        side: Side,
        /// Reason for the missing value or interval.
        reason: UndefinedReason,
    },
    /// The metric does not apply to one side of the comparison, A or B.
    NotApplicable {
        /// Side to which the metric does not apply.
        side: Side,
        /// Reason why the metric does not apply.
        reason: InapplicableReason,
    },
    /// The difference has no interval.
    NoInterval(UndefinedReason),
    /// The two scores have different definitions, units or constants.
    Meaning(Sides<String>),
    /// A cluster exists on one side only, but the comparison is paired.
    Unpaired {
        /// Side with the cluster.
        side: Side,
        /// Name of the unpaired cluster.
        cluster: String,
    },
    /// A cluster has different numbers of samples on both sides, but the comparison is paired.
    Counts {
        /// Name of the cluster.
        cluster: String,
        /// Number of the cluster's samples on each side.
        samples: Sides<u64>,
    },
    /// A sample has no cluster.
    NoClusters,
    /// Too few clusters for an estimate of the variation.
    TooFewClusters {
        /// Number of clusters found.
        have: usize,
    },
    /// A sample has a term that is not finite and cannot be summed.
    Term {
        /// Cluster of the term.
        cluster: String,
        /// Value of the term.
        value: f64,
    },
    /// A score that is not finite.
    Score(f64),
    /// A standard error that is infinite, NaN or negative.
    StandardError(f64),
    /// Degrees of freedom that are infinite, NaN or below 1.
    Freedom(f64),
    /// An interval that does not contain its score.
    Ends {
        /// The score.
        value: f64,
        /// Lower and upper end.
        ends: [f64; 2],
    },
    /// The difference does not vary between clusters, so its uncertainty is unknown.
    NoSpread,
    /// A margin of equivalence that is infinite, NaN, negative or 0.
    Margin(f64),
    /// A p value outside 0..=1.
    Probability {
        /// Index of the p value in its family.
        position: usize,
        /// The p value.
        value: f64,
    },
}

impl fmt::Display for ComparisonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ComparisonError::Undefined { side, reason } => {
                write!(f, "{side} is undefined: {reason}")
            }
            ComparisonError::NotApplicable { side, reason } => {
                write!(f, "{side} is not applicable: {reason}")
            }
            ComparisonError::NoInterval(reason) => {
                write!(f, "the difference has no interval: {reason}")
            }
            ComparisonError::Meaning(Sides { a, b }) => {
                write!(f, "A is `{a}` and B is `{b}`, expected the same quantity")
            }
            ComparisonError::Unpaired { side, cluster } => {
                let cluster = taceva_core::shown(cluster);
                write!(
                    f,
                    "cluster `{cluster}` is in {side} only, expected the same samples"
                )
            }
            ComparisonError::Counts { cluster, samples } => write!(
                f,
                "cluster `{}` has {} samples in A and {} in B, expected the same samples",
                taceva_core::shown(cluster),
                samples.a,
                samples.b
            ),
            ComparisonError::NoClusters => f.write_str("samples without point_id"),
            ComparisonError::TooFewClusters { have } => {
                let clusters = if *have == 1 { "cluster" } else { "clusters" };
                write!(f, "{have} {clusters}, {LEAST_CLUSTERS} are needed")
            }
            ComparisonError::Term { cluster, value } => {
                let cluster = taceva_core::shown(cluster);
                write!(
                    f,
                    "term {value} in cluster `{cluster}`, expected a finite number"
                )
            }
            ComparisonError::Score(value) => write!(f, "score {value}, expected a finite number"),
            ComparisonError::StandardError(value) => {
                write!(
                    f,
                    "standard error {value}, expected a finite number from 0 on"
                )
            }
            ComparisonError::Freedom(value) => write!(
                f,
                "{value} degrees of freedom, expected a finite number from 1 on"
            ),
            ComparisonError::Ends {
                value,
                ends: [low, high],
            } => write!(
                f,
                "interval {low}…{high} of score {value}, expected finite ends that enclose the score"
            ),
            ComparisonError::NoSpread => f.write_str("neither score varies between clusters"),
            ComparisonError::Margin(value) => {
                write!(f, "margin {value}, expected a finite number above 0")
            }
            ComparisonError::Probability { position, value } => {
                write!(f, "p value {value} at position {position}, expected 0 to 1")
            }
        }
    }
}

impl Error for ComparisonError {}

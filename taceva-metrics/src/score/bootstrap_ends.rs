//! Methods that compute the ends of an interval from bootstrap replicates.

use std::fmt;

/// Method that computes interval ends from bootstrap replicates.
///
/// ```
/// assert_eq!(taceva_metrics::BootstrapEnds::Percentile.to_string(), "percentile");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BootstrapEnds {
    /// Percentiles: the k-th smallest and the k-th greatest of B replicates, with k = ⌊(B + 1) / 40⌋. Skewed scores get asymmetric ends.
    Percentile,
    /// Value ± t standard deviations of the replicates, on an unbounded scale. t is Student's t with one degree of freedom fewer than clusters.
    Normal,
}

impl fmt::Display for BootstrapEnds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            BootstrapEnds::Percentile => "percentile",
            BootstrapEnds::Normal => "normal",
        })
    }
}

//! Computes interval ends from bootstrap replicates.

use std::fmt;

/// Method that computes interval ends from bootstrap replicates.
///
/// ```
/// assert_eq!(taceva_metrics::BootstrapEnds::Percentile.to_string(), "percentile");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BootstrapEnds {
    /// The k-th and the (B + 1 − k)-th of B sorted replicates, with k = ⌊(B + 1) / 40⌋. Ends are asymmetric for skewed scores.
    Percentile,
    /// Value ± t(G − 1) standard deviations of the replicates, on an unbounded scale.
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

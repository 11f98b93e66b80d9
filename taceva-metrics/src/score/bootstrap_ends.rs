//! The way from replicates to an interval.

use std::fmt;

/// How an interval is read off bootstrap replicates.
///
/// ```
/// assert_eq!(taceva_metrics::BootstrapEnds::Percentile.to_string(), "percentile");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BootstrapEnds {
    /// Of B replicates in their order the k-th and the (B + 1 − k)-th, k = ⌊(B + 1) / 40⌋: skewed where the score is.
    Percentile,
    /// The value ± t(G − 1) standard deviations of the replicates, on a scale without ends.
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

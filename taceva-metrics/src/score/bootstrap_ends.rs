//! Ends of an interval from bootstrap replicates.

use std::fmt;

/// Ends of an interval from bootstrap replicates.
///
/// ```
/// assert_eq!(taceva_metrics::BootstrapEnds::Percentile.to_string(), "percentile");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BootstrapEnds {
    /// The k-th and the (B + 1 − k)-th of B sorted replicates, k = ⌊(B + 1) / 40⌋; skewed for skewed scores.
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

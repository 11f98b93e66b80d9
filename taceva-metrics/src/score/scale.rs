//! Scales on which intervals are symmetric.

use std::fmt;

/// Scale on which an interval is symmetric about its value.
///
/// ```
/// use taceva_metrics::Scale;
/// assert_eq!(Scale::Logarithm.to_string(), ", logarithmic");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Scale {
    /// The scale of the score itself.
    Own,
    /// Logarithm of the distance from the single end of the range.
    Logarithm,
    /// Logarithm of the ratio of the distances from both ends (log odds).
    Logit,
    /// The scale of the score itself, with ends cut to the range.
    Cut,
    /// Wilson interval of a share, with the effective number of samples of the clusters.
    Wilson,
}

impl fmt::Display for Scale {
    /// Writes the words after the name of a method; empty for the scale of the score itself.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Scale::Own => "",
            Scale::Logarithm => ", logarithmic",
            Scale::Logit => ", logit",
            Scale::Cut => ", cut to the range",
            Scale::Wilson => ", Wilson with effective samples",
        })
    }
}

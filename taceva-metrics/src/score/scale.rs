//! The scale on which an interval is symmetric.

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
    /// Scale of the quantity itself.
    Own,
    /// Logarithm of the distance from the single end of the range.
    Logarithm,
    /// Logarithm of the ratio of the distances from both ends.
    Logit,
    /// Scale of the quantity itself, cut at the ends of its range.
    Cut,
    /// Wilson's test of each share, with the effective number of samples of the clusters.
    Wilson,
}

impl fmt::Display for Scale {
    /// Text after the name of a method; empty for the quantity's own scale.
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

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
    /// Logarithm of the distance from the only finite end of the range.
    Logarithm,
    /// Log odds: the logarithm of the ratio of the distances from both ends of the range.
    Logit,
    /// The scale of the score itself, with ends cut to the range.
    Cut,
    /// Scale of the Wilson interval of a share. The number of samples is reduced for dependence within clusters.
    Wilson,
}

impl fmt::Display for Scale {
    /// Writes the text that follows the name of a method, such as `, logit`; nothing for the scale of the score itself.
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

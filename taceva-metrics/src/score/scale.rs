//! The scale on which an interval is symmetric.

use std::fmt;

/// On which scale an interval is symmetric about its value.
///
/// ```
/// use taceva_metrics::Scale;
/// assert_eq!(Scale::Logarithm.to_string(), ", logarithmic");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Scale {
    /// That of the quantity itself.
    Own,
    /// The logarithm of the distance from the one end of the range.
    Logarithm,
    /// The logarithm of the distances from both ends, one over the other.
    Logit,
    /// That of the quantity itself, and cut where its range ends.
    Cut,
    /// That of a test of each share: Wilson's, with as many samples as the clusters are worth.
    Wilson,
}

impl fmt::Display for Scale {
    /// What is said behind the way in which an interval was found; nothing of the quantity's own scale.
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

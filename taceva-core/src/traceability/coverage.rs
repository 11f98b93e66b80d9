//! Coverage of the expanded uncertainties of a certificate.

use std::fmt;

/// Meaning of an expanded uncertainty: its coverage factor, or its coverage probability.
///
/// This type gets no further variant: a certificate states one of the two.
///
/// ```
/// use taceva_core::Coverage;
/// let probable = Coverage::Probability { p: 0.95, dof: Some(9.0) };
/// assert_ne!(Coverage::Factor(2.0), probable);
/// assert_eq!(probable.to_string(), "p = 0.95 with 9 degrees of freedom");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coverage {
    /// Coverage factor, the ratio of expanded to standard uncertainty: the key `k` in files.
    Factor(f64),
    /// Coverage probability of the interval that the expanded uncertainty spans.
    Probability {
        /// Probability, from 0.68 to below 1: the key `p` in files.
        p: f64,
        /// Degrees of freedom of the standard uncertainty; `None` for infinity.
        dof: Option<f64>,
    },
}

impl fmt::Display for Coverage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Coverage::Factor(k) => write!(f, "k = {k}"),
            Coverage::Probability { p, dof: None } => write!(f, "p = {p}"),
            Coverage::Probability { p, dof: Some(dof) } => {
                write!(f, "p = {p} with {dof} degrees of freedom")
            }
        }
    }
}

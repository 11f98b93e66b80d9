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
    /// Coverage factor k.
    Factor(f64),
    /// Coverage probability p.
    Probability {
        /// Probability, in 0..1.
        p: f64,
        /// Degrees of freedom; `None` for infinity.
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

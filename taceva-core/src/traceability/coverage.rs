//! Coverage of the expanded uncertainties of a certificate.

/// Meaning of an expanded uncertainty: its coverage factor, or its coverage probability.
///
/// This type gets no further variant: a certificate states one of the two.
///
/// ```
/// use taceva_core::Coverage;
/// assert_ne!(Coverage::Factor(2.0), Coverage::Probability { p: 0.95, dof: Some(9.0) });
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

//! Faults of a certificate as it was stated.

use std::fmt;

use crate::printable::shown;

/// A certificate that contradicts itself or cannot be read.
///
/// ```
/// use taceva_core::{Certificate, Coverage, Instrument};
/// let issued = "2026-05-12".parse()?;
/// let certificate = Certificate::new("D-K-1", "a laboratory", issued, "42", Coverage::Factor(2.0));
/// let error = certificate.check(Instrument::Force).unwrap_err();
/// assert!(error.to_string().starts_with("the certificate states no uncertainty"));
/// # Ok::<(), taceva_core::DateError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CertificateError {
    /// A key whose value is not accepted.
    Value {
        /// Key: `U.Fz`.
        key: String,
        /// Value as found.
        found: String,
        /// Values that are accepted.
        expected: String,
    },
    /// `U` without `k` and without `p`.
    NoCoverage,
    /// Both `k` and `p`, or `k` and `dof`.
    TwoCoverages,
    /// Neither `U` nor `U_relative`.
    NoUncertainty,
}

impl CertificateError {
    /// The error of a value that is not accepted.
    pub(super) fn value(
        key: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> CertificateError {
        CertificateError::Value {
            key: key.into(),
            found: found.into(),
            expected: expected.into(),
        }
    }
}

impl fmt::Display for CertificateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CertificateError::Value {
                key,
                found,
                expected,
            } => write!(
                f,
                "`{}` is `{}`, expected {expected}",
                shown(key),
                shown(found)
            ),
            CertificateError::NoCoverage => f.write_str(
                "`U` is stated without its coverage, expected `k = 2.0`, or `p = 0.95` with `dof`",
            ),
            CertificateError::TwoCoverages => {
                f.write_str("`k` is stated beside `p` or `dof`, expected `k` alone, or `p` with `dof`")
            }
            CertificateError::NoUncertainty => f.write_str(
                "the certificate states no uncertainty, expected `U = { Fz = \"3.0 mN\" }` or `U_relative = { Fz = 0.001 }`",
            ),
        }
    }
}

impl std::error::Error for CertificateError {}

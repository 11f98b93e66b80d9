//! Errors in the entries of a certificate.

use std::fmt;

use crate::printable::shown;
use crate::suggestion::nearest;

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
    /// The value of a key is rejected.
    Value {
        /// Key of the value, such as `U.Fz`.
        key: String,
        /// Value as found.
        found: String,
        /// Accepted values.
        expected: String,
    },
    /// No certificate has this key.
    UnknownKey {
        /// Key as written.
        key: String,
        /// Keys that a certificate may have.
        known: Vec<&'static str>,
    },
    /// All missing required keys.
    MissingKeys(Vec<&'static str>),
    /// Neither the coverage factor `k` nor the coverage probability `p` is stated.
    NoCoverage,
    /// The coverage factor `k` is stated together with the coverage probability `p` or with the degrees of freedom `dof`.
    TwoCoverages,
    /// Neither `U` nor `U_relative` states an expanded uncertainty.
    NoUncertainty,
}

impl CertificateError {
    /// Key of the rejected table entry; `None` if the error concerns the whole table.
    ///
    /// ```
    /// use taceva_core::CertificateError;
    /// assert_eq!(CertificateError::NoCoverage.key(), Some("U"));
    /// assert_eq!(CertificateError::NoUncertainty.key(), None);
    /// ```
    pub fn key(&self) -> Option<&str> {
        match self {
            CertificateError::Value { key, .. } => key.split('.').next(),
            CertificateError::UnknownKey { key, .. } => Some(key),
            CertificateError::NoCoverage => Some("U"),
            CertificateError::TwoCoverages => Some("k"),
            CertificateError::MissingKeys(_) | CertificateError::NoUncertainty => None,
        }
    }

    /// Error for the value `found` of `key`, with the values expected.
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
            CertificateError::UnknownKey { key, known } => {
                write!(f, "`{}`: unknown key", shown(key))?;
                if let Some(nearest) = nearest(key, known.iter().copied()) {
                    write!(f, ", did you mean `{nearest}`?")?;
                }
                write!(f, "; known here: {}", known.join(", "))
            }
            CertificateError::MissingKeys(keys) => match keys.as_slice() {
                [key] => write!(f, "the key `{key}` is missing"),
                keys => write!(f, "the keys `{}` are missing", keys.join("`, `")),
            },
            CertificateError::NoCoverage => f.write_str(
                "`U` is stated without its coverage, expected `k = 2.0`, or `p = 0.95` with `dof`",
            ),
            CertificateError::TwoCoverages => {
                f.write_str("`k` is stated with `p` or `dof`, expected `k` without them, or `p` with `dof`")
            }
            CertificateError::NoUncertainty => f.write_str(
                "the certificate states no uncertainty, expected `U = { Fz = \"3.0 mN\" }` or `U_relative = { Fz = 0.001 }`",
            ),
        }
    }
}

impl std::error::Error for CertificateError {}

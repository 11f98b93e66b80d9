//! Contradictions between a certificate and its instrument, or between its validity and the days of the labels.

use std::fmt;
use std::ops::RangeInclusive;

use super::Traceability;
use super::instrument::Instrument;
use crate::date::Date;
use crate::printable::shown;

/// Contradiction between a certificate and its instrument, or between its validity and the days on which labels were measured.
///
/// ```
/// use taceva_core::{Certificate, Coverage, Instrument, Traceability};
/// let issued = "2026-05-12".parse()?;
/// let mut certificate = Certificate::new("D-K-1", "a laboratory", issued, "42", Coverage::Factor(2.0));
/// certificate.expanded.insert("Fz".to_owned(), "3 mN".parse()?);
/// let traced = Traceability::new(Instrument::Force).with_driver("ati/netft", Some("43".to_owned()));
/// let traced = traced.with_certificate(certificate)?;
/// let faults = traced.faults(None, &[]);
/// assert!(faults[0].is_error());
/// assert!(faults[0].to_string().ends_with("serial number 42, but the driver read 43"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct CertificateFault {
    /// Instrument of the certificate.
    pub instrument: Instrument,
    /// Number of the certificate.
    pub number: String,
    /// Values that contradict each other.
    pub contradiction: CertificateContradiction,
}

/// Values of a certificate that contradict its instrument or its labels.
///
/// ```
/// use taceva_core::CertificateContradiction;
/// let (until, last) = ("2027-05-12".parse()?, "2027-05-13".parse()?);
/// assert_ne!(
///     CertificateContradiction::Expired { until, last },
///     CertificateContradiction::IssuedLater { issued: until, first: last },
/// );
/// # Ok::<(), taceva_core::DateError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CertificateContradiction {
    /// The instrument has a serial number other than the certificate states.
    OtherSerial {
        /// Serial number that the certificate states.
        stated: String,
        /// Serial number that the driver read.
        read: String,
    },
    /// The certificate expired before the last day of the labels.
    Expired {
        /// Last day of validity.
        until: Date,
        /// Last day on which labels were measured.
        last: Date,
    },
    /// The certificate was issued after the first day of the labels.
    IssuedLater {
        /// Day of issue.
        issued: Date,
        /// First day on which labels were measured.
        first: Date,
    },
}

impl CertificateFault {
    /// True if the serial numbers differ, so that the certificate does not apply to the labels.
    pub fn is_error(&self) -> bool {
        matches!(
            self.contradiction,
            CertificateContradiction::OtherSerial { .. }
        )
    }
}

impl fmt::Display for CertificateFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let instrument = self.instrument.noun();
        let number = shown(&self.number);
        match &self.contradiction {
            CertificateContradiction::OtherSerial { stated, read } => write!(
                f,
                "the certificate {number} of the {instrument} is for serial number {}, but the driver read {}",
                shown(stated),
                shown(read)
            ),
            CertificateContradiction::Expired { until, last } => write!(
                f,
                "the certificate {number} of the {instrument} was valid until {until}, but the measurement was made on {last}"
            ),
            CertificateContradiction::IssuedLater { issued, first } => write!(
                f,
                "the certificate {number} of the {instrument} was issued on {issued}, but the measurement was made on {first}"
            ),
        }
    }
}

impl Traceability {
    /// Contradictions of the certificate. A different serial number is first. `days` are the first and the last day of the labels, if known. A day on
    /// which another certificate in `all` is valid gives no contradiction.
    pub fn faults(
        &self,
        days: Option<&RangeInclusive<Date>>,
        all: &[Traceability],
    ) -> Vec<CertificateFault> {
        let Some(certificate) = &self.certificate else {
            return Vec::new();
        };
        let serial = self
            .other_serial()
            .map(|(_, read)| CertificateContradiction::OtherSerial {
                stated: certificate.serial.clone(),
                read: read.to_owned(),
            });
        let expired = days.and_then(|days| {
            let last = *days.end();
            let (_, until) = self.expired_on(last, all)?;
            Some(CertificateContradiction::Expired { until, last })
        });
        let later = days.and_then(|days| {
            let first = *days.start();
            let issued = self.issued_after(first, all)?;
            Some(CertificateContradiction::IssuedLater { issued, first })
        });
        let found = [serial, expired, later].into_iter().flatten();
        found
            .map(|contradiction| CertificateFault {
                instrument: self.instrument,
                number: certificate.number.clone(),
                contradiction,
            })
            .collect()
    }

    /// Day of issue of the certificate, if this day is after `day`, the first day of the labels. `None` if a certificate in `all` of the same
    /// instrument is valid on `day`.
    pub fn issued_after(&self, day: Date, all: &[Traceability]) -> Option<Date> {
        let issued = self.certificate.as_ref()?.issued;
        (issued > day && !self.is_covered_on(day, all)).then_some(issued)
    }
}

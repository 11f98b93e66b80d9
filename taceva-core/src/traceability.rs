//! Traceability of labels: the measuring instrument and its calibration certificate.

mod certificate;
mod coverage;
mod error;
mod fault;
mod instrument;
#[cfg(feature = "serde")]
mod schema;

pub use certificate::{Certificate, StatedCorrelation};
pub use coverage::Coverage;
pub use error::CertificateError;
pub use fault::{CertificateContradiction, CertificateFault};
pub use instrument::Instrument;

use crate::date::Date;

/// Instrument that measured labels, with its driver, serial number and certificate.
///
/// ```
/// use taceva_core::{Amount, Certificate, Coverage, Instrument, Traceability};
/// let issued = "2026-05-12".parse()?;
/// let mut certificate = Certificate::new("D-K-1", "a laboratory", issued, "M3813B-0042", Coverage::Factor(2.0));
/// certificate.expanded.insert("Fz".to_owned(), "3 mN".parse()?);
/// let traced = Traceability::new(Instrument::Force).with_certificate(certificate)?;
/// assert_eq!(traced.to_string(), "force: certificate D-K-1 of a laboratory, 2026-05-12, serial M3813B-0042");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "schema::WrittenTraceability"))]
#[non_exhaustive]
pub struct Traceability {
    /// Instrument that measured the labels.
    pub instrument: Instrument,
    /// Driver that read the instrument: `ati/netft`; `None` for imported labels.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub driver: Option<String>,
    /// Serial number that the driver read; `None` if the driver reads none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub serial: Option<String>,
    /// Calibration certificate; `None` if the labels are not traceable.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub certificate: Option<Certificate>,
}

impl Traceability {
    /// Entry for `instrument`, without driver, serial number and certificate.
    pub fn new(instrument: Instrument) -> Traceability {
        Traceability {
            instrument,
            driver: None,
            serial: None,
            certificate: None,
        }
    }

    /// The same entry with the driver that read the instrument, and with the serial number that this driver read.
    #[must_use]
    pub fn with_driver(self, driver: impl Into<String>, serial: Option<String>) -> Traceability {
        Traceability {
            driver: Some(driver.into()),
            serial,
            ..self
        }
    }

    /// The same entry with a certificate of the instrument.
    ///
    /// # Errors
    /// The errors of [`Certificate::check`].
    pub fn with_certificate(
        self,
        certificate: Certificate,
    ) -> Result<Traceability, CertificateError> {
        certificate.check(self.instrument)?;
        Ok(Traceability {
            certificate: Some(certificate),
            ..self
        })
    }

    /// Entries for two sets of labels, without duplicates. If only one set has a certificate of an instrument, the result has an entry without a
    /// certificate for the other set.
    ///
    /// ```
    /// use taceva_core::{Certificate, Coverage, Instrument, Traceability};
    /// let issued = "2026-05-12".parse()?;
    /// let mut certificate = Certificate::new("D-K-1", "a laboratory", issued, "42", Coverage::Factor(2.0));
    /// certificate.expanded.insert("Fz".to_owned(), "3 mN".parse()?);
    /// let certified = [Traceability::new(Instrument::Force).with_certificate(certificate)?];
    /// assert_eq!(Traceability::joined(&certified, &certified), certified);
    /// assert!(Traceability::joined(&certified, &[])[1].certificate.is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn joined(own: &[Traceability], other: &[Traceability]) -> Vec<Traceability> {
        let mut all = own.to_vec();
        for traced in other {
            if !all.contains(traced) {
                all.push(traced.clone());
            }
        }
        for instrument in Instrument::ALL {
            let of = |traced: &Traceability, is_certified: bool| {
                traced.instrument == instrument && traced.certificate.is_some() == is_certified
            };
            let [one, two] =
                [own, other].map(|origin| origin.iter().any(|traced| of(traced, true)));
            if one != two && !all.iter().any(|traced| of(traced, false)) {
                all.push(Traceability::new(instrument));
            }
        }
        all
    }

    /// Certificate, and the serial number that the driver read, if the certificate states another serial number.
    pub fn other_serial(&self) -> Option<(&Certificate, &str)> {
        let certificate = self.certificate.as_ref()?;
        let read = self.serial.as_deref()?;
        (read != certificate.serial).then_some((certificate, read))
    }

    /// Certificate and its last day of validity, if this day is before `day`, the last day of the labels. `None` if a certificate in `all` of the
    /// same instrument is valid on `day`: the expired certificate then applies to earlier labels.
    pub fn expired_on(&self, day: Date, all: &[Traceability]) -> Option<(&Certificate, Date)> {
        let certificate = self.certificate.as_ref()?;
        let until = certificate.valid_until.filter(|until| *until < day)?;
        (!self.is_covered_on(day, all)).then_some((certificate, until))
    }

    /// True if `all` has a certificate of the same instrument that is valid on `day`.
    fn is_covered_on(&self, day: Date, all: &[Traceability]) -> bool {
        let of_instrument = all.iter().filter(|of| of.instrument == self.instrument);
        let mut certificates = of_instrument.filter_map(|of| of.certificate.as_ref());
        certificates.any(|certificate| certificate.is_valid_on(day))
    }
}

impl std::fmt::Display for Traceability {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: ", self.instrument)?;
        match &self.certificate {
            Some(certificate) => certificate.fmt(f),
            None => f.write_str("no certificate"),
        }
    }
}

#[cfg(test)]
mod tests;

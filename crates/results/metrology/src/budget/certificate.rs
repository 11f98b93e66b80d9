//! Calibration certificate of the reference, for one channel.

use super::freedom::Freedom;
use taceva_core::{Coverage, Date, Traceability};
use taceva_metrics::distributions::student_t;

/// Coverage factor k; `None` for k ≤ 0, or for a coverage probability outside 0..1.
pub(super) fn factor(coverage: Coverage) -> Option<f64> {
    match coverage {
        Coverage::Factor(k) => (k > 0.0 && k.is_finite()).then_some(k),
        Coverage::Probability { p, dof } => (p > 0.0 && p < 1.0)
            .then(|| student_t::quantile(f64::midpoint(1.0, p), dof.unwrap_or(f64::INFINITY))),
    }
}

/// Certificate of the reference for the measured channel. Numbers are in the unit of the measurand.
///
/// ```
/// use taceva_core::Coverage;
/// use taceva_metrology::budget::Certificate;
/// let mut certificate = Certificate::new("D-K-1", "a laboratory", "M3813B-0042", Coverage::Factor(2.0));
/// (certificate.absolute, certificate.relative) = (0.003, 0.001);
/// // √(1.5² + (0.5 × 10)²) mN at 10 N.
/// assert!(certificate.standard_uncertainty(10.0).is_some_and(|u| (u - 0.00522).abs() < 1e-5));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Certificate {
    /// Number of the certificate.
    pub number: String,
    /// Laboratory that issued the certificate.
    pub laboratory: String,
    /// Serial number in the certificate.
    pub serial: String,
    /// Serial number read by the instrument's driver; `None` if the driver reads no serial number.
    pub instrument_serial: Option<String>,
    /// Coverage factor or coverage probability of the expanded uncertainties.
    pub coverage: Coverage,
    /// Expanded uncertainty, constant over all readings.
    pub absolute: f64,
    /// Expanded uncertainty relative to the reading.
    pub relative: f64,
    /// Least and greatest calibrated value; `None` if the certificate states no range.
    pub range: Option<[f64; 2]>,
    /// Last day of validity, as `2027-05-12`; `None` if not stated.
    pub valid_until: Option<String>,
    /// Day of the recording, as `2027-05-12`; `None` if unknown.
    pub recorded_on: Option<String>,
}

impl Certificate {
    /// A certificate with zero uncertainty and no range.
    pub fn new(number: &str, laboratory: &str, serial: &str, coverage: Coverage) -> Certificate {
        Certificate {
            number: number.to_owned(),
            laboratory: laboratory.to_owned(),
            serial: serial.to_owned(),
            instrument_serial: None,
            coverage,
            absolute: 0.0,
            relative: 0.0,
            range: None,
            valid_until: None,
            recorded_on: None,
        }
    }

    /// Reduces the certificate of a recording's instrument to `channel`; `None` without a certificate or an uncertainty of this channel.
    ///
    /// ```
    /// use taceva_core::{Coverage, Instrument, Traceability};
    /// use taceva_metrology::budget::Certificate;
    /// let issued = "2026-05-12".parse()?;
    /// let coverage = Coverage::Factor(2.0);
    /// let mut whole = taceva_core::Certificate::new("D-K-1", "a laboratory", issued, "42", coverage);
    /// whole.expanded.insert("Fz".to_owned(), "3.0 mN".parse()?);
    /// let traced = Traceability::new(Instrument::Force).with_certificate(whole)?;
    /// let reduced = Certificate::of(&traced, "Fz", None);
    /// assert!(reduced.is_some_and(|one| one.absolute == 0.003 && one.serial == "42"));
    /// assert!(Certificate::of(&traced, "Fx", None).is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(
        traced: &Traceability,
        channel: &str,
        recorded_on: Option<Date>,
    ) -> Option<Certificate> {
        let stated = traced.certificate.as_ref()?;
        let absolute = stated.expanded.get(channel).map(|amount| amount.value);
        let relative = stated.relative.get(channel).copied();
        if absolute.is_none() && relative.is_none() {
            return None;
        }
        let range = stated.range.get(channel);
        Some(Certificate {
            number: stated.number.clone(),
            laboratory: stated.laboratory.clone(),
            serial: stated.serial.clone(),
            instrument_serial: traced.serial.clone(),
            coverage: stated.coverage,
            absolute: absolute.unwrap_or_default(),
            relative: relative.unwrap_or_default(),
            range: range.map(|[least, most]| [least.value, most.value]),
            valid_until: stated.valid_until.map(|until| until.to_string()),
            recorded_on: recorded_on.map(|day| day.to_string()),
        })
    }

    /// Standard uncertainty at `reading`: √(absolute² + (relative × reading)²) / coverage factor. `None` for an invalid coverage.
    pub fn standard_uncertainty(&self, reading: f64) -> Option<f64> {
        let k = factor(self.coverage)?;
        Some((self.absolute / k).hypot(self.relative * reading / k))
    }

    /// Degrees of freedom of the uncertainty.
    pub(super) fn freedom(&self) -> Freedom {
        match self.coverage {
            Coverage::Probability { dof: Some(dof), .. } => Freedom::Finite(dof),
            _ => Freedom::Infinite,
        }
    }

    /// Warning for a certificate that had or may have expired on the day of the recording. Dates have one form and are compared as text.
    pub(super) fn expiry(&self) -> Option<String> {
        let (number, until) = (&self.number, self.valid_until.as_ref()?);
        match &self.recorded_on {
            Some(on) if on > until => Some(format!(
                "certificate {number} was valid until {until}, but the recording was made on {on}"
            )),
            Some(_) => None,
            None => Some(format!(
                "certificate {number} is valid until {until}, but the day of the recording is unknown"
            )),
        }
    }
}

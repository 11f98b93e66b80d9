//! Calibration certificate of an instrument.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::RangeInclusive;

use super::coverage::Coverage;
use super::error::CertificateError;
use super::instrument::Instrument;
use crate::date::Date;
use crate::printable::shown;
use crate::suggestion::suggestion;
use crate::unit::{Amount, Unit};

/// Accepted correlation coefficients, as text for error messages.
pub(super) const COEFFICIENT: &str = "a number from -1 to 1, or \"unknown\"";

/// Accepted coverage factors. One degree of freedom at 95 % gives 12.7. A much greater factor probably lacks its decimal point.
const COVERAGE_FACTORS: RangeInclusive<f64> = 1.0..=20.0;
/// Least accepted coverage probability, which belongs to the coverage factor 1. A smaller number is probably a significance level, such as 0.05.
const LEAST_PROBABILITY: f64 = 0.68;

/// Calibration certificate of an instrument, with the uncertainty of each channel.
///
/// ```
/// use taceva_core::{Certificate, Coverage, Instrument};
/// let issued = "2026-05-12".parse()?;
/// let mut certificate = Certificate::new("D-K-1", "a laboratory", issued, "M3813B-0042", Coverage::Factor(2.0));
/// certificate.expanded.insert("Fz".to_owned(), "3.0 mN".parse()?);
/// certificate.range.insert("Fz".to_owned(), ["0.05 N".parse()?, "50 N".parse()?]);
/// certificate.check(Instrument::Force)?;
/// assert!(!certificate.covers("Fz", 80.0) && certificate.covers("Fx", 80.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        into = "super::schema::WrittenCertificate",
        try_from = "super::schema::WrittenCertificate"
    )
)]
#[non_exhaustive]
pub struct Certificate {
    /// Number of the certificate.
    pub number: String,
    /// Laboratory that issued the certificate.
    pub laboratory: String,
    /// Accreditation of the laboratory: `DAkkS D-K-15063-01-00`; `None` if not stated.
    pub accreditation: Option<String>,
    /// Day of issue.
    pub issued: Date,
    /// Last day of validity; `None` if not stated.
    pub valid_until: Option<Date>,
    /// Serial number of the instrument.
    pub serial: String,
    /// Coverage factor or coverage probability of all expanded uncertainties.
    pub coverage: Coverage,
    /// Expanded uncertainty of each channel, equal for all readings: the key `U` in files.
    pub expanded: BTreeMap<String, Amount>,
    /// Expanded uncertainty of each channel as a share of the reading: the key `U_relative` in files. 0.01 is 1 %.
    pub relative: BTreeMap<String, f64>,
    /// Least and greatest calibrated value of each channel.
    pub range: BTreeMap<String, [Amount; 2]>,
    /// Correlations between the uncertainties of two channels. The correlation is 0 for each pair of channels without an entry.
    pub correlation: Vec<StatedCorrelation>,
    /// Temperature of the calibration, as the certificate states it: `23 ± 2 C`; `None` if not stated.
    pub temperature: Option<String>,
    /// Name of the certificate's file; `None` if not stated.
    pub file: Option<String>,
    /// SHA-256 of the certificate's file, as 64 hexadecimal digits; `None` if not stated.
    pub sha256: Option<String>,
}

/// Correlation of the uncertainties of two channels, as a certificate states it. This type gets no further field.
///
/// ```
/// use taceva_core::StatedCorrelation;
/// let unknown = StatedCorrelation { between: ["Fx".to_owned(), "Fy".to_owned()], coefficient: None };
/// assert!(unknown.coefficient.is_none());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct StatedCorrelation {
    /// Names of the two channels.
    pub between: [String; 2],
    /// Correlation coefficient from −1 to 1; `None` if the certificate states none.
    pub coefficient: Option<f64>,
}

impl Certificate {
    /// Certificate without uncertainties and ranges.
    pub fn new(
        number: impl Into<String>,
        laboratory: impl Into<String>,
        issued: Date,
        serial: impl Into<String>,
        coverage: Coverage,
    ) -> Certificate {
        Certificate {
            number: number.into(),
            laboratory: laboratory.into(),
            accreditation: None,
            issued,
            valid_until: None,
            serial: serial.into(),
            coverage,
            expanded: BTreeMap::new(),
            relative: BTreeMap::new(),
            range: BTreeMap::new(),
            correlation: Vec::new(),
            temperature: None,
            file: None,
            sha256: None,
        }
    }

    /// True if `value` is in the calibrated range of `channel`, or this channel has no such range. `value` is in the stored unit of the channel.
    pub fn covers(&self, channel: &str, value: f64) -> bool {
        let range = self.range.get(channel);
        range.is_none_or(|[least, most]| (least.value..=most.value).contains(&value))
    }

    /// True if `day` is between the day of issue and the last day of validity, both included.
    pub(super) fn is_valid_on(&self, day: Date) -> bool {
        self.issued <= day && self.valid_until.is_none_or(|until| day <= until)
    }

    /// Checks that the certificate has no contradiction and states only channels that `instrument` measures.
    ///
    /// # Errors
    /// [`CertificateError`] with the key, the value found and the values expected.
    pub fn check(&self, instrument: Instrument) -> Result<(), CertificateError> {
        self.check_texts()?;
        self.check_coverage()?;
        if self.expanded.is_empty() && self.relative.is_empty() {
            return Err(CertificateError::NoUncertainty);
        }
        for (channel, amount) in &self.expanded {
            let key = format!("U.{channel}");
            check_amount(instrument, &key, channel, amount)?;
            check_size(&key, amount.to_string(), amount.value)?;
        }
        for (channel, share) in &self.relative {
            let key = format!("U_relative.{channel}");
            check_channel(instrument, &key, channel)?;
            check_size(&key, share.to_string(), *share)?;
            if *share >= 1.0 {
                let expected = "0 or more and below 1, since 1 % is 0.01";
                return Err(CertificateError::value(key, share.to_string(), expected));
            }
        }
        self.check_zeros()?;
        for (channel, [least, most]) in &self.range {
            let key = format!("range.{channel}");
            check_amount(instrument, &key, channel, least)?;
            check_amount(instrument, &key, channel, most)?;
            if least.value > most.value {
                let found = format!("{least} to {most}");
                let expected = "the least value before the greatest";
                return Err(CertificateError::value(key, found, expected));
            }
        }
        for (position, correlation) in self.correlation.iter().enumerate() {
            correlation.check(instrument)?;
            let [first, second] = &correlation.between;
            let mut before = self.correlation.iter().take(position);
            if before.any(|of| of.between.contains(first) && of.between.contains(second)) {
                let found = format!("{first}, {second}");
                let expected = "each pair of channels once";
                return Err(CertificateError::value("correlation", found, expected));
            }
        }
        Ok(())
    }

    /// Rejects a channel whose stated uncertainties are all 0.
    fn check_zeros(&self) -> Result<(), CertificateError> {
        for channel in self.expanded.keys().chain(self.relative.keys()) {
            let amount = self.expanded.get(channel).map(|amount| amount.value);
            let share = self.relative.get(channel).copied();
            let mut stated = [amount, share].into_iter().flatten();
            if !stated.any(|number| number > 0.0) {
                let expected = "a number above 0 in `U` or `U_relative`";
                let table = if amount.is_some() { "U" } else { "U_relative" };
                let key = format!("{table}.{channel}");
                return Err(CertificateError::value(key, "0", expected));
            }
        }
        Ok(())
    }

    fn check_texts(&self) -> Result<(), CertificateError> {
        let required = [
            ("number", &self.number),
            ("laboratory", &self.laboratory),
            ("serial", &self.serial),
        ];
        for (key, text) in required {
            if text.trim().is_empty() {
                let expected = "a string that is not empty";
                return Err(CertificateError::value(key, text, expected));
            }
        }
        if let Some(until) = self.valid_until.filter(|until| *until < self.issued) {
            let expected = format!("a day not before `issued`, {}", self.issued);
            return Err(CertificateError::value(
                "valid_until",
                until.to_string(),
                expected,
            ));
        }
        let is_digest =
            |text: &str| text.len() == 64 && text.bytes().all(|letter| letter.is_ascii_hexdigit());
        match &self.sha256 {
            Some(text) if !is_digest(text) => Err(CertificateError::value(
                "sha256",
                text,
                "64 hexadecimal digits",
            )),
            _ => Ok(()),
        }
    }

    fn check_coverage(&self) -> Result<(), CertificateError> {
        let refused = |key: &str, number: f64, expected: &str| {
            Err(CertificateError::value(key, number.to_string(), expected))
        };
        match self.coverage {
            Coverage::Factor(k) if !COVERAGE_FACTORS.contains(&k) => {
                refused("k", k, "a coverage factor from 1 to 20, such as 2")
            }
            Coverage::Probability { p, .. } if !(LEAST_PROBABILITY..1.0).contains(&p) => {
                refused("p", p, "a probability from 0.68 to below 1, such as 0.95")
            }
            Coverage::Probability { dof: Some(dof), .. } if !(dof > 0.0 && dof.is_finite()) => {
                refused("dof", dof, "a number above 0")
            }
            _ => Ok(()),
        }
    }
}

impl StatedCorrelation {
    fn check(&self, instrument: Instrument) -> Result<(), CertificateError> {
        let [first, second] = &self.between;
        for channel in [first, second] {
            check_channel(instrument, "correlation", channel)?;
        }
        if first == second {
            let expected = "two different channels";
            return Err(CertificateError::value("correlation", first, expected));
        }
        let is_wrong = |r: &f64| !(-1.0..=1.0).contains(r);
        match self.coefficient.filter(is_wrong) {
            Some(r) => Err(CertificateError::value(
                "correlation",
                r.to_string(),
                COEFFICIENT,
            )),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "certificate {} of {}, {}, serial {}",
            shown(&self.number),
            shown(&self.laboratory),
            self.issued,
            shown(&self.serial)
        )?;
        match self.valid_until {
            Some(until) => write!(f, ", valid until {until}"),
            None => Ok(()),
        }
    }
}

fn check_channel(
    instrument: Instrument,
    key: &str,
    channel: &str,
) -> Result<Unit, CertificateError> {
    instrument.unit_of(channel).ok_or_else(|| {
        let known: Vec<&str> = instrument.channels().map(|(name, _)| name).collect();
        let expected = format!(
            "a channel of the {}: {}",
            instrument.noun(),
            suggestion(channel, &known)
        );
        CertificateError::value(key, channel, expected)
    })
}

fn check_amount(
    instrument: Instrument,
    key: &str,
    channel: &str,
    amount: &Amount,
) -> Result<(), CertificateError> {
    let unit = check_channel(instrument, key, channel)?;
    match amount.unit == unit && amount.value.is_finite() {
        true => Ok(()),
        false => {
            let expected = format!("an amount in {unit} or a unit of the same quantity");
            Err(CertificateError::value(key, amount.to_string(), expected))
        }
    }
}

fn check_size(key: &str, found: String, number: f64) -> Result<(), CertificateError> {
    match number >= 0.0 && number.is_finite() {
        true => Ok(()),
        false => Err(CertificateError::value(key, found, "0 or more")),
    }
}

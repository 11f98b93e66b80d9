//! Form of certificates and their instruments in files, with dates and amounts as text.

mod entries;

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{Deserialize, Deserializer, Error as _, MapAccess, Visitor};
use serde::ser::{Serialize, Serializer};

use super::Traceability;
use super::certificate::{COEFFICIENT, Certificate, StatedCorrelation};
use super::coverage::Coverage;
use super::error::CertificateError;
use super::instrument::Instrument;
use crate::date::{Date, DateError};
use crate::unit::{Amount, AmountError};

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenCertificate {
    number: String,
    laboratory: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    accreditation: Option<String>,
    issued: DateText,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    valid_until: Option<DateText>,
    serial: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    k: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    p: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    dof: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    temperature: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    sha256: Option<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    correlation: Vec<WrittenCorrelation>,
    #[serde(default, rename = "U", skip_serializing_if = "BTreeMap::is_empty")]
    expanded: BTreeMap<String, String>,
    #[serde(
        default,
        rename = "U_relative",
        skip_serializing_if = "BTreeMap::is_empty"
    )]
    relative: BTreeMap<String, f64>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    range: BTreeMap<String, [String; 2]>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenTraceability {
    instrument: Instrument,
    driver: Option<String>,
    serial: Option<String>,
    certificate: Option<Certificate>,
}

/// Names of two channels and their correlation coefficient.
#[derive(serde::Serialize, serde::Deserialize)]
struct WrittenCorrelation(String, String, Coefficient);

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(untagged)]
enum Coefficient {
    Number(f64),
    Word(String),
}

/// Text of a date, which TOML may write with or without quotes.
struct DateText(String);

impl Serialize for DateText {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0)
    }
}

impl<'de> Deserialize<'de> for DateText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<DateText, D::Error> {
        struct TextOrDate;
        impl<'de> Visitor<'de> for TextOrDate {
            type Value = DateText;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(&DateError, f)
            }
            fn visit_str<E>(self, text: &str) -> Result<DateText, E> {
                Ok(DateText(text.to_owned()))
            }
            // TOML passes a date without quotes as a map with one text.
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<DateText, A::Error> {
                match map.next_entry::<String, String>()? {
                    Some((_, text)) => Ok(DateText(text)),
                    None => Err(A::Error::custom(format_args!("expected {DateError}"))),
                }
            }
        }
        deserializer.deserialize_any(TextOrDate)
    }
}

impl DateText {
    fn parse(&self, key: &str) -> Result<Date, CertificateError> {
        let parsed = self.0.parse();
        parsed.map_err(|expected: DateError| {
            CertificateError::value(key, &self.0, expected.to_string())
        })
    }
}

fn amount(key: &str, channel: &str, text: &str) -> Result<Amount, CertificateError> {
    text.parse().map_err(|expected: AmountError| {
        CertificateError::value(format!("{key}.{channel}"), text, expected.to_string())
    })
}

impl TryFrom<WrittenCertificate> for Certificate {
    type Error = CertificateError;

    fn try_from(written: WrittenCertificate) -> Result<Certificate, CertificateError> {
        let coverage = match (written.k, written.p, written.dof) {
            (Some(k), None, None) => Coverage::Factor(k),
            (None, Some(p), dof) => Coverage::Probability { p, dof },
            (None, None, _) => return Err(CertificateError::NoCoverage),
            (Some(_), _, _) => return Err(CertificateError::TwoCoverages),
        };
        let mut expanded = BTreeMap::new();
        for (channel, text) in written.expanded {
            let parsed = amount("U", &channel, &text)?;
            expanded.insert(channel, parsed);
        }
        let mut range = BTreeMap::new();
        for (channel, [least, most]) in written.range {
            let ends = [
                amount("range", &channel, &least)?,
                amount("range", &channel, &most)?,
            ];
            range.insert(channel, ends);
        }
        let correlation = written.correlation.into_iter();
        let correlation = correlation.map(StatedCorrelation::try_from);
        let valid_until = written.valid_until.map(|until| until.parse("valid_until"));
        Ok(Certificate {
            number: written.number,
            laboratory: written.laboratory,
            accreditation: written.accreditation,
            issued: written.issued.parse("issued")?,
            valid_until: valid_until.transpose()?,
            serial: written.serial,
            coverage,
            expanded,
            relative: written.relative,
            range,
            correlation: correlation.collect::<Result<_, CertificateError>>()?,
            temperature: written.temperature,
            file: written.file,
            sha256: written.sha256,
        })
    }
}

impl TryFrom<WrittenCorrelation> for StatedCorrelation {
    type Error = CertificateError;

    fn try_from(written: WrittenCorrelation) -> Result<StatedCorrelation, CertificateError> {
        let WrittenCorrelation(first, second, coefficient) = written;
        let coefficient = match coefficient {
            Coefficient::Number(number) => Some(number),
            Coefficient::Word(word) if word == "unknown" => None,
            Coefficient::Word(word) => {
                return Err(CertificateError::value("correlation", word, COEFFICIENT));
            }
        };
        Ok(StatedCorrelation {
            between: [first, second],
            coefficient,
        })
    }
}

impl From<Certificate> for WrittenCertificate {
    fn from(certificate: Certificate) -> WrittenCertificate {
        let (k, p, dof) = match certificate.coverage {
            Coverage::Factor(k) => (Some(k), None, None),
            Coverage::Probability { p, dof } => (None, Some(p), dof),
        };
        let expanded = certificate.expanded.into_iter();
        let range = certificate.range.into_iter();
        WrittenCertificate {
            number: certificate.number,
            laboratory: certificate.laboratory,
            accreditation: certificate.accreditation,
            issued: DateText(certificate.issued.to_string()),
            valid_until: certificate
                .valid_until
                .map(|until| DateText(until.to_string())),
            serial: certificate.serial,
            k,
            p,
            dof,
            temperature: certificate.temperature,
            file: certificate.file,
            sha256: certificate.sha256,
            correlation: certificate
                .correlation
                .into_iter()
                .map(WrittenCorrelation::from)
                .collect(),
            expanded: expanded
                .map(|(channel, amount)| (channel, amount.to_string()))
                .collect(),
            relative: certificate.relative,
            range: range
                .map(|(channel, ends)| (channel, ends.map(|end| end.to_string())))
                .collect(),
        }
    }
}

impl From<StatedCorrelation> for WrittenCorrelation {
    fn from(stated: StatedCorrelation) -> WrittenCorrelation {
        let [first, second] = stated.between;
        let coefficient = match stated.coefficient {
            Some(number) => Coefficient::Number(number),
            None => Coefficient::Word("unknown".to_owned()),
        };
        WrittenCorrelation(first, second, coefficient)
    }
}

impl TryFrom<WrittenTraceability> for Traceability {
    type Error = CertificateError;

    fn try_from(written: WrittenTraceability) -> Result<Traceability, CertificateError> {
        if let Some(certificate) = &written.certificate {
            certificate.check(written.instrument)?;
        }
        Ok(Traceability {
            instrument: written.instrument,
            driver: written.driver,
            serial: written.serial,
            certificate: written.certificate,
        })
    }
}

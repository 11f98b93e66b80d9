//! Reads the certificate of a reference from a rig, from the header of a recording, or from a separate file.

use serde::Deserialize;
use serde::de::IgnoredAny;
use taceva_core::{Date, Instrument, Traceability, shown};

use super::certificate::Certificate;
use super::error::{BudgetError, BudgetProblem};
use super::text::explained;

/// Instruments whose readings are the true values of a recording.
const REFERENCES: [Instrument; 2] = [Instrument::Force, Instrument::Robot];

/// Tables of a file that may contain certificates. Other tables are ignored.
#[derive(Deserialize)]
struct Tables {
    #[serde(default)]
    traceability: Vec<Traceability>,
    force: Option<Device>,
    robot: Option<Device>,
    /// Number of the certificate; present if the whole file is one certificate.
    number: Option<IgnoredAny>,
}

/// Table of a device, with its certificate.
#[derive(Deserialize)]
struct Device {
    certificate: Option<taceva_core::Certificate>,
}

impl Certificate {
    /// Reads the certificate of the reference of `channel` for a recording made on `recorded_on`.
    ///
    /// ```
    /// use taceva_metrology::budget::Certificate;
    /// let text = r#"
    /// [force.certificate]
    /// number = "D-K-1"
    /// laboratory = "a laboratory"
    /// issued = 2026-05-12
    /// serial = "42"
    /// k = 2.0
    /// U = { Fz = "3.0 mN" }
    /// "#;
    /// assert_eq!(Certificate::read(text, "Fz", None)?.absolute, 0.003);
    /// assert!(Certificate::read(text, "Pz", None).is_err());
    /// # Ok::<(), taceva_metrology::budget::BudgetError>(())
    /// ```
    ///
    /// # Errors
    /// [`BudgetError`] with the line of invalid TOML or of an inconsistent certificate. Also if none or several state `channel`.
    pub fn read(
        text: &str,
        channel: &str,
        recorded_on: Option<Date>,
    ) -> Result<Certificate, BudgetError> {
        let tables: Tables = parsed(text)?;
        let mut all = tables.traceability;
        for (instrument, device) in REFERENCES.into_iter().zip([tables.force, tables.robot]) {
            if let Some(certificate) = device.and_then(|device| device.certificate) {
                all.push(traced(instrument, certificate)?);
            }
        }
        if tables.number.is_some() {
            let is_of = |instrument: &Instrument| instrument.unit_of(channel).is_some();
            let instrument = REFERENCES.into_iter().find(is_of);
            all.push(traced(
                instrument.unwrap_or(Instrument::Sensor),
                parsed(text)?,
            )?);
        }
        let mut found = Certificate::of_references(&all, channel, recorded_on);
        let channel = shown(channel);
        match (found.next(), found.next()) {
            (Some(only), None) => Ok(only),
            (Some(one), Some(other)) => Err(refused(format!(
                "two certificates of a reference state {channel}, {} and {}; name a file with one certificate",
                shown(&one.number),
                shown(&other.number)
            ))),
            (None, _) => Err(refused(format!(
                "no certificate of a reference states `U` or `U_relative` of {channel}"
            ))),
        }
    }

    /// Certificates of `channel` among the instruments whose readings are the true values of a recording.
    pub fn of_references(
        all: &[Traceability],
        channel: &str,
        recorded_on: Option<Date>,
    ) -> impl Iterator<Item = Certificate> {
        let references = all.iter().filter(|of| REFERENCES.contains(&of.instrument));
        references.filter_map(move |of| Certificate::of(of, channel, recorded_on))
    }
}

fn traced(
    instrument: Instrument,
    certificate: taceva_core::Certificate,
) -> Result<Traceability, BudgetError> {
    let traced = Traceability::new(instrument).with_certificate(certificate);
    traced.map_err(|error| refused(error.to_string()))
}

fn refused(problem: String) -> BudgetError {
    BudgetError::new(None, "certificate", BudgetProblem::Certificate(problem))
}

fn parsed<T: for<'de> Deserialize<'de>>(text: &str) -> Result<T, BudgetError> {
    toml::from_str(text).map_err(|error| {
        let before = error.span().and_then(|span| text.get(..span.start));
        let line = before.map(|before| 1 + before.matches('\n').count());
        BudgetError::new(line, "", BudgetProblem::Syntax(explained(error.message())))
    })
}

//! Instruments that measured the labels, as stated in a map, with their certificates.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::{Certificate, Instrument, Traceability};
use toml::{Spanned, Value};

use super::check::Check;
use taceva_dataset::{DatasetError, Known, Leds, SensorFacts};

/// Entries of a certificate as written.
type WrittenCertificate = Spanned<BTreeMap<Spanned<String>, Value>>;

/// Map section of a transducer or a robot, as written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenInstrument {
    driver: Option<String>,
    serial: Option<String>,
    certificate: Option<WrittenCertificate>,
}

/// Map section of the sensor, as written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenSensor {
    model: String,
    serial: String,
    gel: String,
    opaque: Known<bool>,
    presses_since_gel: Option<u32>,
    #[serde(default)]
    leds: Leds,
    certificate: Option<WrittenCertificate>,
}

impl WrittenSensor {
    /// Facts of the sensor, without its certificate.
    pub(super) fn facts(&self) -> SensorFacts {
        let mut facts = SensorFacts::new(&self.model)
            .with_serial(&self.serial)
            .with_gel(&self.gel)
            .with_presses_since_gel(self.presses_since_gel);
        facts.opaque = self.opaque;
        facts.leds = self.leds;
        facts
    }

    /// Converts the sensor to an instrument; `None` without a certificate.
    pub(super) fn instrument(self) -> Option<WrittenInstrument> {
        let certificate = Some(self.certificate?);
        Some(WrittenInstrument {
            driver: None,
            serial: None,
            certificate,
        })
    }
}

impl Check<'_> {
    /// Checks the certificate of `instrument`.
    pub(super) fn instrument(
        &self,
        instrument: Instrument,
        written: WrittenInstrument,
    ) -> Result<Traceability, DatasetError> {
        let mut traced = Traceability::new(instrument);
        (traced.driver, traced.serial) = (written.driver, written.serial);
        let Some(certificate) = written.certificate else {
            return Ok(traced);
        };
        let entries = certificate.get_ref();
        let read = Certificate::of_entries::<_, Value, toml::de::Error>(instrument, entries);
        let read = read.map_err(|error| {
            let entry = error.key().and_then(|key| entries.get_key_value(key));
            let at = entry.map_or(certificate.span().start, |(key, _)| key.span().start);
            let problem = format!("[{instrument}.certificate]: {error}");
            self.at(at, &problem)
        })?;
        traced.certificate = Some(read);
        Ok(traced)
    }
}

//! Instruments of the labels in a map, with their certificates.

use serde::Deserialize;
use taceva_core::{Certificate, Instrument, Traceability};
use toml::Spanned;

use super::check::Check;
use taceva_dataset::{DatasetError, Known, SensorFacts};

/// A transducer or a robot.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenInstrument {
    driver: Option<String>,
    serial: Option<String>,
    certificate: Option<Spanned<Certificate>>,
}

/// The sensor.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenSensor {
    model: String,
    serial: String,
    gel: String,
    opaque: Known<bool>,
    certificate: Option<Spanned<Certificate>>,
}

impl WrittenSensor {
    /// Facts of the sensor, without its certificate.
    pub(super) fn facts(&self) -> SensorFacts {
        let mut facts = SensorFacts::new(&self.model)
            .with_serial(&self.serial)
            .with_gel(&self.gel);
        facts.opaque = self.opaque;
        facts
    }

    /// The sensor as an instrument; `None` without a certificate.
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
        let offset = certificate.span().start;
        let traced = traced.with_certificate(certificate.into_inner());
        traced.map_err(|error| self.at(offset, &format!("[{instrument}.certificate]: {error}")))
    }
}

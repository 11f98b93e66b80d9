//! Certificate of the reference behind a budget.

use taceva_core::{Date, Instrument, Traceability};
use taceva_metrology::budget::Certificate;

/// Single certificate of the instruments that measured the labels of `channel`. `recorded_on` is the date of the labels, if known.
///
/// ```
/// use taceva_core::{Instrument, Traceability};
/// let uncertified = [Traceability::new(Instrument::Force)];
/// let absent = taceva_report::reference_certificate(&uncertified, "Fz", None);
/// assert_eq!(absent.unwrap_err(), "the recording has no certificate");
/// ```
///
/// # Errors
/// The reason as text: no certificate, several certificates, or only some labels with a certificate.
pub fn reference_certificate(
    all: &[Traceability],
    channel: &str,
    recorded_on: Option<Date>,
) -> Result<Certificate, &'static str> {
    let is_without = all.iter().any(|of| {
        let is_reference = of.instrument != Instrument::Sensor;
        let measures = of.instrument.unit_of(channel).is_some();
        is_reference && measures && of.certificate.is_none()
    });
    let mut certificates = Certificate::of_references(all, channel, recorded_on);
    match (certificates.next(), certificates.next()) {
        (Some(_), None) if is_without => Err("some of the recordings have no certificate"),
        (Some(only), None) => Ok(only),
        (Some(_), Some(_)) => Err("the recordings have several certificates"),
        (None, _) => Err("the recording has no certificate"),
    }
}

//! Certificate of the reference behind a budget.

use taceva_core::{Date, Instrument, Traceability};
use taceva_metrology::budget::Certificate;

/// The only certificate of the references of `channel`, for labels of `recorded_on`.
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

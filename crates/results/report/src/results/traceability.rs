//! Sentence on the instruments and certificates behind the labels of a result.

use taceva_core::{Instrument, Traceability};
use taceva_results::Provenance;

/// Line for labels without a certificate.
pub(super) const NOT_TRACEABLE: &str = "not traceable: no certificate of the force transducer";

/// Certificates of the instruments that measured the labels, in the order of the recordings. The line begins with missing certificates, and ends with the
/// drivers of the instruments.
pub(super) fn traceability_line(provenance: &Provenance) -> String {
    let of_force = provenance.traceability.iter();
    let of_force = of_force.filter(|of| of.instrument == Instrument::Force);
    let (with, without): (Vec<_>, Vec<_>) = of_force.partition(|of| of.certificate.is_some());
    let missing = match (with.is_empty(), without.is_empty()) {
        (true, _) => Some(NOT_TRACEABLE.to_owned()),
        (false, true) => None,
        (false, false) => Some(
            "not traceable in part: some forces have no certificate of the force transducer"
                .to_owned(),
        ),
    };
    let stated = provenance.traceability.iter();
    let stated = stated.filter(|of| of.certificate.is_some());
    let stated = stated.map(|of| {
        let all = &provenance.traceability;
        match provenance.recorded_on {
            Some(day) if of.expired_on(day, all).is_some() => {
                format!("{of}, no longer valid on the day of the recording, {day}")
            }
            Some(day) if of.issued_after(day, all).is_some() => {
                format!("{of}, issued after the recording of {day}")
            }
            _ => of.to_string(),
        }
    });
    let read = provenance.traceability.iter().filter_map(reading);
    let lines = missing.into_iter().chain(stated).chain(read);
    lines.collect::<Vec<_>>().join("; ")
}

/// Driver of an instrument with the serial number that it read: `force read by ati/netft, serial number FT12345`. `None` if the driver is not stated.
fn reading(of: &Traceability) -> Option<String> {
    let driver = of.driver.as_ref()?;
    let serial = of.serial.as_ref();
    let serial = serial.map(|serial| format!(", serial number {serial}"));
    let serial = serial.unwrap_or_default();
    Some(format!("{} read by {driver}{serial}", of.instrument))
}

#[cfg(test)]
mod tests {
    use taceva_core::{Certificate, Coverage};

    use super::*;

    fn traced(instrument: Instrument, number: &str) -> Traceability {
        let issued = "2026-05-12".parse().expect("a day");
        let coverage = Coverage::Factor(2.0);
        let mut traced = Traceability::new(instrument);
        traced.certificate = Some(Certificate::new(
            number,
            "a laboratory",
            issued,
            "42",
            coverage,
        ));
        traced
    }

    fn line(traceability: Vec<Traceability>) -> String {
        traceability_line(&Provenance {
            traceability,
            ..Provenance::default()
        })
    }

    #[test]
    fn labels_without_a_certificate_of_the_transducer_are_not_traceable() {
        let force = Traceability::new(Instrument::Force);
        assert_eq!(line(Vec::new()), NOT_TRACEABLE);
        assert_eq!(line(vec![force]), NOT_TRACEABLE);
        assert_eq!(
            line(vec![traced(Instrument::Robot, "R-1")]),
            "not traceable: no certificate of the force transducer; robot: certificate R-1 of a laboratory, 2026-05-12, serial 42"
        );
    }

    #[test]
    fn certificates_are_named_and_a_recording_without_one_is_said_first() {
        let force = traced(Instrument::Force, "D-K-1");
        assert_eq!(
            line(vec![force.clone()]),
            "force: certificate D-K-1 of a laboratory, 2026-05-12, serial 42"
        );
        let mut old = force.clone();
        let certificate = old.certificate.as_mut().expect("a certificate");
        certificate.valid_until = Some("2027-05-12".parse().expect("a day"));
        let expired = traceability_line(&Provenance {
            traceability: vec![old],
            recorded_on: Some("2027-05-13".parse().expect("a day")),
            ..Provenance::default()
        });
        assert!(
            expired.ends_with(
                "valid until 2027-05-12, no longer valid on the day of the recording, 2027-05-13"
            ),
            "{expired}"
        );
        let later = traceability_line(&Provenance {
            traceability: vec![force.clone()],
            recorded_on: Some("2026-05-11".parse().expect("a day")),
            ..Provenance::default()
        });
        assert!(
            later.ends_with("serial 42, issued after the recording of 2026-05-11"),
            "{later}"
        );
        let read = force
            .clone()
            .with_driver("ati/netft", Some("FT12345".to_owned()));
        assert_eq!(
            line(vec![read]),
            "force: certificate D-K-1 of a laboratory, 2026-05-12, serial 42; force read by ati/netft, serial number FT12345"
        );
        let joined = line(vec![force, Traceability::new(Instrument::Force)]);
        assert!(joined.starts_with("not traceable in part: "), "{joined}");
        assert!(joined.contains("; force: certificate D-K-1"), "{joined}");
    }
}

//! TAC028: label instruments without a certificate, with an expired one, or with a certificate for another serial number.

use taceva_core::{Instrument, Traceability, shown};
use taceva_dataset::Source;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC028",
    name: "certificates",
    looks_for: "instruments without a calibration certificate, with an expired one, or with one for another serial number",
    hint: "state the certificate of each instrument in the rig file or in the map, such as [force.certificate], and record or import again",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let instruments = &evidence.header.traceability;
    let mut found = Vec::new();
    for traced in instruments {
        if let Some((certificate, read)) = traced.other_serial() {
            let message = format!(
                "the certificate {} is of the {} with serial number {}, the driver read {}",
                shown(&certificate.number),
                traced.instrument.noun(),
                shown(&certificate.serial),
                shown(read)
            );
            found.push(Found::overall(Severity::Error, message));
        }
    }
    let day = evidence.header.last_day(evidence.table.t_s());
    for traced in instruments {
        if let Some(day) = day
            && let Some((certificate, until)) = traced.expired_on(day, instruments)
        {
            let message = format!(
                "the certificate {} of the {} was valid until {until}, the recording is of {day}",
                shown(&certificate.number),
                traced.instrument.noun()
            );
            found.push(Found::overall(Severity::Warning, message));
        }
    }
    let makes_labels = |of: &&Traceability| of.instrument != Instrument::Sensor;
    let without = instruments.iter().filter(makes_labels);
    let without = without.filter(|of| of.certificate.is_none());
    let mut without: Vec<&str> = without.map(|of| of.instrument.noun()).collect();
    without.sort_unstable();
    without.dedup();
    // Drawn labels are exact.
    if evidence.header.source == Source::Recorded && !without.is_empty() {
        let message = format!(
            "no certificate of the {}: the labels are not traceable",
            without.join(" and the ")
        );
        found.push(Found::overall(Severity::Note, message));
    }
    found
}

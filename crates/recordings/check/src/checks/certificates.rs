//! TAC028: measuring instruments without a certificate, or with a certificate that contradicts the instrument or the days of the labels.

use taceva_core::{Instrument, Traceability};
use taceva_dataset::Source;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC028",
    name: "certificates",
    looks_for: "instruments whose calibration certificate is missing, expired, issued after the recording, or for another serial number",
    hint: "state the certificate of each instrument in the rig file or the map, such as [force.certificate]; then record or import again",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let instruments = &evidence.header.traceability;
    let days = evidence.header.days(evidence.table.t_s());
    let faults = instruments.iter();
    let faults = faults.flat_map(|traced| traced.faults(days.as_ref(), instruments));
    let found = faults.map(|fault| {
        let severity = match fault.is_error() {
            true => Severity::Error,
            false => Severity::Warning,
        };
        Found::overall(severity, fault.to_string())
    });
    let mut found: Vec<Found> = found.collect();
    found.sort_by_key(|found| std::cmp::Reverse(found.severity));
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

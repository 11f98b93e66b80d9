//! TAC029: labels outside the certified range of their instrument.

use taceva_core::{Certificate, Channel, Instrument, counted, shown};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::stamps::share;

pub(super) static CHECK: Check = Check {
    code: "TAC029",
    name: "certified-range",
    looks_for: "labels outside the range of the certificate of their instrument",
    hint: "the uncertainty of these labels is unknown: leave these samples out of claims, or have the instrument calibrated over the whole range",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let mut found = Vec::new();
    // The sensor measures no label.
    for instrument in [Instrument::Force, Instrument::Robot] {
        let of = evidence.header.traceability.iter();
        let of = of.filter(|of| of.instrument == instrument);
        let certificates: Vec<&Certificate> = of.filter_map(|of| of.certificate.as_ref()).collect();
        for (position, channel) in evidence.table.channels().iter().enumerate() {
            found.extend(outside(evidence, &certificates, channel, position));
        }
    }
    found
}

/// Finding about labels of a channel outside the range of its certificates.
fn outside(
    evidence: &Evidence<'_>,
    certificates: &[&Certificate],
    channel: &Channel,
    position: usize,
) -> Option<Found> {
    let stated = { certificates.iter() }.find_map(|certificate| {
        let range = certificate.range.get(channel.name())?;
        (range[0].unit == channel.unit()).then_some((*certificate, range))
    });
    let (certificate, [least, most]) = stated?;
    let labels = evidence.labelled(position);
    let is_covered = |value: f64| {
        let mut certificates = certificates.iter();
        certificates.any(|certificate| certificate.covers(channel.name(), value))
    };
    let is_below = |value: f64| value < least.value;
    let outside = labels.iter().filter(|(_, value)| !is_covered(*value));
    let (below, above): (Vec<_>, Vec<_>) = outside.partition(|(_, value)| is_below(*value));
    let count = below.len() + above.len();
    if count == 0 {
        return None;
    }
    // Samples at rest are near 0, so below each range without negative values.
    let is_rest = above.is_empty() && least.value >= 0.0;
    let severity = match is_rest {
        true => Severity::Note,
        false => Severity::Warning,
    };
    let rows: Vec<usize> = above.iter().chain(&below).map(|(row, _)| *row).collect();
    let message = format!(
        "{count} of {} of {} ({:.1} %) are outside {least} to {most}, the range of the certificate {}: {} below, {} above",
        counted(labels.len(), "label"),
        channel.name(),
        100.0 * share(count, labels.len()),
        shown(&certificate.number),
        below.len(),
        above.len()
    );
    Some(evidence.found(severity, message, &rows))
}

//! TAC040: labels scaled to 0 … 1 or −1 … 1 but declared as newtons or millimetres.

use taceva_core::{Channel, Unit, by_count};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC040",
    name: "normalised-labels",
    looks_for: "forces, torques and places with extremes at exactly 0 and 1, or at -1 and 1: labels that were normalised for training",
    hint: "export the labels as they were measured, or undo the scaling with `scale` and `offset` of the column in the map",
    reads: None,
    find,
};

/// Minimum number of different values from which a range is determined.
const VALUES: usize = 10;
/// Tolerance at the ends of the range, for labels rounded to binary32.
const ROUNDING: f64 = 1e-6;
/// Minimum number of channels with the range of normalised labels, if there are several. A single channel may have this range by chance.
const CHANNELS: usize = 2;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let channels = evidence.table.channels().iter().enumerate();
    let measured: Vec<(usize, &Channel)> = channels
        .filter(|(_, channel)| {
            let unit = channel.unit();
            matches!(
                unit,
                Unit::Newton | Unit::NewtonMillimetre | Unit::Millimetre
            )
        })
        .collect();
    let ends: Vec<(&Channel, [f64; 2])> = measured
        .iter()
        .filter_map(|(position, channel)| Some((*channel, ends(evidence, *position)?)))
        .collect();
    let near = |value: f64, end: f64| (value - end).abs() <= ROUNDING;
    for (low, said) in [(0.0, "0 and 1"), (-1.0, "-1 and 1")] {
        let scaled: Vec<&str> = ends
            .iter()
            .filter(|(_, [least, greatest])| near(*least, low) && near(*greatest, 1.0))
            .map(|(channel, _)| channel.name())
            .collect();
        // A single channel is convincing if it is the only one.
        let enough = scaled.len() >= CHANNELS || (scaled.len() == 1 && ends.len() == 1);
        if enough {
            let message = format!(
                "{} {} at exactly {said}, like normalised labels, but {} declared in {}",
                scaled.join(", "),
                by_count(scaled.len(), "ends", "end"),
                by_count(scaled.len(), "is", "are"),
                units(&ends, &scaled),
            );
            return vec![Found::overall(Severity::Warning, message)];
        }
    }
    Vec::new()
}

/// Units of the channels called `names`, each unit once.
fn units(ends: &[(&Channel, [f64; 2])], names: &[&str]) -> String {
    let mut units: Vec<String> = ends
        .iter()
        .filter(|(channel, _)| names.contains(&channel.name()))
        .map(|(channel, _)| channel.unit().to_string())
        .collect();
    units.dedup();
    units.join(" and ")
}

/// Least and greatest label; `None` if there are too few different values.
fn ends(evidence: &Evidence<'_>, position: usize) -> Option<[f64; 2]> {
    let column = evidence.table.truth(position);
    let mut values: Vec<f64> = (0..column.len())
        .filter_map(|row| column.get(row))
        .collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    (values.len() >= VALUES).then(|| [values[0], values[values.len() - 1]])
}

//! TAC038: two equal label channels, because a column was mapped or recorded twice.

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC038",
    name: "equal-channels",
    looks_for: "two channels that are equal in every sample, or equal except for the sign: a column that the map names twice, or that was \
        written twice",
    hint: "name each column only once in the map; `taceva import --explain` shows the column of each channel",
    reads: None,
    find,
};

/// Minimum number of samples. In fewer samples, two channels may be equal by chance.
const LEAST: usize = 5;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let channels = evidence.table.channels().as_slice();
    let mut found = Vec::new();
    for (position, channel) in channels.iter().enumerate() {
        for (other, other_channel) in channels.iter().enumerate().skip(position + 1) {
            if channel.unit() != other_channel.unit() {
                continue;
            }
            let Some((count, sign)) = equal(evidence, position, other) else {
                continue;
            };
            let (one, other) = (channel.name(), other_channel.name());
            let how = match sign > 0.0 {
                true => "are equal",
                false => "are equal except for their sign",
            };
            let from = source(evidence, one)
                .zip(source(evidence, other))
                .filter(|(one, other)| one == other)
                .map(|(column, _)| {
                    format!(": both are read from `{}`", taceva_core::shown(&column))
                })
                .unwrap_or_default();
            found.push(Found::overall(
                Severity::Warning,
                format!("{one} and {other} {how} in all {count} samples{from}"),
            ));
        }
    }
    found
}

/// Number of samples with both labels, and the sign of their ratio: 1 for equal labels, −1 for opposite labels. `None` if their magnitudes differ in
/// a sample, if the labels never change, or for too few samples.
fn equal(evidence: &Evidence<'_>, one: usize, other: usize) -> Option<(usize, f64)> {
    let (one, other) = (evidence.table.truth(one), evidence.table.truth(other));
    let pairs: Vec<(f64, f64)> = (0..one.len())
        .filter_map(|row| Some((one.get(row)?, other.get(row)?)))
        .collect();
    let first = pairs.first()?;
    let varies = pairs.iter().any(|pair| (pair.0 - first.0).abs() > 0.0);
    if pairs.len() < LEAST || !varies {
        return None;
    }
    [1.0, -1.0]
        .into_iter()
        .find(|sign| {
            pairs
                .iter()
                .all(|(one, other)| (one - sign * other).abs() <= 0.0)
        })
        .map(|sign| (pairs.len(), sign))
}

/// Column from which `label` was imported; `None` if `label` was recorded, or imported from several columns.
fn source(evidence: &Evidence<'_>, label: &str) -> Option<String> {
    let mut columns = evidence.header.columns.iter();
    let column = columns.find(|column| column.label == label)?;
    match column.from.as_slice() {
        [one] => Some(one.clone()),
        _ => None,
    }
}

//! TAC027: zero forces although the pictures show contact, because of a threshold or a clipped range.

use taceva_core::{Field, Unit, counted};

use super::label_lag::correlation;
use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC027",
    name: "dead-zone",
    looks_for: "normal forces set to zero below a threshold: exactly zero in 5 % of the samples, although their pictures change as under load",
    hint: "export the forces before a threshold or a clip at zero is applied; otherwise drop these samples, because a model learns that \
        light contact has no force",
    reads: Some(Field::Frame),
    find,
};

/// Minimum number of samples with zero force and a picture that shows contact. They must also be at least one in `SHARE` of all samples.
const LEAST: usize = 10;
const SHARE: usize = 20;
/// Minimum correlation of nonzero forces with picture changes, which shows that the pictures depend on the load.
const CLEAR: f64 = 0.7;
/// Picture change that shows contact, on a scale from 0 (change at rest) to 1 (median change with force). The change at rest is the quantile 1 /
/// `AT_REST` of the changes with zero force.
const PRESSED: f64 = 0.25;
const AT_REST: usize = 10;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let channels = table.channels();
    let is_force = |position: &usize| channels.as_slice()[*position].unit() == Unit::Newton;
    let Some(load) = evidence.load().filter(is_force) else {
        return Vec::new();
    };
    let (mut zero, mut loaded) = (Vec::new(), Vec::new());
    for (row, facts) in evidence.frames.iter().enumerate() {
        // Without a picture of rest the change by contact is unknown.
        let change = facts.as_ref().and_then(|facts| facts.distance);
        let Some((change, force)) = change.zip(table.truth(load).get(row)) else {
            continue;
        };
        match force.abs() > 0.0 {
            true => loaded.push((change, force.abs())),
            false => zero.push((row, change)),
        }
    }
    let changes = loaded.iter().map(|(change, _)| *change);
    let follows = correlation(changes.clone(), loaded.iter().map(|(_, force)| *force));
    if zero.len() < LEAST || loaded.len() < LEAST || follows < CLEAR {
        return Vec::new();
    }
    let rest = ranked(zero.iter().map(|(_, change)| *change), AT_REST);
    let usual = ranked(changes, 2);
    let pressed_from = rest + PRESSED * (usual - rest);
    let pressed: Vec<usize> = zero
        .iter()
        .filter(|(_, change)| *change > pressed_from)
        .map(|(row, _)| *row)
        .collect();
    if usual <= rest || pressed.len() < LEAST || pressed.len() * SHARE < zero.len() + loaded.len() {
        return Vec::new();
    }
    let message = format!(
        "{} is exactly 0 in {}, but {} of their pictures change as under load (over {:.0} % of the median change of the other {})",
        channels.as_slice()[load].name(),
        counted(zero.len(), "sample"),
        pressed.len(),
        100.0 * PRESSED,
        loaded.len()
    );
    vec![evidence.found(Severity::Warning, message, &pressed)]
}

/// Quantile 1 / `parts` of `numbers`; 0 for no numbers.
fn ranked(numbers: impl Iterator<Item = f64>, parts: usize) -> f64 {
    let mut sorted: Vec<f64> = numbers.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / parts).copied().unwrap_or(0.0)
}

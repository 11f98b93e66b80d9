//! TAC018: rows that are declared as without contact but have contact.

use taceva_core::Field;

use super::pressed_reference::{SUSPECT, rank_correlation};
use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::signal_facts::SignalFacts;

pub(super) static CHECK: Check = Check {
    code: "TAC018",
    name: "pressed-rest",
    looks_for: "rows of `rest` with a load above a tenth of the greatest, or with a mean that resembles deep presses more than light presses",
    hint: "name rows in `rest` of [signals] in which nothing touches the sensor; differences from pressed rows hide the press",
    reads: Some(Field::Signals),
    find,
};

/// Fraction of the greatest load above which a row counts as pressed.
const SHARE: f64 = 0.1;
/// Minimum number of samples for a rank correlation.
const LEAST: usize = 10;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let (Some(facts), Some(load)) = (evidence.signals, evidence.load()) else {
        return Vec::new();
    };
    [
        loaded(evidence, facts, load),
        resembling(evidence, facts, load),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Finds rows that the map declares as without contact but whose label shows a load.
fn loaded(evidence: &Evidence<'_>, facts: &SignalFacts, load: usize) -> Option<Found> {
    let column = evidence.table.truth(load);
    let all = (0..column.len()).filter_map(|row| column.get(row));
    let greatest = all.fold(0.0, |greatest: f64, value| greatest.max(value.abs()));
    let is_pressed = |row: &usize| {
        let value = column.get(*row);
        value.is_some_and(|value| value.abs() > SHARE * greatest)
    };
    let rows = facts.rest_rows.iter().copied();
    let pressed: Vec<usize> = rows.filter(is_pressed).collect();
    let channel = &evidence.table.channels().as_slice()[load];
    let first = column.get(*pressed.first()?)?;
    let message = format!(
        "{} of {} rows of `rest` have a {channel} above a tenth of the greatest, {greatest} {unit}, such as {first} {unit}",
        pressed.len(),
        facts.rest_rows.len(),
        unit = channel.unit(),
    );
    Some(evidence.found(Severity::Warning, message, &pressed))
}

/// Finds signals that are nearer to their mean without contact, the greater the load is.
fn resembling(evidence: &Evidence<'_>, facts: &SignalFacts, load: usize) -> Option<Found> {
    let column = evidence.table.truth(load);
    let rows = facts.distance.iter().enumerate();
    let pairs: Vec<(f64, f64)> = rows
        .filter_map(|(row, distance)| Some((column.get(row)?.abs(), *distance)))
        .collect();
    if pairs.len() < LEAST {
        return None;
    }
    let correlation = rank_correlation(&pairs);
    (correlation <= SUSPECT).then(|| {
        let name = evidence.table.channels().as_slice()[load].name();
        let message = format!(
            "samples of greater {name} are more similar to the mean of `rest` (rank correlation {correlation:.2}, n {})",
            pairs.len()
        );
        Found::overall(Severity::Warning, message)
    })
}

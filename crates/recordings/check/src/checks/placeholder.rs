//! TAC005: zeros that mean "not measured".

use taceva_core::Unit;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC005",
    name: "placeholder-zeros",
    looks_for: "samples whose forces, or whose labels, are all exactly zero",
    hint: "a transducer at rest reads noise, not zero; drop such rows with [drop] placeholders in the map",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let channels = table.channels().iter().enumerate();
    let forces: Vec<usize> = channels
        .filter(|(_, channel)| channel.unit() == Unit::Newton)
        .map(|(position, _)| position)
        .collect();
    let (kind, positions) = match forces.len() {
        0 | 1 => ("labels", (0..table.channels().len()).collect()),
        _ => ("forces", forces),
    };
    if positions.len() < 2 {
        return Vec::new();
    }
    let is_zero = |row: usize| {
        let mut values = positions
            .iter()
            .map(|&position| table.truth(position).get(row));
        values.all(|value| value.is_some_and(|value| value.abs() <= 0.0))
    };
    let rows: Vec<usize> = (0..table.rows()).filter(|&row| is_zero(row)).collect();
    if rows.is_empty() {
        return Vec::new();
    }
    let message = format!(
        "{} of {} samples have all {kind} exactly zero",
        rows.len(),
        table.rows()
    );
    vec![evidence.found(Severity::Warning, message, &rows)]
}

//! TAC009: a channel that never changes.

use super::evidence::Evidence;
use super::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC009",
    name: "stuck-channel",
    looks_for: "channels with the same value in every sample",
    hint: "leave the channel out of the map: R² is undefined on it, and its error says nothing",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let stuck = |position: usize| -> Option<f64> {
        let column = table.truth(position);
        let mut values = (0..column.len()).filter_map(|row| column.get(row));
        let first = values.next()?;
        let mut others = values.peekable();
        others.peek()?;
        others
            .all(|value| value.to_bits() == first.to_bits())
            .then_some(first)
    };
    let channels = table.channels().iter().enumerate();
    channels
        .filter_map(|(position, channel)| {
            let value = stuck(position)?;
            let message = format!("{channel} is {value} {} in every sample", channel.unit());
            Some(Found::overall(Severity::Warning, message))
        })
        .collect()
}

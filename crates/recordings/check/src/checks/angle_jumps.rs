//! TAC042: angles that jump by more than half a turn, because they wrap around or describe a rotation ambiguously.

use taceva_core::{Channel, Unit};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC042",
    name: "angle-jumps",
    looks_for: "angles that jump by more than half a turn between neighbouring samples, without `period` or `rotation` in the map",
    hint: "for an angle that wraps around, add `period = 360` (6.283185307179586 in rad) to the channel in the map; for a component of a rotation vector, add `rotation = [\"Rx\", \"Ry\", \"Rz\"]`",
    reads: None,
    find,
};

/// Maximum change of an angle between two samples, degrees.
const HALF_TURN: f64 = 180.0;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let channels = evidence.table.channels().iter().enumerate();
    let angles = channels.filter(|(_, channel)| {
        let mut parts = evidence.header.rotations.iter().flatten();
        channel.unit() == Unit::Degree
            && channel.period().is_none()
            && !parts.any(|part| part == channel.name())
    });
    angles
        .filter_map(|(position, channel)| of_channel(evidence, position, channel))
        .collect()
}

fn of_channel(evidence: &Evidence<'_>, position: usize, channel: &Channel) -> Option<Found> {
    let rows = evidence.labelled(position);
    let jumps: Vec<(usize, f64)> = rows
        .windows(2)
        .map(|pair| (pair[1].0, (pair[1].1 - pair[0].1).abs()))
        .filter(|(_, jump)| *jump > HALF_TURN)
        .collect();
    let greatest = jumps.iter().map(|(_, jump)| *jump).fold(0.0, f64::max);
    let behind: Vec<usize> = jumps.iter().map(|(row, _)| *row).collect();
    let first = behind.first()?;
    let message = format!(
        "{channel} jumps by more than half a turn between {} of {} neighbouring samples (largest jump {greatest:.1} degrees), first in row \
         {}",
        jumps.len(),
        rows.len() - 1,
        first + 1
    );
    Some(evidence.found(Severity::Note, message, &behind))
}

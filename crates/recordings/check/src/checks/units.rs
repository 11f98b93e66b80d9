//! TAC001: labels whose magnitude contradicts their declared unit.

use taceva_import::magnitude_suspicion;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC001",
    name: "units-by-magnitude",
    looks_for: "labels too large or too small for their unit",
    hint: "set the unit of the labels in the map as the recording program wrote them. N, gf and mN are often confused, as are mm and m. If positions are those of a robot, subtract the place of the gel by `offset`",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let channels = evidence.table.channels().iter().enumerate();
    channels
        .filter_map(|(position, channel)| {
            let column = evidence.table.truth(position);
            let values = (0..column.len()).filter_map(|row| column.get(row));
            let suspicion = magnitude_suspicion(channel, values)?;
            Some(Found::overall(Severity::Warning, suspicion.to_string()))
        })
        .collect()
}

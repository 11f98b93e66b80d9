//! TAC011: samples without a label or without a frame.

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC011",
    name: "missing",
    looks_for: "samples that lack a label or a frame that other samples have",
    hint: "drop these samples in the map if they are useless; commands that need the missing part skip and count them",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let about = |what: &str, rows: Vec<usize>| {
        let message = format!("{} of {} samples have no {what}", rows.len(), table.rows());
        (!rows.is_empty()).then(|| evidence.found(Severity::Note, message, &rows))
    };
    let mut found: Vec<Found> = Vec::new();
    for (position, channel) in table.channels().iter().enumerate() {
        let column = table.truth(position);
        let rows = (0..column.len())
            .filter(|&row| column.get(row).is_none())
            .collect();
        found.extend(about(channel.name(), rows));
    }
    if evidence.header.frames.is_some() {
        let rows = (0..table.rows())
            .filter(|&row| table.frames()[row].is_none())
            .collect();
        found.extend(about("frame", rows));
    }
    found
}

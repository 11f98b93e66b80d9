//! TAC025: frames of a single colour, and signals that are all zero.

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(crate) static CHECK: Check = Check {
    code: "TAC025",
    name: "blank-samples",
    looks_for: "frames of a single colour, and rows of signals that are all zero: arrays that were never filled",
    hint: "the array was allocated but never filled: record again, or drop these rows",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let frames = evidence.frames.iter().enumerate();
    let blank: Vec<usize> = frames
        .filter_map(|(row, facts)| facts.as_ref()?.is_flat.then_some(row))
        .collect();
    let total = evidence.frames.iter().flatten().count();
    let mut found = Vec::new();
    if !blank.is_empty() {
        let message = format!("{} of {total} frames have a single colour", blank.len());
        found.push(evidence.found(Severity::Warning, message, &blank));
    }
    let empty = evidence.signals.map(|signals| &signals.zero_rows);
    if let Some(rows) = empty.filter(|rows| !rows.is_empty()) {
        let message = format!(
            "{} of {} samples have signals that are all exactly 0",
            rows.len(),
            evidence.table.rows()
        );
        found.push(evidence.found(Severity::Warning, message, rows));
    }
    found
}

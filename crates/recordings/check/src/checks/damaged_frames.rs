//! TAC020: pictures that can be decoded although parts are missing or corrupt.

use taceva_core::Field;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(crate) static CHECK: Check = Check {
    code: "TAC020",
    name: "damaged-frames",
    looks_for: "truncated or damaged JPEG files, which decoders fill with gray or with guesses",
    hint: "copy these pictures again from their source, or drop their rows, and import again",
    reads: Some(Field::Frame),
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let [(_, first), ..] = evidence.damaged else {
        return Vec::new();
    };
    let rows: Vec<usize> = evidence.damaged.iter().map(|(row, _)| *row).collect();
    let total = evidence.table.frames().iter().flatten().count();
    let message = format!(
        "{} of {total} frames are damaged; the first: {first}",
        rows.len()
    );
    vec![evidence.found(Severity::Error, message, &rows)]
}

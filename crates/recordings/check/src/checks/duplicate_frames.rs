//! TAC002: the same picture under several names, from a stuck camera or a copied file.

use std::collections::BTreeMap;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(crate) static CHECK: Check = Check {
    code: "TAC002",
    name: "duplicate-frames",
    looks_for: "frames that are byte-identical files",
    hint: "record at the true rate of the camera if it repeats frames; drop copies with other labels, which are contradictory training data",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let mut first: BTreeMap<_, usize> = BTreeMap::new();
    let mut again = Vec::new();
    let frames = evidence.table.frames().iter().enumerate();
    for (row, entry) in frames.filter_map(|(row, entry)| Some((row, entry.as_ref()?))) {
        if *first.entry(entry.digest).or_insert(row) != row {
            again.push(row);
        }
    }
    if again.is_empty() {
        return Vec::new();
    }
    let total = evidence.table.frames().iter().flatten().count();
    let message = format!(
        "{} of {total} frames repeat an earlier frame, byte for byte",
        again.len()
    );
    vec![evidence.found(Severity::Warning, message, &again)]
}

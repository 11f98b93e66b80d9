//! TAC044: the same picture in two views of a sample, because one camera serves two fingers or a path was copied.

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC044",
    name: "equal-views",
    looks_for: "samples whose pictures of two views are byte-identical files",
    hint: "two cameras never take the same picture: name a different column, array or clip for each view in the map, or remove one view",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let views = evidence.table.views();
    let mut found = Vec::new();
    for (at, one) in views.iter().enumerate() {
        for other in &views[at + 1..] {
            let pairs = one.frames().iter().zip(other.frames()).enumerate();
            let equal = pairs.filter_map(|(row, (own, theirs))| {
                let is_equal = own.as_ref()?.digest == theirs.as_ref()?.digest;
                is_equal.then_some(row)
            });
            let equal: Vec<usize> = equal.collect();
            let rows = evidence.table.rows();
            let severity = match equal.len() {
                0 => continue,
                all if all == rows => Severity::Error,
                _ => Severity::Warning,
            };
            let message = format!(
                "the pictures of `{}` and `{}` are the same file in {} of {rows} samples",
                one.name(),
                other.name(),
                equal.len()
            );
            found.push(evidence.found(severity, message, &equal));
        }
    }
    found
}

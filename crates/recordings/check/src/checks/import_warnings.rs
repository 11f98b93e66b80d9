//! TAC043: warnings issued when the recording was imported, or by the devices that made it.

use taceva_core::shown;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC043",
    name: "import-warnings",
    looks_for: "warnings of the import or of the devices, from the header of the recording",
    hint: "correct the map or the device as the warning says, and import or record again; an import without warnings clears this finding",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    // TAC036 states the same cause with its rows.
    let is_stated = !super::repeated_stamps::find(evidence).is_empty();
    let warnings = evidence.header.warnings.iter();
    warnings
        .filter(|warning| !(is_stated && warning.starts_with("repeated-stamps: ")))
        .map(|warning| Found::overall(Severity::Warning, shown(warning).to_string()))
        .collect()
}

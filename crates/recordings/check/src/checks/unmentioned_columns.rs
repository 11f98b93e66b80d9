//! TAC014: unused columns of the imported table, especially columns with quality ratings of the rows.

use taceva_core::shown;
use taceva_dataset::internal::first_names;
use taceva_dataset::names_quality;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC014",
    name: "unmentioned-columns",
    looks_for: "columns of the imported table that no key of its map names, above all quality flags",
    hint: "import again with a map that names the quality columns under [drop] or [attributes]",
    reads: None,
    find,
};

/// Maximum number of unused columns named in a note.
const NAMED: usize = 12;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let columns = &evidence.header.unmentioned_columns;
    let (judging, others): (Vec<&String>, Vec<&String>) =
        columns.iter().partition(|name| names_quality(name));
    let mut found: Vec<Found> = judging
        .into_iter()
        .map(|name| Found::overall(Severity::Warning, unread(name)))
        .collect();
    if !others.is_empty() {
        let names: Vec<String> = others.iter().map(|name| shown(name).to_string()).collect();
        let named = first_names(&names, NAMED);
        let message = format!("columns of the table that no key of the map names: {named}");
        found.push(Found::overall(Severity::Note, message));
    }
    found
}

/// Warning about a column that may contain quality ratings, with the map entry that would use the column.
fn unread(name: &str) -> String {
    let name = shown(name);
    format!(
        "`{name}` of the table may mark bad samples, but no key of the map names it: `[drop] column = \"{name}\", quality_flags = [\"…\"]` \
         drops samples with these words"
    )
}

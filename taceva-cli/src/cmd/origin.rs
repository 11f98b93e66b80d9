//! Origins of the samples of a table.

use std::collections::BTreeSet;

use taceva_import::CsvTable;

use super::results;

/// Column with the origin of each sample.
const SOURCE: &str = "source";
/// Origin of samples without a stated origin.
const UNKNOWN: &str = "unknown";

/// Origins of the samples, from the column `source` or from the result beside the table.
pub(super) fn of(table: &CsvTable) -> anyhow::Result<Vec<String>> {
    if !table.has(SOURCE) {
        let source = results::source_of(table.path())?;
        return Ok(vec![source.unwrap_or_else(|| UNKNOWN.to_owned())]);
    }
    let stated = table.text(SOURCE)?.into_iter();
    let stated = stated.map(|source| if source.is_empty() { UNKNOWN } else { source });
    let distinct: BTreeSet<&str> = stated.collect();
    Ok(distinct.into_iter().map(str::to_owned).collect())
}

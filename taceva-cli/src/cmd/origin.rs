//! Origins of the samples of a table.

use std::path::Path;

use taceva_evaluate::{UNKNOWN_ORIGIN, stated_origins};
use taceva_import::CsvTable;

use super::results;

/// Origins of the samples, from the column `source` or from the result next to the table.
pub(super) fn of(table: &CsvTable) -> anyhow::Result<Vec<String>> {
    match stated_origins(table)? {
        Some(origins) => Ok(origins.into_iter().collect()),
        None => Ok(vec![beside(table.path())?]),
    }
}

/// Origin of the samples of the table at `path`, from the result next to it.
pub(super) fn beside(path: &Path) -> anyhow::Result<String> {
    let source = results::source_of(path)?;
    Ok(source.unwrap_or_else(|| UNKNOWN_ORIGIN.to_owned()))
}

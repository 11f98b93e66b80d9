//! Origins of the samples of a table.

use std::collections::BTreeSet;

use taceva_import::CsvTable;

use crate::error::EvaluateError;

/// Column with the origin of each sample.
const SOURCE: &str = "source";
/// Origin of samples without a stated origin.
pub const UNKNOWN_ORIGIN: &str = "unknown";

/// Origins in the column `source` of a table; `None` without the column.
///
/// ```
/// use taceva_evaluate::{CsvTable, UNKNOWN_ORIGIN, stated_origins};
/// let table = CsvTable::of_cells("t.csv".as_ref(), &["source"], [["recorded"], [""]])?;
/// let origins = stated_origins(&table)?.unwrap_or_default();
/// assert!(origins.into_iter().eq(["recorded", UNKNOWN_ORIGIN]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`EvaluateError::Table`] for a table that cannot be read.
pub fn stated_origins(table: &CsvTable) -> Result<Option<BTreeSet<String>>, EvaluateError> {
    if !table.has(SOURCE) {
        return Ok(None);
    }
    let stated = table.text(SOURCE)?.into_iter();
    let stated = stated.map(|source| match source.is_empty() {
        true => UNKNOWN_ORIGIN.to_owned(),
        false => source.to_owned(),
    });
    Ok(Some(stated.collect()))
}

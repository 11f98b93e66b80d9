//! Units of columns that the file says to be times: its type is believed, and no map scales them again.

use taceva_core::SourceUnit;

use super::columns::base_of;
use crate::foreign::ForeignTable;
use taceva_dataset::{DatasetError, Place};

/// Checks that `unit`, which the map states of the column `name` of `table`, is seconds where the file itself says that it holds times.
pub(super) fn check(
    table: &ForeignTable,
    name: &str,
    unit: &SourceUnit,
) -> Result<(), DatasetError> {
    let Some(counted) = table.time_unit(base_of(name)) else {
        return Ok(());
    };
    match unit.symbol() {
        "s" => Ok(()),
        stated => Err(DatasetError::Table {
            place: Place::file(table.path()).in_column(name),
            problem: format!(
                "the file says that these are times, counted in {counted}, and they are read in seconds by that; the map says `unit = \"{stated}\"`: \
                 write `unit = \"s\"`"
            ),
        }),
    }
}

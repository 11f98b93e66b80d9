//! Units of columns that the file says to be times: its type is believed, and no map scales them again.

use taceva_core::SourceUnit;

use super::Sources;
use super::columns::base_of;
use crate::error::{DatasetError, Place};
use crate::foreign::ForeignTable;

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
            place: Place {
                column: Some(name.to_owned()),
                ..Place::file(table.path())
            },
            problem: format!(
                "the file says that these are times, counted in {counted}, and they are read in seconds by that; the map says `unit = \"{stated}\"`: \
                 write `unit = \"s\"`"
            ),
        }),
    }
}

impl Sources<'_> {
    /// Checks that every unit that the map states of a column agrees with what the file says of it.
    pub(super) fn check_units(&self) -> Result<(), DatasetError> {
        let columns = self.map.columns.iter();
        let columns = columns.map(|column| (column.from.as_str(), &column.unit));
        let times = self.map.time.iter();
        let times = times.map(|time| (time.column.as_str(), &time.unit));
        let signals = self.map.signals.iter().flat_map(|signals| {
            let names = signals.columns().iter();
            names.map(|name| (name.as_str(), &signals.unit))
        });
        for (name, unit) in columns.chain(times).chain(signals) {
            match self.joined_column(name) {
                None => check(&self.main, name, unit)?,
                Some((joined, column)) => joined.check_unit(column, unit)?,
            }
        }
        Ok(())
    }
}

//! Times that a file marks as times or writes as text. Such times are always converted to seconds, without a scale of the map.

use taceva_core::SourceUnit;

use super::columns::base_of;
use crate::error::{ImportError, Place, table_error};
use crate::foreign::ForeignTable;
use crate::import::map::TimeMap;
use crate::import::warning::ImportWarning;
use crate::instant::TextInstant;
use taceva_dataset::internal::shown;

/// Checks that the map states seconds for the column `name` if the file marks the column as times.
pub(super) fn check(
    table: &ForeignTable,
    name: &str,
    unit: &SourceUnit,
) -> Result<(), ImportError> {
    let Some(counted) = table.time_unit(base_of(name)) else {
        return Ok(());
    };
    match unit.symbol() {
        "s" => Ok(()),
        stated => Err(table_error!(
            Place::file(table.path()).in_column(name),
            "the file states times in {counted}, which are converted to seconds, but the map has `unit = \"{stated}\"`: write `unit = \"s\"`"
        )),
    }
}

/// Times from a column of texts.
pub(super) struct TextTimes {
    /// Seconds as decimal text; empty for an empty cell.
    pub(super) seconds: Vec<String>,
    /// True if a text with a date states no time zone, and the map states none either.
    has_no_zone: bool,
    /// Number of midnights between the first and the last time of day.
    midnights: i64,
}

/// Decrease of the time of day between rows that indicates a midnight, s.
const HALF_A_DAY_S: i64 = 43_200;

impl TextTimes {
    /// Parses the times in `cells`; `None` if the cells are numbers.
    ///
    /// # Errors
    /// First row whose time has a different form than the previous rows, with the problem.
    pub(super) fn of(
        cells: &[String],
        map: &TimeMap,
    ) -> Result<Option<TextTimes>, (usize, String)> {
        let first = cells.iter().find(|cell| !cell.trim().is_empty());
        let first = first.and_then(|cell| TextInstant::parse(cell));
        let Some(first) = first else {
            return Ok(None);
        };
        if map.unit.symbol() != "s" {
            let problem = format!(
                "times as text are converted to seconds, but the map has `unit = \"{}\"`: write `unit = \"s\"`",
                map.unit.symbol()
            );
            return Err((0, problem));
        }
        let mut times = TextTimes {
            seconds: Vec::with_capacity(cells.len()),
            has_no_zone: !first.is_of_day() && !first.has_zone() && map.zone_s.is_none(),
            midnights: 0,
        };
        let mut last = 0;
        for (row, cell) in cells.iter().enumerate() {
            if cell.trim().is_empty() {
                times.seconds.push(String::new());
                continue;
            }
            let instant = TextInstant::parse(cell).filter(|instant| {
                instant.is_of_day() == first.is_of_day() && instant.has_zone() == first.has_zone()
            });
            let instant = instant.ok_or_else(|| {
                let problem = format!(
                    "`{}` has another form than the times before it: either all have a date and a time zone, or none has",
                    shown(cell)
                );
                (row, problem)
            })?;
            if instant.is_of_day() {
                times.midnights += i64::from(last - instant.second_of_day() > HALF_A_DAY_S);
                last = instant.second_of_day();
            }
            times
                .seconds
                .push(instant.seconds(map.zone_s, times.midnights));
        }
        Ok(Some(times))
    }

    /// Warnings about the times of `column`: a missing time zone, or midnights.
    pub(super) fn warnings(&self, column: &str, is_unix: bool) -> Vec<ImportWarning> {
        let mut warnings = Vec::new();
        if self.has_no_zone && is_unix {
            warnings.push(ImportWarning::ZoneUnstated {
                column: column.to_owned(),
            });
        }
        if let Ok(days) = u64::try_from(self.midnights)
            && days > 0
        {
            warnings.push(ImportWarning::Midnight {
                column: column.to_owned(),
                days,
            });
        }
        warnings
    }
}

//! Compares units and packing stated by a file with the map. A contradiction indicates a wrong factor.

use taceva_core::SourceUnit;

use super::Sources;
use super::columns::base_of;
use super::times;
use crate::error::{ImportError, Place};
use crate::foreign::{ForeignTable, Stated};
use crate::unit_suffix::UnitSuffix;

/// Interpretation of a column by a map: unit, scale and quantity.
#[derive(Clone, Copy)]
pub(super) struct Reading<'a> {
    pub(super) unit: &'a SourceUnit,
    /// True if the map applies an offset or a scale.
    pub(super) is_moved: bool,
    pub(super) of: Of,
}

/// Kind of the numbers in a column.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// Labels, for which the map may set a scale.
    Labels,
    /// Times or taxel values, for which the map may set no scale.
    Others,
}

/// Checks that `reading` agrees with the attributes of the column `name` in `table`.
pub(super) fn check(
    table: &ForeignTable,
    name: &str,
    reading: Reading<'_>,
) -> Result<(), ImportError> {
    times::check(table, name, reading.unit)?;
    let base = if table.has(name) { name } else { base_of(name) };
    // Typed times are in seconds, whatever their name.
    if reading.is_moved || !table.has(base) || table.time_unit(base).is_some() {
        return Ok(());
    }
    let stated = table.stated(base);
    let mut stated = stated.iter();
    let found = stated.find_map(|stated| problem(stated, reading.unit, reading.of));
    let names = table.names_with_units(name, base);
    match found.or_else(|| problem_of_names(names.iter().map(String::as_str), reading.unit)) {
        None => Ok(()),
        Some(problem) => Err(ImportError::table(
            Place::file(table.path()).in_column(name),
            problem,
        )),
    }
}

/// Problem of the first of `names` that states a unit of the quantity of `unit`; `None` if the units agree, or no name states one. The name of an
/// element precedes the name of its column.
pub(in crate::import) fn problem_of_names<'n>(
    names: impl IntoIterator<Item = &'n str>,
    unit: &SourceUnit,
) -> Option<String> {
    for name in names {
        let Some(suffix) = UnitSuffix::of(name) else {
            continue;
        };
        if let Some(problem) = suffix.contradiction(unit) {
            return Some(problem);
        }
        if suffix.of_quantity(unit.unit()).is_some() {
            return None;
        }
    }
    None
}

/// Symbol of the stated unit, if it has the same quantity as `unit` but a different factor. Other quantities are ignored: an array of forces and
/// torques has one attribute for both.
fn contradicted(stated: &str, unit: &SourceUnit) -> Option<&'static str> {
    let own = SourceUnit::parse(stated.trim()).ok()?;
    let is_other =
        own.unit() == unit.unit() && own.convert(1.0).to_bits() != unit.convert(1.0).to_bits();
    is_other.then(|| own.symbol())
}

/// Contradiction between the map and the attributes of a taxel array; `None` if they agree.
pub(in crate::import) fn problem_of_signals(stated: &Stated, unit: &SourceUnit) -> Option<String> {
    problem(stated, unit, Of::Others)
}

fn problem(stated: &Stated, unit: &SourceUnit, of: Of) -> Option<String> {
    if let Some([factor, added]) = stated.packed {
        let remedy = match of {
            Of::Labels => format!(
                "write `scale = {factor:?}, offset = {:?}`, or `scale = 1` if the numbers need no conversion",
                0.0 - added / factor
            ),
            Of::Others => format!(
                "write them as numbers × {factor:?} + {added:?} without these attributes, or remove the attributes if the numbers need no \
                 conversion"
            ),
        };
        return Some(format!(
            "the numbers of the file are packed (`scale_factor` {factor}, `add_offset` {added}), but the map does not unpack them: {remedy}"
        ));
    }
    contradicted(stated.unit.as_deref()?, unit).map(|own| {
        let remedy = match of {
            Of::Labels => ", or write `scale = 1` if the attribute is wrong",
            Of::Others => "",
        };
        format!(
            "the unit is `{own}` in the file, but `{}` in the map: correct the wrong one{remedy}",
            unit.symbol()
        )
    })
}

impl Sources<'_> {
    /// Checks that the units of the map agree with the files.
    pub(super) fn check_units(&self) -> Result<(), ImportError> {
        let columns = self.map.columns.iter();
        let columns = columns.map(|column| {
            let is_moved = column.is_moved();
            (column.from.as_str(), &column.unit, is_moved, Of::Labels)
        });
        let times = self.map.time.iter();
        let times = times.map(|time| (time.column.as_str(), &time.unit, false, Of::Others));
        let signals = self.map.signals.iter().flat_map(|signals| {
            let names = signals.columns().iter();
            names.map(|name| (name.as_str(), &signals.unit, false, Of::Others))
        });
        let poses = self.map.tasks.iter().flat_map(|own| {
            let columns = own.task.from.iter().zip(&own.units);
            let columns = columns.zip(own.task.columns());
            // An export names its columns like the dataset, whose positions are in mm.
            let columns = columns.filter(|((name, _), stored)| !name.ends_with(stored.as_str()));
            columns.map(|((name, unit), _)| (name.as_str(), unit, false, Of::Others))
        });
        let others = times.chain(signals).chain(poses);
        for (name, unit, is_moved, of) in columns.chain(others) {
            let reading = Reading { unit, is_moved, of };
            match (name.strip_prefix("path."), self.joined_column(name)) {
                (Some(part), _) => self.check_part(part, reading)?,
                (None, None) => check(&self.main, name, reading)?,
                (None, Some((joined, column))) => joined.check(column, reading)?,
            }
        }
        Ok(())
    }

    /// Checks the unit of a number in a path against the name of the number and the letters after it: `Fz{fz:number}mN`.
    fn check_part(&self, part: &str, reading: Reading<'_>) -> Result<(), ImportError> {
        let pattern = self.map.path.as_ref();
        let behind = pattern.and_then(|pattern| pattern.letters_behind(part));
        let with_letters = format!("{part} {}", behind.unwrap_or_default());
        let is_moved = reading.is_moved;
        let problem = problem_of_names([with_letters.as_str(), part], reading.unit);
        match problem.filter(|_| !is_moved) {
            None => Ok(()),
            Some(problem) => Err(ImportError::table(
                Place::file(self.main.path()).in_column(format!("path.{part}")),
                problem,
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(unit: Option<&str>, packed: Option<[f64; 2]>, map: &str) -> Option<String> {
        let stated = Stated {
            unit: unit.map(str::to_owned),
            packed,
        };
        problem(&stated, &SourceUnit::parse(map).expect("known"), Of::Labels)
    }

    #[test]
    fn a_unit_of_the_same_quantity_with_another_factor_contradicts_the_map() {
        assert!(of(Some("mN"), None, "N").is_some_and(|said| said.contains("`mN`")));
        assert_eq!(of(Some("N"), None, "N"), None);
        assert_eq!(of(Some("µT"), None, "uT"), None);
        // A unit of another quantity, and an unknown unit.
        assert_eq!(of(Some("N"), None, "Nm"), None);
        assert_eq!(of(Some("newton"), None, "mN"), None);
        assert_eq!(of(None, None, "mN"), None);
    }

    #[test]
    fn the_name_of_a_number_in_a_cell_counts_before_that_of_its_column() {
        let of = |names: &[&str], map: &str| {
            let unit = SourceUnit::parse(map).expect("known");
            problem_of_names(names.iter().copied(), &unit)
        };
        assert_eq!(of(&["Fz_mN", "state_N"], "mN"), None);
        let problem = of(&["Fz_mN", "state_N"], "N").unwrap_or_default();
        assert!(problem.contains("`mN`"), "{problem}");
        let problem = of(&["Fz", "state_mN"], "N").unwrap_or_default();
        assert!(problem.contains("`mN`"), "{problem}");
        assert_eq!(of(&["Tz_Nm", "state_N"], "Nm"), None);
    }

    #[test]
    fn packed_numbers_are_refused_with_the_scale_and_offset_that_unpack_them() {
        let said = of(None, Some([0.01, 5.0]), "N").expect("refused");
        assert!(said.contains("`scale = 0.01, offset = -500.0`"), "{said}");
    }
}

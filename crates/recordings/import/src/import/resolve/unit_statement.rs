//! What a file says of the unit of a column, and whether its numbers are packed: a map that says otherwise would be wrong by a factor.

use taceva_core::SourceUnit;

use super::Sources;
use super::columns::base_of;
use super::times;
use crate::foreign::{ForeignTable, Stated};
use taceva_dataset::{DatasetError, Place};

/// How a map reads a column.
#[derive(Clone, Copy)]
pub(super) struct Reading<'a> {
    pub(super) unit: &'a SourceUnit,
    /// Whether the map subtracts or multiplies, and so knows what the numbers are.
    pub(super) is_moved: bool,
    pub(super) of: Of,
}

/// What the numbers are to the map.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// Labels, of which it may say a scale.
    Labels,
    /// Times and numbers of taxels, of which it says none.
    Others,
}

/// Checks that `reading`, what the map says of the column `name` of `table`, is not otherwise than the file itself says.
pub(super) fn check(
    table: &ForeignTable,
    name: &str,
    reading: Reading<'_>,
) -> Result<(), DatasetError> {
    times::check(table, name, reading.unit)?;
    let base = match table.has(name) {
        true => name,
        false => base_of(name),
    };
    if reading.is_moved || !table.has(base) {
        return Ok(());
    }
    let stated = table.stated(base);
    let mut stated = stated.iter();
    let found = stated.find_map(|stated| problem(stated, reading.unit, reading.of));
    match found.or_else(|| problem_of_name(base, reading.unit)) {
        None => Ok(()),
        Some(problem) => Err(DatasetError::Table {
            place: Place::file(table.path()).in_column(name),
            problem,
        }),
    }
}

/// Why the map contradicts the unit in brackets at the end of the name of a column: `Fz [mN]`, `depth (um)`.
pub(in crate::import) fn problem_of_name(name: &str, unit: &SourceUnit) -> Option<String> {
    let name = name.trim_end();
    let (close, open) = match name.chars().last()? {
        ']' => (']', '['),
        ')' => (')', '('),
        _ => return None,
    };
    let (_, stated) = name.strip_suffix(close)?.rsplit_once(open)?;
    contradicted(stated, unit).map(|own| {
        format!(
            "its name says `{own}`, the map says `{}`: correct the one that is wrong",
            unit.symbol()
        )
    })
}

/// The unit that is stated, if it is of the same quantity as that of the map and has another factor: an array of forces and torques has one
/// attribute for both.
fn contradicted(stated: &str, unit: &SourceUnit) -> Option<&'static str> {
    let own = SourceUnit::parse(stated.trim()).ok()?;
    let is_other =
        own.unit() == unit.unit() && own.convert(1.0).to_bits() != unit.convert(1.0).to_bits();
    is_other.then(|| own.symbol())
}

/// Why the map contradicts what a file says of an array of numbers of taxels.
pub(in crate::import) fn problem_of_signals(stated: &Stated, unit: &SourceUnit) -> Option<String> {
    problem(stated, unit, Of::Others)
}

fn problem(stated: &Stated, unit: &SourceUnit, of: Of) -> Option<String> {
    if let Some([factor, added]) = stated.packed {
        let remedy = match of {
            Of::Labels => format!(
                "write `scale = {factor:?}, offset = {:?}`, or `scale = 1` if they are what they are",
                0.0 - added / factor
            ),
            Of::Others => format!(
                "write them as numbers × {factor:?} + {added:?} without these attributes, or take the attributes away if they are what they are"
            ),
        };
        return Some(format!(
            "the file says that its numbers are packed (`scale_factor` {factor}, `add_offset` {added}), and the map reads them as they lie: {remedy}"
        ));
    }
    contradicted(stated.unit.as_deref()?, unit).map(|own| {
        let remedy = match of {
            Of::Labels => ", or write `scale = 1` if it is the attribute",
            Of::Others => "",
        };
        format!(
            "the file says that its unit is `{own}`, the map says `{}`: correct the one that is wrong{remedy}",
            unit.symbol()
        )
    })
}

impl Sources<'_> {
    /// Checks that every unit that the map states of a column agrees with what the file says of it.
    pub(super) fn check_units(&self) -> Result<(), DatasetError> {
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
        for (name, unit, is_moved, of) in columns.chain(times).chain(signals) {
            let reading = Reading { unit, is_moved, of };
            match self.joined_column(name) {
                None => check(&self.main, name, reading)?,
                Some((joined, column)) => joined.check(column, reading)?,
            }
        }
        Ok(())
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
        // Of a wrench, and of a unit that nobody knows here.
        assert_eq!(of(Some("N"), None, "Nm"), None);
        assert_eq!(of(Some("newton"), None, "mN"), None);
        assert_eq!(of(None, None, "mN"), None);
    }

    #[test]
    fn a_unit_in_brackets_behind_a_name_contradicts_the_map_likewise() {
        let of = |name: &str, map: &str| {
            problem_of_name(name, &SourceUnit::parse(map).expect("known")).is_some()
        };
        assert!(of("Fz [mN]", "N") && of("depth (um) ", "mm") && of("t(ms)", "s"));
        for (name, map) in [
            ("Fz [mN]", "mN"),
            ("Fz [N]", "Nm"),
            ("ft[1]", "N"),
            ("force (raw)", "N"),
            ("force_mN", "N"),
            ("]", "N"),
        ] {
            assert!(!of(name, map), "{name}");
        }
    }

    #[test]
    fn packed_numbers_are_refused_with_the_scale_and_offset_that_unpack_them() {
        let said = of(None, Some([0.01, 5.0]), "N").expect("refused");
        assert!(said.contains("`scale = 0.01, offset = -500.0`"), "{said}");
    }
}

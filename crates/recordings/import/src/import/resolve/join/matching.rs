//! Match rules between rows of two tables: equal keys, near times.

use crate::csv_table::number;
use crate::error::{ImportError, Place, table_error};
use crate::foreign::cell_list;
use crate::import::map::{Pick, TimeJoin, TimeMap};
use taceva_dataset::internal::shown;

/// Maximum rounding error of seconds since 1970 as `f64`, s.
const ROUNDING_S: f64 = 1e-6;

/// Position of a match in a joined table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum At {
    Nowhere,
    Row(usize),
    /// Between two rows, with the weight of the second row, from 0 to 1.
    Between([usize; 2], f64),
}

/// Normalises a key of a join: 3, 3.0 and `np.int64(3)` become equal. Integers are compared exactly at any length. A number with an exponent may be
/// an id and counts as text.
pub(super) fn comparable(cell: &str) -> String {
    let cell = cell_list::plain(cell.trim());
    let whole = cell.strip_suffix(".0").unwrap_or(cell);
    if let Ok(number) = whole.parse::<i128>() {
        return number.to_string();
    }
    match number::number(cell) {
        Ok(Some(number)) if !cell.contains(['e', 'E']) => format!("{:?}", number + 0.0),
        _ => cell.to_owned(),
    }
}

/// Time in a cell, s; `None` if the cell is empty.
pub(super) fn seconds(
    cell: &str,
    time: &TimeMap,
    place: impl Fn() -> Place,
) -> Result<Option<f64>, ImportError> {
    number::number_in_unit(cell, &time.unit)
        .map_err(|problem| table_error!(place(), "`{}`: {problem}", shown(cell)))
}

/// Match for the time `instant`, s, among the sorted `times`, and its time difference, s; `None` if no match is within the tolerance.
pub(super) fn about(times: &[(f64, usize)], instant: f64, join: &TimeJoin) -> Option<(At, f64)> {
    let behind = times.partition_point(|(time, _)| *time <= instant);
    let before = behind.checked_sub(1).map(|at| times[at]);
    let after = times.get(behind).copied();
    let gap = |(time, _): (f64, usize)| (time - instant).abs();
    let one = |found: (f64, usize)| (At::Row(found.1), gap(found));
    let found = match (join.pick, before, after) {
        (_, Some(before), _) if gap(before) == 0.0 => one(before),
        (Pick::Before, before, _) => one(before?),
        (Pick::Linear, before, after) => {
            let (before, after) = before.zip(after)?;
            let share = (instant - before.0) / (after.0 - before.0);
            (
                At::Between([before.1, after.1], share),
                gap(before).max(gap(after)),
            )
        }
        (Pick::Nearest, Some(before), Some(after)) => match gap(after) < gap(before) {
            true => one(after),
            false => one(before),
        },
        (Pick::Nearest, before, after) => one(before.or(after)?),
    };
    (found.1 <= join.tolerance_s() + ROUNDING_S).then_some(found)
}

#[cfg(test)]
mod tests {
    use taceva_core::SourceUnit;

    use super::*;
    use crate::import::map::Lag;

    fn join(pick: Pick, tolerance_s: f64) -> TimeJoin {
        TimeJoin {
            time: TimeMap::new("t", SourceUnit::parse("s").expect("known")),
            pick,
            tolerance_ms: tolerance_s * 1e3,
            lag: Lag::Fixed(0.0),
        }
    }

    #[test]
    fn what_belongs_to_an_instant_is_found_by_the_pick_and_the_tolerance() {
        let times = [(1.0, 10), (2.0, 11), (4.0, 12)];
        let of = |pick, instant| about(&times, instant, &join(pick, 1.0)).map(|(at, _)| at);
        assert_eq!(of(Pick::Nearest, 1.4), Some(At::Row(10)));
        assert_eq!(of(Pick::Nearest, 1.6), Some(At::Row(11)));
        // Equally near to both: the earlier row.
        assert_eq!(of(Pick::Nearest, 1.5), Some(At::Row(10)));
        assert_eq!(of(Pick::Nearest, 0.5), Some(At::Row(10)));
        assert_eq!(of(Pick::Nearest, 5.5), None);
        assert_eq!(of(Pick::Before, 1.9), Some(At::Row(10)));
        assert_eq!(of(Pick::Before, 0.9), None);
        assert_eq!(of(Pick::Linear, 1.25), Some(At::Between([10, 11], 0.25)));
        assert_eq!(of(Pick::Linear, 2.0), Some(At::Row(11)));
        // A neighbour is further away than the tolerance.
        assert_eq!(of(Pick::Linear, 2.5), None);
        assert_eq!(about(&[], 1.0, &join(Pick::Nearest, 9.0)), None);
    }

    #[test]
    fn keys_are_compared_as_numbers_where_they_are_numbers() {
        assert_eq!(comparable("3"), comparable(" 3.0"));
        assert_eq!(comparable("np.int64(3)"), comparable("3"));
        assert_eq!(comparable("-0"), comparable("0"));
        assert_eq!(comparable("2.50"), comparable("2.5"));
        assert_ne!(
            comparable("1700000000000000001"),
            comparable("1700000000000000003")
        );
        assert_ne!(comparable("12e4"), comparable("120000"));
        assert_ne!(comparable("a3"), comparable("3"));
    }
}

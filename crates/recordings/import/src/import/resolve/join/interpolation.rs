//! Interpolates a cell between two rows of a joined table: numbers linearly, angles and rotations along the shortest path.

use taceva_core::Unit;

use crate::csv_table::number;
use crate::error::{ImportError, table_error};
use crate::foreign::ForeignTable;
use crate::import::map::{ImportMap, RotationMap, turn_in};
use crate::import::resolve::cell::cell_of;
use taceva_dataset::internal::shown;

/// Interpolation of one column between two rows.
pub(super) struct Interpolation {
    /// Column of the joined table.
    column: String,
    by: Way,
}

enum Way {
    /// Angle without a declared period.
    Angle {
        channel: String,
        /// Half a turn, in the unit of the cells; the maximum difference between neighbours.
        half_turn: f64,
        /// Whole turn, in the unit of the map.
        turn: f64,
    },
    /// Angle with a period, in the unit of the cells.
    Periodic(f64),
    /// Component of a rotation. The columns have their names in the joined table.
    Rotation {
        map: RotationMap,
        columns: Vec<String>,
        at: usize,
    },
    /// Positions of the classes of a task.
    Classes,
}

/// Maximum angle between two rotations with a unique shortest path, degrees.
const OPPOSITE_DEG: f64 = 179.0;

impl Interpolation {
    /// Interpolations of the columns that the join `name` reads.
    pub(super) fn of_join(map: &ImportMap, name: &str) -> Vec<Interpolation> {
        let own_column = |from: &str| {
            let (join, column) = from.split_once('.')?;
            (join == name).then(|| column.to_owned())
        };
        let mut found = Vec::new();
        let gravity = map.gravity.iter().map(|gravity| &gravity.orientation);
        for rotation in map.rotations.iter().chain(gravity) {
            let columns: Vec<String> = rotation
                .columns
                .iter()
                .filter_map(|from| own_column(from))
                .collect();
            for (at, column) in columns.iter().enumerate() {
                found.push(Interpolation {
                    column: column.clone(),
                    by: Way::Rotation {
                        map: rotation.clone(),
                        columns: columns.clone(),
                        at,
                    },
                });
            }
        }
        for (channel, mapped) in map.channels.iter().zip(&map.columns) {
            let Some(column) = own_column(&mapped.from) else {
                continue;
            };
            if channel.unit() != Unit::Degree {
                continue;
            }
            let cells_a_degree =
                1.0 / (mapped.unit.convert(1.0) * mapped.scale.unwrap_or(1.0)).abs();
            found.push(Interpolation {
                column,
                by: match channel.period() {
                    Some(period) => Way::Periodic(f64::from(period) * cells_a_degree),
                    None => Way::Angle {
                        channel: channel.name().to_owned(),
                        half_turn: 180.0 * cells_a_degree,
                        turn: turn_in(mapped.unit),
                    },
                },
            });
        }
        let tasks = map.tasks.iter().filter(|own| own.units.is_empty());
        for column in tasks.flat_map(|own| &own.task.from) {
            found.extend(own_column(column).map(|column| Interpolation {
                column,
                by: Way::Classes,
            }));
        }
        found
    }
}

/// Two neighbouring rows of a joined table, and an instant between them.
pub(super) struct Gap<'a> {
    pub(super) table: &'a ForeignTable,
    pub(super) rows: [usize; 2],
    /// Weight of the second row, from 0 to 1.
    pub(super) share: f64,
}

impl Gap<'_> {
    /// Interpolated cell of `column`; empty if the cell of either row is empty.
    ///
    /// # Errors
    /// [`ImportError::Table`] for a cell that is not a number, and for angles or rotations without a unique shortest path.
    pub(super) fn cell(
        &self,
        column: &str,
        known: &[Interpolation],
    ) -> Result<String, ImportError> {
        let mut ways = known.iter().filter(|known| known.column == column);
        let way = ways.next().map(|known| &known.by);
        if let Some(Way::Rotation { map, columns, at }) = way {
            return self.rotated(map, columns, *at);
        }
        let Some([before, after]) = self.ends(column)? else {
            return Ok(String::new());
        };
        let number = match way {
            Some(Way::Angle {
                channel,
                half_turn,
                turn,
            }) if (after - before).abs() > *half_turn => {
                return Err(table_error!(
                    self.table.place(self.rows[1], column),
                    "{after} follows {before}, more than half a turn of `{channel}`, and `pick = \"linear\"` would invent angles between. For a part of a rotation vector write `rotation = [\"Rx\", \"Ry\", \"Rz\"]` above the first [section] of the map. For one angle that wraps around write `period = {turn}` in `{channel} = {{ … }}`. Otherwise write `pick = \"nearest\"` in the join"
                ));
            }
            Some(Way::Classes) if (after - before).abs() > 0.0 => {
                return Err(table_error!(
                    self.table.place(self.rows[1], column),
                    "class {after} follows {before}, and `pick = \"linear\"` would invent classes between: write `pick = \"nearest\"` in the join"
                ));
            }
            Some(Way::Periodic(period)) => wrapped(before, after, self.share, *period),
            _ => before + self.share * (after - before),
        };
        Ok(format!("{number:?}"))
    }

    /// Numbers of `column` in both rows; `None` if either cell is empty.
    fn ends(&self, column: &str) -> Result<Option<[f64; 2]>, ImportError> {
        let of = |row| -> Result<Option<f64>, ImportError> {
            let cell = cell_of(self.table, row, column)?;
            number::number(&cell).map_err(|problem| {
                table_error!(
                    self.table.place(row, column),
                    "`{}`: {problem}; `pick = \"linear\"` is for numbers",
                    shown(&cell)
                )
            })
        };
        let [before, after] = self.rows.map(of);
        Ok(before?.zip(after?).map(|(before, after)| [before, after]))
    }

    /// Component `at`, from 0, of the interpolated rotation, as a cell.
    fn rotated(
        &self,
        map: &RotationMap,
        columns: &[String],
        at: usize,
    ) -> Result<String, ImportError> {
        let mut ends = [Vec::new(), Vec::new()];
        for column in columns {
            let Some(found) = self.ends(column)? else {
                return Ok(String::new());
            };
            ends.iter_mut()
                .zip(found)
                .for_each(|(end, part)| end.push(part));
        }
        let orientation = |which: usize| {
            map.orientation(&ends[which]).ok_or_else(|| {
                ImportError::table(
                    self.table.place(self.rows[which], &columns[0]),
                    RotationMap::no_rotation(&ends[which]),
                )
            })
        };
        let (before, after) = (orientation(0)?, orientation(1)?);
        let apart = before.angle_to(after).0;
        if apart > OPPOSITE_DEG {
            return Err(table_error!(
                self.table.place(self.rows[1], &columns[0]),
                "this rotation is {apart:.1} degrees from the previous rotation, so its interpolation is ambiguous: write `pick = \
                     \"nearest\"` in the join"
            ));
        }
        let cells = map.cells(before.toward(after, self.share));
        Ok(format!("{:?}", cells[at]))
    }
}

/// Angle at the fraction `share` of the shorter path from `before` to `after`, in the range of both: −`period`/2 to `period`/2, or 0 to `period`.
fn wrapped(before: f64, after: f64, share: f64, period: f64) -> f64 {
    let turns = ((after - before) / period).round();
    let angle = before + share * (after - before - turns * period);
    let lie_in = |low: f64, high: f64| [before, after].iter().all(|end| (low..=high).contains(end));
    match turns.abs() >= 1.0 {
        true if lie_in(-period / 2.0, period / 2.0) => angle - period * (angle / period).round(),
        true if lie_in(0.0, period) => angle.rem_euclid(period),
        _ => angle,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_goes_the_short_way_and_stays_in_its_range() {
        for (before, after, share, expected) in [
            (170.0, -170.0, 0.25, 175.0),
            (170.0, -170.0, 0.75, -175.0),
            (350.0, 10.0, 0.75, 5.0),
            (10.0, 350.0, 0.75, 355.0),
            (30.0, 50.0, 0.5, 40.0),
            // A continuous angle is not reduced to a range.
            (530.0, 550.0, 0.5, 540.0),
        ] {
            let found = wrapped(before, after, share, 360.0);
            assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
        }
    }
}

//! Replaces rotations by equivalent rotations, so that consecutive rows are close.

use super::table::ResolvedTable;
use crate::error::ImportError;
use crate::import::map::RotationMap;

/// Minimum decrease of the distance to the previous row at which the equivalent rotation replaces the rotation, in the unit of the cells.
const LEAST_GAIN: f64 = 1e-9;

/// Replaces each rotation by the equivalent rotation nearest to the previous row. Near half a turn, robots alternate between a rotation vector and
/// its negative.
///
/// # Errors
/// [`ImportError::Table`] naming the row for a quaternion whose norm is not 1.
pub(super) fn apply(map: &RotationMap, table: &mut ResolvedTable) -> Result<(), ImportError> {
    let columns: Vec<usize> = map
        .columns
        .iter()
        .filter_map(|name| table.find(name))
        .collect();
    let mut before: Option<Vec<f64>> = None;
    for row in 0..table.rows() {
        if table.unmatched(row).is_some() {
            continue;
        }
        let cells: Result<Option<Vec<f64>>, ImportError> = columns
            .iter()
            .map(|column| table.number(row, *column))
            .collect();
        let Some(cells) = cells? else {
            continue;
        };
        if map.orientation(&cells).is_none() {
            return Err(ImportError::table(
                table.place(row, columns[0]),
                RotationMap::no_rotation(&cells),
            ));
        }
        let twin = before.as_ref().zip(map.twin(&cells));
        let nearer = twin.filter(|(before, twin)| {
            distance(before, twin) + LEAST_GAIN < distance(before, &cells)
        });
        before = Some(match nearer {
            Some((_, twin)) => {
                for (column, part) in columns.iter().zip(&twin) {
                    table.set(row, *column, format!("{part:?}"));
                }
                twin
            }
            None => cells,
        });
    }
    Ok(())
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    let pairs = one.iter().zip(other);
    pairs.map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

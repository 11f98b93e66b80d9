//! The numbers of taxels in the columns of a table.

use super::Sources;
use crate::csv_table::number;
use crate::error::DatasetError;
use crate::import::map::SignalsMap;

/// The numbers of every row, place first, in the unit that they are kept in. Where a cell holds none there is a NaN, of which somebody
/// hears if the row is kept.
pub(super) fn numbers(sources: &Sources<'_>, map: &SignalsMap) -> Result<Vec<f32>, DatasetError> {
    let (rows, length) = (sources.main.rows(), map.spec.info.len());
    let mut numbers = Vec::new();
    let mut cells = Vec::with_capacity(length);
    for row in 0..rows {
        let first = numbers.len();
        numbers.resize(first + length, f32::NAN);
        let mut joined = sources.joined.iter();
        if joined.any(|joined| !joined.is_matched(row)) {
            continue;
        }
        cells.clear();
        for name in map.columns() {
            let cell = sources.cell(row, name)?;
            match map.columns() {
                [_] => cells.extend(packed(&cell).map(|cell| read(cell, map))),
                _ => cells.push(read(&cell, map)),
            }
        }
        if cells.len() == length {
            let values = place_first(map, &cells);
            numbers[first..]
                .iter_mut()
                .zip(values)
                .for_each(|(place, value)| *place = value);
        }
    }
    Ok(numbers)
}

/// The numbers that one cell packs, whatever lists they are in.
fn packed(cell: &str) -> impl Iterator<Item = &str> {
    let parts = cell.split(|letter: char| letter.is_whitespace() || "[](),;".contains(letter));
    parts.filter(|part| !part.is_empty())
}

/// The number in a cell, as it is kept; NaN of none.
#[expect(
    clippy::cast_possible_truncation,
    reason = "signals are kept in single precision; this is the one rounding"
)]
fn read(cell: &str, map: &SignalsMap) -> f32 {
    let number = number::number_in_unit(cell.trim(), &map.unit);
    // Beyond single precision it is none either.
    let number = number.ok().flatten().map(|number| number as f32);
    number
        .filter(|number| number.is_finite())
        .unwrap_or(f32::NAN)
}

/// The numbers of a row in the order of places, then of channels.
pub(in crate::import) fn place_first<'v>(
    map: &SignalsMap,
    values: &'v [f32],
) -> impl Iterator<Item = f32> + 'v {
    let depth = map.spec.info.channels as usize;
    let places = values.len() / depth.max(1);
    let is_channel_first = map.is_channel_first;
    (0..values.len()).map(move |position| match is_channel_first {
        true => values[position % depth * places + position / depth],
        false => values[position],
    })
}

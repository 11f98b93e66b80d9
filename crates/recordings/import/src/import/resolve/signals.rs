//! Reads taxel values from the columns of a table.

use std::collections::BTreeMap;

use super::Sources;
use crate::csv_table::number;
use crate::error::{ImportError, table_error};
use crate::import::map::SignalsMap;
use crate::import::warning::ImportWarning;
use crate::taxel_codes::codes;
use taceva_core::single;

/// Maximum number of rows, equally spaced, that are searched for codes that mean "nothing measured".
const SAMPLED: usize = 1000;

/// Reads the values of every row, grouped by taxel, in the stored unit. A cell without a number becomes NaN, which is an error if the row is kept.
pub(super) fn numbers(
    sources: &Sources<'_>,
    map: &SignalsMap,
) -> Result<ColumnSignals, ImportError> {
    let (rows, length) = (sources.main.rows(), map.spec.info.len());
    let mut numbers = Vec::new();
    let mut are_placeholders = vec![false; rows];
    let mut cells = Vec::with_capacity(length);
    for (row, is_placeholder) in are_placeholders.iter_mut().enumerate() {
        let first = numbers.len();
        numbers.resize(first + length, f32::NAN);
        let mut joined = sources.joined.iter();
        if joined.any(|joined| !joined.is_matched(row)) {
            continue;
        }
        cells.clear();
        let mut read = |cell: &str| {
            let number = number::number(cell.trim()).ok().flatten();
            *is_placeholder |= number.is_some_and(|number| map.is_placeholder(number));
            read(cell, map)
        };
        for name in map.columns() {
            let cell = sources.cell(row, name)?;
            match map.columns() {
                [_] => {
                    let wrong = |problem: String| sources.wrong_signals(row, name, &problem);
                    let shape = nested(&cell).map_err(wrong)?;
                    if shape.len() > 1 {
                        map.check_axes(&shape).map_err(wrong)?;
                    }
                    cells.extend(packed(&cell).map(&mut read));
                }
                _ => cells.push(read(&cell)),
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
    Ok(ColumnSignals {
        numbers,
        are_placeholders,
    })
}

/// Taxel values in the columns of a table.
pub(in crate::import) struct ColumnSignals {
    /// Values of every row, grouped by taxel.
    pub(in crate::import) numbers: Vec<f32>,
    /// True for each row with a number that means "not measured".
    pub(in crate::import) are_placeholders: Vec<bool>,
}

impl Sources<'_> {
    /// Warns of numbers that probably mean "nothing measured", if the map lists no placeholders. A cell that cannot be read is an error later.
    pub(super) fn warn_of_codes(&mut self) {
        let map = self.map;
        let unlisted = map.signals.as_ref();
        let Some(signals) = unlisted.filter(|signals| signals.placeholders.is_empty()) else {
            return;
        };
        let rows = self.main.rows();
        let mut found: BTreeMap<String, &String> = BTreeMap::new();
        for name in signals.columns() {
            let mut taxels: Vec<Vec<f64>> = Vec::new();
            for row in (0..rows).step_by(rows.div_ceil(SAMPLED).max(1)) {
                let mut joined = self.joined.iter();
                if joined.any(|joined| !joined.is_matched(row)) {
                    continue;
                }
                let Ok(cell) = self.cell(row, name) else {
                    return;
                };
                let parts: Vec<&str> = match signals.columns() {
                    [_] => packed(&cell).collect(),
                    _ => vec![cell.trim()],
                };
                taxels.resize_with(taxels.len().max(parts.len()), Vec::new);
                for (taxel, part) in taxels.iter_mut().zip(parts) {
                    taxel.extend(number::number(part).ok().flatten());
                }
            }
            for code in taxels.into_iter().flat_map(codes) {
                found.entry(code.value.to_string()).or_insert(name);
            }
        }
        let warnings = found.into_iter();
        self.warnings
            .extend(warnings.map(|(code, column)| ImportWarning::TaxelCode {
                column: column.clone(),
                code,
            }));
    }

    fn wrong_signals(&self, row: usize, name: &str, problem: &str) -> ImportError {
        table_error!(self.main.place(row, name), "[signals]: {problem}")
    }
}

/// Lengths of the nested lists in a cell, the outermost first; empty for a cell without brackets.
///
/// # Errors
/// Error message stating why the lists are irregular.
fn nested(cell: &str) -> Result<Vec<u64>, String> {
    let mut open: Vec<u64> = Vec::new();
    let mut sides: Vec<Option<u64>> = Vec::new();
    if !cell.contains(['[', '(']) {
        return Ok(Vec::new());
    }
    let mut is_in_number = false;
    for letter in cell.chars() {
        let begins = matches!(letter, '[' | '(');
        let is_between = letter.is_whitespace() || "[](),;".contains(letter);
        if let Some(members) = open.last_mut() {
            *members += u64::from(begins || !is_between && !is_in_number);
        } else if !is_between {
            return Err("numbers outside the brackets".to_owned());
        }
        is_in_number = !is_between;
        if begins {
            open.push(0);
        } else if matches!(letter, ']' | ')') {
            let members = open
                .pop()
                .ok_or("a closing bracket has no opening bracket")?;
            if sides.len() <= open.len() {
                sides.resize(open.len() + 1, None);
            }
            match sides[open.len()].replace(members) {
                Some(before) if before != members => {
                    return Err(format!(
                        "lists of {before} and of {members} members side by side"
                    ));
                }
                _ => {}
            }
        }
    }
    let sides: Option<Vec<u64>> = sides.into_iter().collect();
    let is_whole = open.is_empty();
    sides
        .filter(|_| is_whole)
        .ok_or_else(|| "an opening bracket has no closing bracket".to_owned())
}

/// Texts of the numbers in one cell, without the structure of their lists.
fn packed(cell: &str) -> impl Iterator<Item = &str> {
    let parts = cell.split(|letter: char| letter.is_whitespace() || "[](),;".contains(letter));
    parts.filter(|part| !part.is_empty())
}

/// Number in a cell, in the stored unit; NaN if the cell contains no number.
fn read(cell: &str, map: &SignalsMap) -> f32 {
    let number = number::number_in_unit(cell.trim(), &map.unit);
    // Numbers beyond single precision are absent as well.
    let number = number.ok().flatten().map(single);
    number
        .filter(|number| number.is_finite())
        .unwrap_or(f32::NAN)
}

/// Numbers of a row in the stored order: by taxel, then by channel.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lengths_of_lists_are_counted_from_the_outermost_one() {
        for (cell, expected) in [
            ("1;2;3", &[][..]),
            ("[1.0, 2.0]", &[2]),
            ("[[0.1, 0.2, 3], [0.3, 1e-2, -4]]", &[2, 3]),
            ("[[1 2]\n [3 4]]", &[2, 2]),
            ("[[[1], [2]]]", &[1, 2, 1]),
            ("([1, 2], [3, 4], [5, 6])", &[3, 2]),
        ] {
            assert_eq!(nested(cell).as_deref(), Ok(expected), "{cell}");
        }
        for (cell, word) in [
            ("[[1, 2], [3]]", "lists of 2 and of 1"),
            ("[1, 2", "no closing bracket"),
            ("[1] 2", "outside"),
        ] {
            assert!(nested(cell).expect_err("refused").contains(word), "{cell}");
        }
    }
}

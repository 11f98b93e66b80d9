//! Pairs the rows of a shard with their predictions by key.

use std::cmp::Ordering;
use std::collections::HashMap;
use std::ops::Range;

use taceva_import::{CsvParts, CsvTable};

use super::row_key::{KeyPair, key_of};
use super::table_parts::{Reader, TableParts};
use super::tables;
use crate::error::EvaluateError;

/// Location of the predictions that belong to the rows of a shard.
pub(super) enum Found {
    /// The predictions are in the rows with the same numbers.
    InOrder,
    /// The predictions are in this table, whose first row belongs to the first row of the shard.
    Gathered(CsvTable),
}

/// Tables of truth and predictions, and the key that pairs their rows.
pub(super) struct ByKey<'a> {
    pub(super) key: &'a KeyPair,
    pub(super) truth: &'a TableParts,
    pub(super) prediction: &'a TableParts,
    /// Reader of the predictions, restricted to the needed columns.
    pub(super) reader: &'a Reader<'a>,
}

impl ByKey<'_> {
    /// Finds the predictions for the rows in `own`. If both tables have the same ascending keys, reads only these rows. Otherwise scans both tables, and sorts
    /// the predictions in the order of the shard.
    ///
    /// # Errors
    /// [`EvaluateError::Tables`] for a key that is empty, repeats, or is missing in one of the tables.
    pub(super) fn pair(&self, own: &Range<u64>) -> Result<Found, EvaluateError> {
        let key = self.key;
        let truth = self.truth.reader()?;
        let truth = truth.with_columns(|name| name == key.truth);
        let prediction = self.prediction.reader()?;
        let prediction = prediction.with_columns(|name| name == key.prediction);
        if self.is_in_order(own, &truth, &prediction)? {
            return Ok(Found::InOrder);
        }
        let wanted = self.own_keys(own, &truth)?;
        self.check_once(own, &wanted, &truth)?;
        let rows = self.rows_of_predictions(&wanted, &prediction)?;
        self.gathered(&rows).map(Found::Gathered)
    }

    /// Keys of the shard, each with its position in the shard.
    fn own_keys(
        &self,
        own: &Range<u64>,
        truth: &Reader<'_>,
    ) -> Result<HashMap<String, usize>, EvaluateError> {
        let mut wanted = HashMap::new();
        for part in parts_of(own) {
            let table = truth.read(part)?;
            let first = part * CsvParts::ROWS;
            for (at, cell) in table.text(&self.key.truth)?.into_iter().enumerate() {
                let row = first + at as u64;
                if !own.contains(&row) {
                    continue;
                }
                let key = key_of(cell);
                if key.is_empty() {
                    return Err(tables::without_key(&table, at, &self.key.truth)?);
                }
                let position = usize::try_from(row - own.start).unwrap_or(usize::MAX);
                if wanted.insert(key.to_owned(), position).is_some() {
                    return Err(twice(self.truth, &self.key.truth, key));
                }
            }
        }
        Ok(wanted)
    }

    /// Rejects a key of the shard that another row of the truth also has.
    fn check_once(
        &self,
        own: &Range<u64>,
        wanted: &HashMap<String, usize>,
        truth: &Reader<'_>,
    ) -> Result<(), EvaluateError> {
        for part in parts_of(&(0..self.truth.rows())) {
            let table = truth.read(part)?;
            let first = part * CsvParts::ROWS;
            for (at, cell) in table.text(&self.key.truth)?.into_iter().enumerate() {
                let key = key_of(cell);
                if !own.contains(&(first + at as u64)) && wanted.contains_key(key) {
                    return Err(twice(self.truth, &self.key.truth, key));
                }
            }
        }
        Ok(())
    }

    /// Row number of the prediction for each row of the shard.
    fn rows_of_predictions(
        &self,
        wanted: &HashMap<String, usize>,
        prediction: &Reader<'_>,
    ) -> Result<Vec<u64>, EvaluateError> {
        let mut found: Vec<Option<u64>> = vec![None; wanted.len()];
        for part in parts_of(&(0..self.prediction.rows())) {
            let table = prediction.read(part)?;
            let first = part * CsvParts::ROWS;
            for (at, cell) in table.text(&self.key.prediction)?.into_iter().enumerate() {
                let key = key_of(cell);
                if let Some(position) = wanted.get(key)
                    && found[*position].replace(first + at as u64).is_some()
                {
                    return Err(twice(self.prediction, &self.key.prediction, key));
                }
            }
        }
        let lacking = |position: usize| {
            let mut keys = wanted.iter();
            let key = keys.find(|(_, at)| **at == position).map(|(key, _)| key);
            EvaluateError::Tables {
                path: self.prediction.path().to_owned(),
                problem: tables::is_lacking(
                    &self.key.prediction,
                    key.map_or("", String::as_str),
                    self.truth.path(),
                    [],
                ),
            }
        };
        let found = found.into_iter().enumerate();
        found
            .map(|(position, row)| row.ok_or_else(|| lacking(position)))
            .collect()
    }

    /// True if both tables have the same ascending keys in `own`. The check includes the row before `own`, so that no key repeats.
    fn is_in_order(
        &self,
        own: &Range<u64>,
        truth: &Reader<'_>,
        prediction: &Reader<'_>,
    ) -> Result<bool, EvaluateError> {
        let with_one_before = own.start.saturating_sub(1)..own.end;
        let mut last: Option<String> = None;
        for part in parts_of(&with_one_before) {
            let [truth, prediction] = [truth.read(part)?, prediction.read(part)?];
            let first = part * CsvParts::ROWS;
            let pairs = truth
                .text(&self.key.truth)?
                .into_iter()
                .zip(prediction.text(&self.key.prediction)?);
            for (at, (key, other)) in pairs.enumerate() {
                if !with_one_before.contains(&(first + at as u64)) {
                    continue;
                }
                let [key, other] = [key_of(key), key_of(other)];
                let ascends = last
                    .as_deref()
                    .is_none_or(|last| by_length(last, key).is_lt());
                if key != other || key.is_empty() || !ascends {
                    return Ok(false);
                }
                last = Some(key.to_owned());
            }
        }
        Ok(true)
    }

    /// Predictions in the rows `rows`, in this order.
    fn gathered(&self, rows: &[u64]) -> Result<CsvTable, EvaluateError> {
        let header = self.reader.header()?;
        let mut positions: Vec<usize> = (0..rows.len()).collect();
        positions.sort_unstable_by_key(|position| rows[*position]);
        let mut cells: Vec<Vec<String>> = vec![Vec::new(); rows.len()];
        for of_part in positions.chunk_by(|one, other| part_of(rows[*one]) == part_of(rows[*other]))
        {
            let Some(first) = of_part.first() else {
                continue;
            };
            let part = part_of(rows[*first]);
            let table = self.reader.read(part)?;
            for &position in of_part {
                let row =
                    usize::try_from(rows[position] - part * CsvParts::ROWS).unwrap_or(usize::MAX);
                let of_row = 0..table.names().len();
                cells[position] = of_row
                    .map(|column| table.cell(row, column).to_owned())
                    .collect();
            }
        }
        let names: Vec<&str> = header.names().iter().map(String::as_str).collect();
        let rows = cells.iter().map(|cells| cells.iter().map(String::as_str));
        Ok(CsvTable::of_cells(self.prediction.path(), &names, rows)?)
    }
}

/// Compares two keys by length, then by text. This is the numeric order for whole numbers, and a fixed order for other texts.
pub(super) fn by_length(one: &str, other: &str) -> Ordering {
    one.len().cmp(&other.len()).then_with(|| one.cmp(other))
}

fn part_of(row: u64) -> u64 {
    row / CsvParts::ROWS
}

/// Numbers of the table parts that contain `rows`.
pub(super) fn parts_of(rows: &Range<u64>) -> Range<u64> {
    match rows.is_empty() {
        true => 0..0,
        false => part_of(rows.start)..part_of(rows.end - 1) + 1,
    }
}

fn twice(table: &TableParts, name: &str, key: &str) -> EvaluateError {
    EvaluateError::Tables {
        path: table.path().to_owned(),
        problem: tables::comes_twice(name, key, None),
    }
}

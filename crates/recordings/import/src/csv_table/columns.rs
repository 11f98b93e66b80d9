//! Parses columns of a table, for all rows or for some.

use std::ops::Range;

use taceva_core::{Column, SourceUnit};

use super::CsvTable;
use super::number::{number_in_unit, parse_number};
use super::split::Block;
use crate::error::ImportError;
use taceva_dataset::internal::each_part;

/// Handling of a cell that is neither empty nor a finite number.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Invalid {
    Refuse,
    AsNan,
}

impl CsvTable {
    /// Numbers of the column called `name`; empty cells are missing values.
    ///
    /// # Errors
    /// [`ImportError::Table`] if the column does not exist, or at the first cell that is not a finite number.
    pub fn numbers(&self, name: &str) -> Result<Column, ImportError> {
        self.whole(name, Invalid::Refuse)
    }

    /// Numbers of the column called `name`; empty cells are missing values. A cell that is not a finite number becomes NaN, so that callers can count these
    /// cells.
    ///
    /// # Errors
    /// [`ImportError::Table`] if the column does not exist.
    pub fn numbers_with_invalid(&self, name: &str) -> Result<Column, ImportError> {
        self.whole(name, Invalid::AsNan)
    }

    /// Numbers of the column at the position `column`, for `rows` and in their order; empty cells are missing values.
    ///
    /// # Errors
    /// [`ImportError::Table`] at the first cell that is not a finite number.
    /// # Panics
    /// Panics if the row or column does not exist.
    pub fn numbers_in(
        &self,
        column: usize,
        rows: impl ExactSizeIterator<Item = usize>,
    ) -> Result<Column, ImportError> {
        self.some(column, rows, Invalid::Refuse)
    }

    /// Same as [`numbers_in`](CsvTable::numbers_in), but with NaN for each cell that is neither empty nor a finite number.
    ///
    /// # Errors
    /// No error occurs. The return type equals that of [`numbers_in`](CsvTable::numbers_in), so that a caller can choose between the two methods.
    /// # Panics
    /// Panics if the row or column does not exist.
    pub fn numbers_in_with_invalid(
        &self,
        column: usize,
        rows: impl ExactSizeIterator<Item = usize>,
    ) -> Result<Column, ImportError> {
        self.some(column, rows, Invalid::AsNan)
    }

    /// Finite number in a cell, converted to the stored unit; `None` if the cell is empty.
    ///
    /// If the units differ by a power of ten, the decimal point is moved before parsing. For example, `1212.4 um` becomes the binary64 nearest to 1.2124 mm.
    ///
    /// # Errors
    /// [`ImportError::Table`] if the cell contains no finite number, or a number that overflows in the stored unit.
    /// # Panics
    /// Panics if the row or column does not exist.
    pub fn number_in_unit(
        &self,
        row: usize,
        column: usize,
        unit: &SourceUnit,
    ) -> Result<Option<f64>, ImportError> {
        // Most cells need no conversion.
        let Some(number) = self.number(row, column)? else {
            return Ok(None);
        };
        if unit.decimal_shift() == Some(0) {
            return Ok(Some(number));
        }
        let converted = number_in_unit(self.cell(row, column), unit);
        converted.map_err(|problem| self.refuse(row, column, &problem))
    }

    /// Cells of the column called `name` as written, without surrounding blanks.
    ///
    /// # Errors
    /// [`ImportError::Table`] if the column does not exist.
    pub fn text(&self, name: &str) -> Result<Vec<&str>, ImportError> {
        let column = self.position(name)?;
        Ok(self.text_in(column, 0..self.rows).collect())
    }

    /// Cells of the column at the position `column`, for `rows` and in their order, as written, without surrounding blanks.
    ///
    /// # Panics
    /// Panics if the row or column does not exist.
    pub fn text_in(
        &self,
        column: usize,
        rows: impl Iterator<Item = usize>,
    ) -> impl Iterator<Item = &str> {
        self.cells(column, rows)
            .map(|(_, cell)| self.text[cell].trim())
    }

    fn whole(&self, name: &str, invalid: Invalid) -> Result<Column, ImportError> {
        let column = self.position(name)?;
        let mut values = vec![0.0; self.rows];
        let mut rest = values.as_mut_slice();
        let mut parts = Vec::with_capacity(self.blocks.len());
        for block in &self.blocks {
            let (part, after) = rest.split_at_mut(block.rows.len());
            parts.push((block.rows.clone(), part));
            rest = after;
        }
        let outcomes = each_part(parts, |(rows, values)| {
            let first = rows.start;
            let absent = self.parse(column, rows, values, invalid)?;
            Ok::<_, ImportError>((first, absent))
        });
        let mut absent = Vec::new();
        for outcome in outcomes {
            let (first, positions): (usize, Vec<usize>) = outcome?;
            absent.extend(positions.into_iter().map(|position| first + position));
        }
        Ok(with_absent(values, &absent))
    }

    fn some(
        &self,
        column: usize,
        rows: impl ExactSizeIterator<Item = usize>,
        invalid: Invalid,
    ) -> Result<Column, ImportError> {
        let mut values = vec![0.0; rows.len()];
        let absent = self.parse(column, rows, &mut values, invalid)?;
        Ok(with_absent(values, &absent))
    }

    /// Parses the numbers of `column` in `rows` into `values`. Returns the positions in `values` of missing numbers.
    fn parse(
        &self,
        column: usize,
        rows: impl Iterator<Item = usize>,
        values: &mut [f64],
        invalid: Invalid,
    ) -> Result<Vec<usize>, ImportError> {
        let mut absent = Vec::new();
        for (position, (row, cell)) in self.cells(column, rows).enumerate() {
            match parse_number(&self.text, cell) {
                Some(Some(number)) => values[position] = number,
                Some(None) => absent.push(position),
                None if invalid == Invalid::AsNan => values[position] = f64::NAN,
                None => return Err(self.not_a_number(row, column)),
            }
        }
        Ok(absent)
    }

    /// Text range of the cell of `column` in each of `rows`, with its row.
    fn cells(
        &self,
        column: usize,
        rows: impl Iterator<Item = usize>,
    ) -> impl Iterator<Item = (usize, Range<usize>)> {
        let mut last: Option<&Block> = None;
        rows.map(move |row| {
            let block = match last {
                Some(block) if block.rows.contains(&row) => block,
                _ => self.block_of(row),
            };
            last = Some(block);
            (row, block.cell(row, column))
        })
    }
}

fn with_absent(values: Vec<f64>, absent: &[usize]) -> Column {
    if absent.is_empty() {
        return Column::full(values);
    }
    let mut absent = absent.iter().copied().peekable();
    let mut column = Column::default();
    for (row, value) in values.into_iter().enumerate() {
        let is_absent = absent.next_if_eq(&row).is_some();
        column.push((!is_absent).then_some(value));
    }
    column
}

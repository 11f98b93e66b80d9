//! Text table whose cells are converted from the text form that a map states.

use std::borrow::Cow;
use std::path::Path;

use super::Stated;
use crate::csv_table::CsvTable;
use crate::csv_table::text_form::{TextForm, is_grouped};
use crate::error::{ImportError, Place, table_error};
use taceva_dataset::internal::shown;

/// Minimum number of cells with three digits after the point that suggest digit groups.
const LEAST_GROUPED: u64 = 3;

/// Text table with its text form.
#[derive(Debug)]
pub(crate) struct DelimitedTable {
    table: CsvTable,
    form: TextForm,
    /// Unit of each column from the row of units; empty without a row of units.
    units: Vec<Option<String>>,
}

impl DelimitedTable {
    pub(super) fn read(path: &Path, form: &TextForm) -> Result<DelimitedTable, ImportError> {
        let written = CsvTable::read_written(path, form)?;
        Ok(DelimitedTable {
            table: written.table,
            form: form.clone(),
            units: written.units,
        })
    }

    pub(super) fn path(&self) -> &Path {
        self.table.path()
    }

    pub(super) fn rows(&self) -> usize {
        self.table.rows()
    }

    pub(super) fn names(&self) -> &[String] {
        self.table.names()
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.table.has(name)
    }

    /// Cell of a row in the column called `name`, as written in the file.
    pub(crate) fn written(&self, row: usize, name: &str) -> Result<&str, ImportError> {
        Ok(self.table.cell(row, self.table.position(name)?))
    }

    pub(super) fn cell(&self, row: usize, name: &str) -> Result<Cow<'_, str>, ImportError> {
        let cell = self.written(row, name)?;
        match self.form.converted(cell) {
            Ok(None) => Ok(Cow::Borrowed(cell)),
            Ok(Some(converted)) => Ok(Cow::Owned(converted)),
            Err(problem) => Err(table_error!(
                self.place(row, name),
                "`{}` {problem}",
                shown(cell)
            )),
        }
    }

    /// Example of a cell whose decimal point may be a digit separator, and the number of such cells in the column. `None` unless the column also
    /// contains whole numbers, because columns of fractions with three digits are common.
    pub(crate) fn grouped_digits(&self, name: &str) -> Option<(String, u64)> {
        if self.form.thousands.is_some() || self.form.decimal != '.' {
            return None;
        }
        let column = self.table.position(name).ok()?;
        let (mut example, mut grouped, mut whole) = (None, 0, 0);
        for row in 0..self.rows() {
            let cell = self.table.cell(row, column);
            let digits = cell.trim_start_matches(['+', '-']);
            if is_grouped(cell, '.') {
                grouped += 1;
                example.get_or_insert(cell);
            } else if !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()) {
                if digits.trim_start_matches('0').len() > 3 {
                    return None;
                }
                // A 0 may be written without a fraction.
                whole += u64::from(digits != "0");
            } else if !cell.is_empty() {
                return None;
            }
        }
        let example = example?.to_owned();
        (grouped >= LEAST_GROUPED && whole > 0).then_some((example, grouped))
    }

    pub(super) fn place(&self, row: usize, name: &str) -> Place {
        let column = self.table.position(name).unwrap_or(usize::MAX);
        self.table.place(row, column)
    }

    /// Unit of a column from the row of units.
    pub(super) fn stated(&self, name: &str) -> Vec<Stated> {
        let at = self.names().iter().position(|known| known == name);
        let unit = at.and_then(|at| self.units.get(at)?.clone());
        let stated = unit.map(|unit| Stated {
            unit: Some(unit),
            packed: None,
        });
        stated.into_iter().collect()
    }
}

//! Table of the cells that a map names.

use std::path::{Path, PathBuf};

use taceva_core::SourceUnit;

use super::Sources;
use crate::csv_table::number;
use crate::error::{ImportError, Place, table_error};
use taceva_dataset::internal::shown;

/// Cells of the columns that a map names.
pub(in crate::import) struct ResolvedTable {
    path: PathBuf,
    /// Path of the main table relative to the lab's folder.
    relative: String,
    names: Vec<String>,
    /// Cells of the table: for each column, the cell of each row.
    cells: Vec<Vec<String>>,
    /// Place of each row, for messages.
    places: Vec<Place>,
    /// For each row, the first join without a match, which leaves the row out; `None` if all joins match.
    unmatched: Vec<Option<String>>,
}

impl ResolvedTable {
    pub(super) fn new(
        sources: &Sources<'_>,
        names: Vec<String>,
        cells: Vec<Vec<String>>,
    ) -> ResolvedTable {
        let rows = 0..sources.main.rows();
        let unmatched = rows.clone().map(|row| {
            let mut joined = sources.joined.iter();
            let missing = joined.find(|joined| !joined.is_matched(row));
            missing.map(|joined| format!("join {}", joined.name()))
        });
        ResolvedTable {
            path: sources.main.path().to_owned(),
            relative: sources.relative.clone(),
            names,
            cells,
            unmatched: unmatched.collect(),
            places: rows.map(|row| sources.main.place(row, "")).collect(),
        }
    }

    /// Path of the main table.
    pub(in crate::import) fn path(&self) -> &Path {
        &self.path
    }

    /// Path of the table relative to the lab's folder.
    pub(in crate::import) fn source(&self) -> &str {
        &self.relative
    }

    pub(in crate::import) fn names(&self) -> &[String] {
        &self.names
    }

    pub(in crate::import) fn rows(&self) -> usize {
        self.places.len()
    }

    /// Position of the column called `name`.
    pub(in crate::import) fn position(&self, name: &str) -> Result<usize, ImportError> {
        self.find(name)
            .ok_or_else(|| table_error!(&self.path, "no column `{}`", shown(name)))
    }

    pub(in crate::import) fn cell(&self, row: usize, column: usize) -> &str {
        self.cells[column][row].trim()
    }

    pub(in crate::import) fn number_in_unit(
        &self,
        row: usize,
        column: usize,
        unit: &SourceUnit,
    ) -> Result<Option<f64>, ImportError> {
        let number = number::number_in_unit(self.cell(row, column), unit);
        number.map_err(|problem| self.refuse(row, column, &problem))
    }

    /// Join that leaves the row out; `None` if all joins match.
    pub(in crate::import) fn unmatched(&self, row: usize) -> Option<&str> {
        self.unmatched[row].as_deref()
    }

    /// Position of the column called `name`; `None` for a name that the map does not mention.
    pub(in crate::import) fn find(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Number in the cell at `row` and `column`; `None` for an empty cell.
    pub(in crate::import) fn number(
        &self,
        row: usize,
        column: usize,
    ) -> Result<Option<f64>, ImportError> {
        let cell = &self.cells[column][row];
        number::number(cell).map_err(|problem| self.refuse(row, column, &problem))
    }

    /// Replaces a cell.
    pub(super) fn set(&mut self, row: usize, column: usize, cell: String) {
        self.cells[column][row] = cell;
    }

    /// Adds a column.
    pub(super) fn push(&mut self, name: String, cells: Vec<String>) {
        self.names.push(name);
        self.cells.push(cells);
    }

    pub(in crate::import) fn place(&self, row: usize, column: usize) -> Place {
        let mut place = self.places[row].clone();
        place.column = self.names.get(column).cloned();
        place
    }

    fn refuse(&self, row: usize, column: usize, problem: &str) -> ImportError {
        table_error!(
            self.place(row, column),
            "`{}`: {problem}",
            shown(&self.cells[column][row])
        )
    }
}

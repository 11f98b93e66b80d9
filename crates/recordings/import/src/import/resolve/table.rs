//! A table of the cells that a map names, and one whose columns are named as they are.

use std::path::{Path, PathBuf};

use taceva_core::SourceUnit;

use super::Sources;
use crate::csv_table::{CsvTable, number};
use taceva_dataset::DatasetError;
use taceva_dataset::Place;
use taceva_dataset::internal::shown;

/// The rows that an import reads.
pub(in crate::import) enum RowTable {
    /// Every column is one of the file.
    AsItLies(CsvTable),
    Resolved(ResolvedTable),
}

/// The cells of the columns that a map names.
pub(in crate::import) struct ResolvedTable {
    path: PathBuf,
    /// The path relative to the folder of the lab.
    relative: String,
    names: Vec<String>,
    /// For each column the cell of each row.
    cells: Vec<Vec<String>>,
    /// Where each row stands.
    places: Vec<Place>,
    /// For each row the join in which no row belongs to it, where that leaves the row out.
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

    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    pub(super) fn rows(&self) -> usize {
        self.places.len()
    }

    /// Where the column called `name` stands; every one that the map names is there.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// The number in a cell.
    pub(super) fn number(&self, row: usize, column: usize) -> Result<Option<f64>, DatasetError> {
        let cell = &self.cells[column][row];
        number::number(cell).map_err(|problem| self.refuse(row, column, &problem))
    }

    /// Adds a column.
    pub(super) fn push(&mut self, name: String, cells: Vec<String>) {
        self.names.push(name);
        self.cells.push(cells);
    }

    fn place(&self, row: usize, column: usize) -> Place {
        let mut place = self.places[row].clone();
        place.column = self.names.get(column).cloned();
        place
    }

    fn refuse(&self, row: usize, column: usize, problem: &str) -> DatasetError {
        DatasetError::Table {
            place: self.place(row, column),
            problem: format!("`{}`: {problem}", shown(&self.cells[column][row])),
        }
    }
}

impl RowTable {
    pub(in crate::import) fn path(&self) -> &Path {
        match self {
            RowTable::AsItLies(table) => table.path(),
            RowTable::Resolved(table) => &table.path,
        }
    }

    /// The path of the table in the folder of the lab, where rows keep it.
    pub(in crate::import) fn source(&self) -> Option<&str> {
        match self {
            RowTable::AsItLies(_) => None,
            RowTable::Resolved(table) => Some(&table.relative),
        }
    }

    pub(in crate::import) fn rows(&self) -> usize {
        match self {
            RowTable::AsItLies(table) => table.rows(),
            RowTable::Resolved(table) => table.rows(),
        }
    }

    pub(in crate::import) fn names(&self) -> &[String] {
        match self {
            RowTable::AsItLies(table) => table.names(),
            RowTable::Resolved(table) => &table.names,
        }
    }

    pub(in crate::import) fn position(&self, name: &str) -> Result<usize, DatasetError> {
        match self {
            RowTable::AsItLies(table) => table.position(name),
            RowTable::Resolved(table) => table.find(name).ok_or_else(|| DatasetError::Table {
                place: Place::file(&table.path),
                problem: format!("no column `{}`", shown(name)),
            }),
        }
    }

    pub(in crate::import) fn cell(&self, row: usize, column: usize) -> &str {
        match self {
            RowTable::AsItLies(table) => table.cell(row, column),
            RowTable::Resolved(table) => table.cells[column][row].trim(),
        }
    }

    pub(in crate::import) fn place(&self, row: usize, column: usize) -> Place {
        match self {
            RowTable::AsItLies(table) => table.place(row, column),
            RowTable::Resolved(table) => table.place(row, column),
        }
    }

    pub(in crate::import) fn number(
        &self,
        row: usize,
        column: usize,
    ) -> Result<Option<f64>, DatasetError> {
        match self {
            RowTable::AsItLies(table) => table.number(row, column),
            RowTable::Resolved(table) => table.number(row, column),
        }
    }

    pub(in crate::import) fn number_in_unit(
        &self,
        row: usize,
        column: usize,
        unit: &SourceUnit,
    ) -> Result<Option<f64>, DatasetError> {
        match self {
            RowTable::AsItLies(table) => table.number_in_unit(row, column, unit),
            RowTable::Resolved(table) => {
                let cell = table.cells[column][row].trim();
                let number = number::number_in_unit(cell, unit);
                number.map_err(|problem| table.refuse(row, column, &problem))
            }
        }
    }

    /// Why a row is left out before its cells are looked at.
    pub(in crate::import) fn unmatched(&self, row: usize) -> Option<&str> {
        match self {
            RowTable::AsItLies(_) => None,
            RowTable::Resolved(table) => table.unmatched[row].as_deref(),
        }
    }
}

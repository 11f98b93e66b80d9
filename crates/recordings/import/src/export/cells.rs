//! Converts columns of a dataset to cells of tables of other programs.

use taceva_arrays::{ArrayError, Problem};
use taceva_tables::{Cell, TableError, WrittenKind};

use super::content::Exported;
use super::picture::Encoded;
use crate::error::ImportError;
use taceva_dataset::DatasetError;
use taceva_dataset::internal::Cells;

/// Kind of the cells of a column.
pub(super) fn kind(cells: &Cells<'_>) -> WrittenKind {
    match cells {
        Cells::Number(_) | Cells::Measured(_) | Cells::Spacing(_) => WrittenKind::Number,
        Cells::Count(_) => WrittenKind::Integer,
        _ => WrittenKind::Text,
    }
}

/// Cell of `row` for a table of another program; null if the dataset has no value.
pub(super) fn cell(cells: &Cells<'_>, row: usize) -> Cell {
    let found = match cells {
        Cells::Number(_) | Cells::Measured(_) | Cells::Spacing(_) => {
            cells.number(row).map(Cell::Number)
        }
        Cells::Count(counts) => counts[row].map(|count| Cell::Integer(count.into())),
        _ => cells.text(row).map(Cell::Text),
    };
    found.unwrap_or(Cell::Null)
}

/// Picture of the sample called `sample`; null if the sample has no picture.
pub(super) fn picture(picture: Option<Encoded>, sample: &str) -> Cell {
    let Some(Encoded { bytes, extension }) = picture else {
        return Cell::Null;
    };
    let path = Cell::Text(format!("{sample}.{extension}"));
    Cell::Struct(vec![
        ("bytes".to_owned(), Cell::Bytes(bytes)),
        ("path".to_owned(), path),
    ])
}

impl Exported<'_> {
    /// Taxel values of a row as a list.
    pub(super) fn signals_cell(&self, row: usize) -> Result<Cell, ImportError> {
        let numbers = self.signals(row)?.into_iter();
        Ok(Cell::List(
            numbers.map(|number| Cell::Number(number.into())).collect(),
        ))
    }

    /// Returns `name`, with `_` appended until no column has the same name.
    pub(super) fn free_name(&self, name: &str) -> String {
        let mut free = name.to_owned();
        while self.columns.iter().any(|column| column.name == free) {
            free.push('_');
        }
        free
    }
}

/// Converts an error of a table writer.
pub(super) fn of_table(error: TableError) -> ImportError {
    match error {
        TableError::Write { path, source } => ImportError::io("write", &path)(source),
        other => {
            let problem = crate::foreign::said(other.path(), &other);
            DatasetError::damaged(other.path(), problem).into()
        }
    }
}

/// Converts an error of an array writer.
pub(super) fn of_arrays(error: ArrayError) -> ImportError {
    match error.problem {
        Problem::Io { doing, source } => ImportError::io(doing, &error.path)(source),
        _ => DatasetError::damaged(&error.path, crate::foreign::said(&error.path, &error)).into(),
    }
}

//! Reads rows of a Parquet table as text, part by part. Cells are formatted as in CSV, so that both formats are parsed and rejected alike.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;

use taceva_import::{CsvTable, ImportError};
use taceva_tables::ParquetTable;

use crate::error::EvaluateError;

/// First and last bytes of every Parquet file.
const MARK: &[u8; 4] = b"PAR1";

/// True if the file at `path` begins and ends with the Parquet magic bytes. False if the file cannot be read; the reader then reports the error.
pub(super) fn is_parquet(path: &Path) -> bool {
    if !path.is_file() {
        return false;
    }
    let marks = File::open(path).and_then(|mut file| {
        let mut marks = [[0; 4]; 2];
        file.read_exact(&mut marks[0])?;
        file.seek(SeekFrom::End(-4))?;
        file.read_exact(&mut marks[1])?;
        Ok(marks)
    });
    marks.is_ok_and(|marks| marks == [*MARK; 2])
}

/// Reads the selected columns of some rows.
///
/// # Errors
/// [`EvaluateError::Parquet`] if the file cannot be read. [`EvaluateError::Table`] for more text than one part can contain.
pub(super) fn read(
    table: &ParquetTable,
    names: &[String],
    rows: Range<u64>,
) -> Result<CsvTable, EvaluateError> {
    let mut columns = Vec::with_capacity(names.len());
    for name in names {
        let mut cells: Vec<String> = Vec::new();
        table.visit_rows(name, rows.clone(), &mut |cell| {
            cells.push(cell.text().into_owned());
            Ok(())
        })?;
        columns.push(cells);
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let count = usize::try_from(rows.end - rows.start).unwrap_or(usize::MAX);
    let row = |at: usize| columns.iter().map(move |cells| cells[at].as_str());
    let read = CsvTable::of_cells(table.path(), &names, (0..count).map(row));
    read.map_err(|error| by_row(error, rows.start).into())
}

/// Replaces the line of an error by a row number, because a Parquet file has no lines.
pub(super) fn by_row(mut error: ImportError, first: u64) -> ImportError {
    if let ImportError::Table { place, .. } = &mut error
        && let Some(line) = place.line.take()
    {
        // The header is line 1.
        place.row = Some(first + line.saturating_sub(2));
    }
    error
}

//! Computes channels as a matrix times columns.

use super::table::ResolvedTable;
use crate::csv_table::CsvTable;
use crate::error::ImportError;
use crate::import::map::{MatrixMap, MatrixRows};
use crate::source_folder::SourceFolder;

/// Adds the products of the matrix `map` to `table`, as columns. A product is empty if the cell of one of its columns is empty.
pub(super) fn apply(
    map: &MatrixMap,
    folder: &SourceFolder,
    table: &mut ResolvedTable,
) -> Result<(), ImportError> {
    let rows = matrix_rows(map, folder)?;
    let columns: Vec<usize> = map
        .from
        .iter()
        .filter_map(|name| table.find(name))
        .collect();
    let mut products = vec![Vec::with_capacity(table.rows()); map.gives.len()];
    for row in 0..table.rows() {
        let numbers: Result<Option<Vec<f64>>, ImportError> = columns
            .iter()
            .map(|column| table.number(row, *column))
            .collect();
        let numbers = numbers?;
        for (product, factors) in products.iter_mut().zip(&rows) {
            product.push(match &numbers {
                None => String::new(),
                // Shortest form that reads back to the same number.
                Some(numbers) => format!("{:?}", times(factors, numbers, &map.offset)),
            });
        }
    }
    for (position, cells) in products.into_iter().enumerate() {
        table.push(map.column(position), cells);
    }
    Ok(())
}

/// Rows of the matrix, one per channel.
pub(in crate::import) fn matrix_rows(
    map: &MatrixMap,
    folder: &SourceFolder,
) -> Result<Vec<Vec<f64>>, ImportError> {
    match &map.by {
        MatrixRows::Written(rows) => Ok(rows.clone()),
        MatrixRows::File(file) => of_file(map, folder, file),
    }
}

fn times(factors: &[f64], numbers: &[f64], offset: &[f64]) -> f64 {
    let terms = factors.iter().zip(numbers.iter().zip(offset));
    terms
        .map(|(factor, (number, offset))| factor * (number - offset))
        .sum()
}

/// Reads the matrix from a headerless CSV file.
fn of_file(
    map: &MatrixMap,
    folder: &SourceFolder,
    file: &str,
) -> Result<Vec<Vec<f64>>, ImportError> {
    let path = folder.file(folder.path(), file)?;
    let table = CsvTable::read_headerless(&path)?;
    let number = |row, column| {
        let number = table.number(row, column)?;
        number.ok_or_else(|| {
            table.refuse(
                row,
                column,
                "empty, expected a number in every cell of the matrix",
            )
        })
    };
    let columns = table.names().len();
    let rows: Result<Vec<Vec<f64>>, ImportError> = (0..table.rows())
        .map(|row| (0..columns).map(|column| number(row, column)).collect())
        .collect();
    let rows = rows?;
    match map.problem(&rows) {
        None => Ok(rows),
        Some(problem) => Err(ImportError::table(&path, problem)),
    }
}

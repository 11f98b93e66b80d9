//! Reader of the cells of a row range of a column. Other rows are not kept in memory.

use std::ops::Range;

use super::assembly::Assembly;
use super::column_path::Found;
use super::{ParquetTable, ROWS_AT_ONCE, rows_of};
use crate::cell::Cell;
use crate::error::TableError;

impl ParquetTable {
    /// Calls `each` with each cell of `rows` in the column `name`. Row groups outside `rows` are not read, and pages before the first row are
    /// skipped. Keeps at most a few hundred cells in memory.
    ///
    /// ```
    /// use taceva_tables::{Cell, ParquetTable};
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.parquet");
    /// let table = ParquetTable::open(path.as_ref())?;
    /// let mut cells = Vec::new();
    /// table.visit_rows("ft[2]", 1..3, &mut |cell| {
    ///     cells.push(cell);
    ///     Ok(())
    /// })?;
    /// assert_eq!(cells, [Cell::Number(3.5), Cell::Null]);
    /// # Ok::<(), taceva_tables::TableError>(())
    /// ```
    ///
    /// # Errors
    /// Errors of [`column`](Self::column). [`TableError::Mismatch`] for rows that do not exist. Errors of `each`.
    pub fn visit_rows(
        &self,
        name: &str,
        rows: Range<u64>,
        each: &mut dyn FnMut(Cell) -> Result<(), TableError>,
    ) -> Result<(), TableError> {
        let found = Found::new(&self.source, &self.columns, name)?;
        if rows.end > self.rows {
            let problem = format!(
                "row {} was requested, but there are {} rows, counted from 0",
                rows.end - 1,
                self.rows
            );
            return Err(self.source.mismatch(name, problem));
        }
        let mut begin = 0;
        for group in self.metadata.row_groups() {
            let end = begin + rows_of(group) as u64;
            let here = rows.start.max(begin)..rows.end.min(end);
            if here.start < here.end {
                let mut assembly = Assembly::new(&self.source, group, found.column())?;
                assembly.skip(small(here.start - begin))?;
                let mut row = small(here.start);
                let mut left = small(here.end - here.start);
                while left > 0 {
                    let count = left.min(ROWS_AT_ONCE);
                    assembly.read(&self.source, count, &mut |cell| {
                        let cell = found.inside(&self.source, row, cell)?;
                        row += 1;
                        each(cell)
                    })?;
                    left -= count;
                }
            }
            begin = end;
        }
        Ok(())
    }
}

/// Converts a number of rows to `usize`. The number is known to fit.
fn small(rows: u64) -> usize {
    usize::try_from(rows).unwrap_or(usize::MAX)
}

//! Visits the cells of whole columns, in a table in memory or read part by part.

use taceva_import::{CsvParts, CsvTable};

use super::table_parts::Reader;
use crate::error::EvaluateError;

/// A table whose columns can be visited.
pub(super) trait WholeColumns {
    /// Passes the cells of the column `name` to `visit` until it returns false.
    ///
    /// # Errors
    /// [`EvaluateError`] if there is no such column, or if the column cannot be read.
    fn visit(&self, name: &str, visit: &mut dyn FnMut(&str) -> bool) -> Result<(), EvaluateError>;
}

impl WholeColumns for CsvTable {
    fn visit(&self, name: &str, visit: &mut dyn FnMut(&str) -> bool) -> Result<(), EvaluateError> {
        let column = self.position(name)?;
        let _ = (0..self.rows()).all(|row| visit(self.cell(row, column)));
        Ok(())
    }
}

/// A table that is read part by part.
pub(super) struct Parts<'a> {
    reader: &'a Reader<'a>,
    parts: u64,
}

impl<'a> Parts<'a> {
    /// Creates a view of a table with `rows` rows.
    pub(super) fn new(reader: &'a Reader<'a>, rows: u64) -> Parts<'a> {
        Parts {
            reader,
            parts: rows.div_ceil(CsvParts::ROWS),
        }
    }
}

impl WholeColumns for Parts<'_> {
    fn visit(&self, name: &str, visit: &mut dyn FnMut(&str) -> bool) -> Result<(), EvaluateError> {
        for part in 0..self.parts {
            let table = self.reader.read(part)?;
            let column = table.position(name)?;
            if !(0..table.rows()).all(|row| visit(table.cell(row, column))) {
                break;
            }
        }
        Ok(())
    }
}

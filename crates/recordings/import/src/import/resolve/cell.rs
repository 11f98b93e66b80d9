//! Reads one cell of a table of any form.

use super::columns::indexed;
use crate::error::ImportError;
use crate::foreign::{ForeignTable, cell_list};

/// Cell of a row in the column `name`. The name `key` means the row's name in a JSON object, and `ft[2]` one element of the list in the cell.
pub(super) fn cell_of(table: &ForeignTable, row: usize, name: &str) -> Result<String, ImportError> {
    if table.has(name) {
        return Ok(cell_list::plain(&table.cell(row, name)?).to_owned());
    }
    if let Some(key) = table.key(row).filter(|_| name == "key") {
        return Ok(key.to_owned());
    }
    let Some((base, index)) = indexed(name) else {
        return Err(table.no_column(name));
    };
    let cell = table.cell(row, base)?;
    if cell.is_empty() {
        return Ok(String::new());
    }
    let found = cell_list::value(&cell, &index);
    found
        .map(|found| match table {
            ForeignTable::Columns(_) | ForeignTable::Json(_) if found.is_null() => String::new(),
            _ => found.text.into_owned(),
        })
        .map_err(|problem| ImportError::table(table.place(row, base), problem))
}

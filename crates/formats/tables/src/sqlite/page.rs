//! Reader of the pages of an SQLite database, with its own cursor.

use std::fs::File;
use std::sync::Arc;

use super::{Database, RowPlace};
use crate::error::{Place, TableError};

/// Reader of the pages of a database, which caches the last page. Each row is read once, or several times in succession.
pub(crate) struct Pages<'a> {
    pub(super) database: &'a Database,
    file: File,
    kept: Option<(u32, Arc<Vec<u8>>)>,
    /// Location of the row that was counted last.
    row: Option<RowPlace>,
    /// Total size of all counted rows, bytes.
    row_bytes: u64,
}

impl<'a> Pages<'a> {
    pub(crate) fn new(database: &'a Database) -> Result<Pages<'a>, TableError> {
        Ok(Pages {
            database,
            file: database.source.open()?,
            kept: None,
            row: None,
            row_bytes: 0,
        })
    }

    /// Reads the page with the number `number`, counted from 1.
    pub(super) fn page(&mut self, number: u32) -> Result<Arc<Vec<u8>>, TableError> {
        if let Some((kept, page)) = &self.kept
            && *kept == number
        {
            return Ok(Arc::clone(page));
        }
        let page = Arc::new(self.read(number)?);
        self.kept = Some((number, Arc::clone(&page)));
        Ok(page)
    }

    /// Reads the page with the number `number`, counted from 1, from the file, and does not cache it.
    pub(super) fn read(&mut self, number: u32) -> Result<Vec<u8>, TableError> {
        let database = self.database;
        if number == 0 || number > database.pages {
            let problem = format!("no page {number}, there are {}", database.pages);
            return Err(database.source.damaged(Place::default(), problem));
        }
        let bytes = u64::from(database.page_bytes);
        let at = u64::from(number - 1) * bytes;
        database.source.bytes(&mut self.file, at, bytes, bytes)
    }

    /// Adds the `bytes` bytes of the row at `place` to the total size of the rows.
    ///
    /// # Errors
    /// [`TableError::Damaged`] if the rows together are longer than the file. Rows that share bytes could otherwise cost hours.
    pub(super) fn count(&mut self, place: RowPlace, bytes: u64) -> Result<(), TableError> {
        if self.row != Some(place) {
            self.row = Some(place);
            self.row_bytes = self.row_bytes.saturating_add(bytes);
        }
        let length = self.database.source.length();
        // The end of this row may be missing in a truncated file; `uncount` then subtracts it.
        let open = match self.database.cut_at() {
            Some(_) => bytes,
            None => 0,
        };
        match self.row_bytes.saturating_sub(open) <= length {
            true => Ok(()),
            false => {
                let problem = format!(
                    "{} bytes of rows up to here, but the file has {length}: rows share their bytes. Repair a copy with `sqlite3 FILE \".recover\"`",
                    self.row_bytes
                );
                Err(self.damaged(place.page, problem))
            }
        }
    }

    /// Subtracts `bytes` from the total size of the rows, because a truncated file lacks these bytes of a row.
    pub(super) fn uncount(&mut self, bytes: u64) {
        self.row_bytes = self.row_bytes.saturating_sub(bytes);
    }

    /// True if page `number` is missing because the file was truncated.
    pub(super) fn is_beyond_cut(&self, number: u32) -> bool {
        number > self.database.pages && number <= self.database.announced
    }

    /// Error for the damaged page `number`.
    pub(super) fn damaged(&self, number: u32, problem: impl Into<String>) -> TableError {
        let at = u64::from(number.saturating_sub(1)) * u64::from(self.database.page_bytes);
        let place = Place::byte(at).in_name(&format!("page {number}"));
        self.database.source.damaged(place, problem)
    }
}

//! Pages of a database, read with one cursor.

use std::fs::File;
use std::sync::Arc;

use super::Database;
use crate::error::{Place, TableError};

/// Pages of a database. The last one is cached.
pub(crate) struct Pages<'a> {
    pub(super) database: &'a Database,
    file: File,
    kept: Option<(u32, Arc<Vec<u8>>)>,
}

impl<'a> Pages<'a> {
    pub(crate) fn new(database: &'a Database) -> Result<Pages<'a>, TableError> {
        Ok(Pages {
            database,
            file: database.source.open()?,
            kept: None,
        })
    }

    /// Page with this number, from 1.
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

    /// Page with this number, read again and not cached.
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

    /// Error for a damaged page with this number.
    pub(super) fn damaged(&self, number: u32, problem: impl Into<String>) -> TableError {
        let at = u64::from(number.saturating_sub(1)) * u64::from(self.database.page_bytes);
        let place = Place::byte(at).in_name(&format!("page {number}"));
        self.database.source.damaged(place, problem)
    }
}

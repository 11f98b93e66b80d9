//! A table whose columns are read one by one, each when it is first asked for: arrays, Parquet, messages.

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::pictures::Pictures;
use crate::error::{DatasetError, Place};
use crate::guard::guarded;
use crate::import::FrameNames;

/// What a table of columns is read from.
pub(crate) trait ColumnSource: fmt::Debug + Send + Sync {
    fn rows(&self) -> usize;

    /// The columns that a map may want.
    fn names(&self) -> Vec<String>;

    /// Whether there is a column of exactly this name.
    fn has(&self, name: &str) -> bool;

    /// The cell of each row: texts as they are, numbers in the shortest form that reads back as the same 64 bits, several as `[1.0, 2.0]`.
    fn column(&self, name: &str) -> Result<Vec<String>, String>;

    /// The pictures that belong to the rows, by the number of the row.
    fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, String>;
}

/// A table of columns.
#[derive(Debug)]
pub(crate) struct ColumnTable {
    path: PathBuf,
    source: Box<dyn ColumnSource>,
    read: Mutex<BTreeMap<String, Arc<Vec<String>>>>,
}

impl ColumnTable {
    /// The table that `open` reads of the file at `path`; what goes wrong in it, a panic of a decoder too, is said of that file.
    pub(super) fn open<S: ColumnSource + 'static>(
        path: &Path,
        open: impl FnOnce() -> Result<S, String>,
    ) -> Result<ColumnTable, DatasetError> {
        let source = guarded(open).and_then(|opened| opened);
        Ok(ColumnTable {
            source: Box::new(source.map_err(|problem| wrong(path, problem))?),
            path: path.to_owned(),
            read: Mutex::default(),
        })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn rows(&self) -> usize {
        self.source.rows()
    }

    pub(super) fn names(&self) -> Vec<String> {
        self.source.names()
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.source.has(name)
    }

    pub(super) fn cell(&self, row: usize, name: &str) -> Result<String, DatasetError> {
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        let column = match read.get(name) {
            Some(column) => Arc::clone(column),
            None => {
                let column = Arc::new(self.column(name)?);
                read.insert(name.to_owned(), Arc::clone(&column));
                column
            }
        };
        Ok(column[row].clone())
    }

    fn column(&self, name: &str) -> Result<Vec<String>, DatasetError> {
        let column = guarded(|| self.source.column(name)).and_then(|column| column);
        let column = column.map_err(|problem| DatasetError::Table {
            place: Place {
                column: Some(name.to_owned()),
                ..Place::file(&self.path)
            },
            problem,
        })?;
        match (column.len(), self.rows()) {
            (found, expected) if found == expected => Ok(column),
            (found, expected) => Err(wrong(
                &self.path,
                format!("{found} values of `{name}` for {expected} rows"),
            )),
        }
    }

    /// The pictures that belong to the rows.
    pub(super) fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, DatasetError> {
        let pictures = guarded(|| self.source.pictures(names)).and_then(|found| found);
        pictures.map_err(|problem| wrong(&self.path, problem))
    }
}

fn wrong(path: &Path, problem: String) -> DatasetError {
    DatasetError::Table {
        place: Place::file(path),
        problem,
    }
}

//! A table of scores of any length, CSV or Parquet, read in parts.

use std::fs::{self, File};
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use serde::{Deserialize, Serialize};
use taceva_dataset::{DatasetError, Digest};
use taceva_import::{CsvParts, CsvTable};
use taceva_tables::ParquetTable;

use super::parquet_parts;
use crate::error::EvaluateError;

/// A table of any length: the positions of its rows, and the digest of its content.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TableParts {
    path: PathBuf,
    stamp: Stamp,
    digest: Digest,
    rows: u64,
    /// Row positions in a CSV file; `None` for a Parquet file, which contains its own row positions.
    csv: Option<CsvParts>,
}

/// Identity of a scanned file: its length and modification time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stamp {
    bytes: u64,
    /// Modification time in nanoseconds since 1970; `None` if the file system does not record it.
    changed_ns: Option<u64>,
}

impl TableParts {
    /// Scans the file at `path` once.
    ///
    /// # Errors
    /// [`EvaluateError`] if the file is not a table, or cannot be read.
    pub(super) fn scan(path: &Path) -> Result<TableParts, EvaluateError> {
        let io = |error| read_error(path, error);
        if !parquet_parts::is_parquet(path) {
            // Recorded before the pass, so that a change during it is detected later.
            let stamp = Stamp::of(path);
            let parts = CsvParts::scan(path)?;
            return Ok(TableParts {
                path: path.to_owned(),
                stamp: stamp.map_err(io)?,
                digest: parts.digest(),
                rows: parts.rows(),
                csv: Some(parts),
            });
        }
        let stamp = Stamp::of(path).map_err(io)?;
        let digest = File::open(path).and_then(|mut file| Digest::of_reader(&mut file));
        Ok(TableParts {
            path: path.to_owned(),
            stamp,
            digest: digest.map_err(io)?,
            rows: ParquetTable::open(path)?.rows(),
            csv: None,
        })
    }

    /// Returns the table; scans its file again if it has changed.
    ///
    /// # Errors
    /// [`EvaluateError::Tables`] if the content of the file has changed.
    pub(super) fn again(self) -> Result<TableParts, EvaluateError> {
        let stamp = Stamp::of(&self.path).map_err(|error| read_error(&self.path, error))?;
        if stamp == self.stamp && stamp.changed_ns.is_some() {
            return Ok(self);
        }
        let now = TableParts::scan(&self.path)?;
        match now.digest == self.digest {
            true => Ok(now),
            false => Err(EvaluateError::Tables {
                path: self.path,
                problem: format!(
                    "the table has changed since the sweep was planned: digest {}, expected {}; start the sweep again",
                    now.digest, self.digest
                ),
            }),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn digest(&self) -> Digest {
        self.digest
    }

    pub(super) fn rows(&self) -> u64 {
        self.rows
    }

    /// Reader of the table.
    ///
    /// # Errors
    /// [`EvaluateError`] if the file cannot be opened.
    pub(super) fn reader(&self) -> Result<Reader<'_>, EvaluateError> {
        match &self.csv {
            Some(parts) => Ok(Reader::Csv(parts)),
            None => {
                let table = ParquetTable::open(&self.path)?;
                let names = table.names();
                Ok(Reader::Parquet(Box::new(table), names))
            }
        }
    }
}

impl Stamp {
    fn of(path: &Path) -> io::Result<Stamp> {
        let facts = fs::metadata(path)?;
        let changed = facts.modified().ok();
        let changed = changed.and_then(|changed| changed.duration_since(UNIX_EPOCH).ok());
        Ok(Stamp {
            bytes: facts.len(),
            changed_ns: changed.and_then(|changed| u64::try_from(changed.as_nanos()).ok()),
        })
    }
}

/// Reader of parts of a table. From a Parquet table, it reads only the selected columns.
#[derive(Debug)]
pub(super) enum Reader<'a> {
    Csv(&'a CsvParts),
    Parquet(Box<ParquetTable>, Vec<String>),
}

impl Reader<'_> {
    /// Names of all columns, as a table without rows.
    pub(super) fn header(&self) -> Result<CsvTable, EvaluateError> {
        match self {
            Reader::Csv(parts) => Ok(parts.header()?),
            Reader::Parquet(table, names) => parquet_parts::read(table, names, 0..0),
        }
    }

    /// Restricts the reader to the columns that `is_wanted` selects, if the table is Parquet, to save time.
    pub(super) fn with_columns(self, is_wanted: impl Fn(&str) -> bool) -> Self {
        match self {
            Reader::Parquet(table, mut names) => {
                names.retain(|name| is_wanted(name));
                Reader::Parquet(table, names)
            }
            csv => csv,
        }
    }

    /// Reads the rows of a part, which has [`CsvParts::ROWS`] rows.
    pub(super) fn read(&self, part: u64) -> Result<CsvTable, EvaluateError> {
        match self {
            Reader::Csv(parts) => Ok(parts.read(usize::try_from(part).unwrap_or(usize::MAX))?),
            Reader::Parquet(table, names) => {
                parquet_parts::read(table, names, rows_of(part, table.rows()))
            }
        }
    }

    pub(super) fn whole(&self, rows: u64) -> Result<CsvTable, EvaluateError> {
        match self {
            Reader::Csv(parts) => Ok(CsvTable::read(parts.path())?),
            Reader::Parquet(table, names) => parquet_parts::read(table, names, 0..rows),
        }
    }

    /// Converts the location in `error` from the part to the file.
    pub(super) fn placed(&self, error: EvaluateError, part: u64) -> EvaluateError {
        match (self, error) {
            (Reader::Parquet(table, _), EvaluateError::Table(error)) => {
                parquet_parts::by_row(error, rows_of(part, table.rows()).start).into()
            }
            (_, error) => error,
        }
    }
}

pub(super) fn rows_of(part: u64, rows: u64) -> Range<u64> {
    let begin = part * CsvParts::ROWS;
    begin.min(rows)..(begin + CsvParts::ROWS).min(rows)
}

fn read_error(path: &Path, source: io::Error) -> EvaluateError {
    DatasetError::io("read", path)(source).into()
}

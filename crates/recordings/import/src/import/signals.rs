//! Plans the signals of the kept rows, and writes them when the import runs.

mod array;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use taceva_core::Progress;

use super::map::{SignalsFrom, SignalsMap};
use super::rows::MappedTable;
use crate::error::{ImportError, table_error};
use crate::source_folder::SourceFolder;
use array::ArraySignals;
use taceva_dataset::internal::SignalsWriter;
use taceva_dataset::{DatasetError, SignalsInfo, SignalsSpec};

/// Signals of the kept rows during planning.
#[derive(Debug)]
pub(super) struct FoundSignals<'a> {
    map: &'a SignalsMap,
    from: Found,
    /// Number of rows that were kept.
    kept: u64,
    /// Ranges of kept rows without contact.
    rest: Vec<[u64; 2]>,
    /// Rows of the array with a number that means "not measured".
    placeholders: BTreeSet<u64>,
}

#[derive(Debug)]
enum Found {
    /// Taxel values in memory, row by row.
    Numbers(Vec<f32>),
    /// Array that is read when the import runs, and the wanted rows.
    Array(ArraySignals, Vec<u64>),
}

/// Signals that an import writes.
#[derive(Debug)]
pub(super) struct PlannedSignals {
    map: SignalsMap,
    spec: SignalsSpec,
    from: Found,
}

impl<'a> FoundSignals<'a> {
    pub(super) fn new(
        map: &'a SignalsMap,
        folder: &SourceFolder,
    ) -> Result<FoundSignals<'a>, ImportError> {
        let from = match &map.from {
            SignalsFrom::Columns(_) => Found::Numbers(Vec::new()),
            SignalsFrom::Array { file, path } => {
                let file = folder.file(folder.path(), file)?;
                let array = ArraySignals::open(&file, path.as_deref(), map)?;
                Found::Array(array, Vec::new())
            }
        };
        let placeholders = match &from {
            Found::Array(array, _) if !map.placeholders.is_empty() => array.placeholders(map)?,
            _ => BTreeSet::new(),
        };
        Ok(FoundSignals {
            map,
            placeholders,
            from,
            kept: 0,
            rest: Vec::new(),
        })
    }

    /// True if the row `number` of the array contains a number that means "not measured". `number` counts the rows of all tables.
    pub(super) fn is_placeholder(&self, number: u64) -> bool {
        self.placeholders.contains(&number)
    }

    /// Adds the signals of a kept row, whose index over all tables is `number`.
    pub(super) fn take(
        &mut self,
        rows: &MappedTable<'_>,
        row: usize,
        number: u64,
    ) -> Result<(), ImportError> {
        match &mut self.from {
            Found::Numbers(numbers) => {
                let own = rows.signals(row).unwrap_or_default();
                if let Some(position) = own.iter().position(|number| !number.is_finite()) {
                    return Err(self.none_at(rows, row, position));
                }
                numbers.extend_from_slice(own);
            }
            Found::Array(array, taken) => {
                array.check_row(number)?;
                taken.push(number);
            }
        }
        if self.map.is_rest(number) {
            match self.rest.last_mut() {
                Some([_, last]) if *last + 1 == self.kept => *last = self.kept,
                _ => self.rest.push([self.kept; 2]),
            }
        }
        self.kept += 1;
        Ok(())
    }

    /// Error for a row whose signal at `position` is not a number.
    fn none_at(&self, rows: &MappedTable<'_>, row: usize, position: usize) -> ImportError {
        let columns = self.map.columns();
        let length = self.map.spec.info.len();
        let expected = format!("a finite number of {}", self.map.unit.symbol());
        let (column, problem) = match columns {
            [only] => (
                Some(only),
                format!("expected {length} numbers in the cell, each {expected}"),
            ),
            _ => {
                let info = self.map.spec.info;
                let (depth, places) = (info.channels as usize, length / info.channels as usize);
                let at = match self.map.is_channel_first {
                    true => position % depth * places + position / depth,
                    false => position,
                };
                (columns.get(at), format!("no number, expected {expected}"))
            }
        };
        table_error!(
            match column {
                Some(column) => rows.place(row).in_column(column),
                None => rows.place(row),
            },
            "[signals]: {problem}"
        )
    }

    /// Adds the number of unwritten chunks of the array, if the signals are in an array, to `into`.
    pub(super) fn count_absent_chunks(
        &self,
        folder: &SourceFolder,
        into: &mut BTreeMap<String, u64>,
    ) -> Result<(), ImportError> {
        match &self.from {
            Found::Numbers(_) => Ok(()),
            Found::Array(array, _) => array.count_absent_chunks(folder, into),
        }
    }

    pub(super) fn into_plan(self, rows_read: u64) -> Result<PlannedSignals, ImportError> {
        if let Found::Array(array, _) = &self.from {
            array.check_rows(rows_read)?;
        }
        Ok(PlannedSignals {
            spec: self.map.spec.clone().with_rest(self.rest),
            map: self.map.clone(),
            from: self.from,
        })
    }
}

impl PlannedSignals {
    /// Taxels, with the ranges of rows without contact.
    pub(super) fn spec(&self) -> &SignalsSpec {
        &self.spec
    }

    /// Writes the signals to `path`.
    pub(super) fn write(
        &self,
        path: &Path,
        progress: &dyn Progress,
    ) -> Result<SignalsInfo, ImportError> {
        let mut writer = SignalsWriter::create(path, &self.spec)?;
        self.write_to(&mut writer, progress)?;
        Ok(writer.finish()?)
    }

    /// Appends the signals to `writer`. An array is read in blocks of rows, to save memory.
    pub(super) fn write_to(
        &self,
        writer: &mut SignalsWriter,
        progress: &dyn Progress,
    ) -> Result<(), ImportError> {
        match &self.from {
            Found::Numbers(numbers) => {
                for row in numbers.chunks_exact(self.spec.info.len()) {
                    if progress.is_cancelled() {
                        return Err(DatasetError::Cancelled.into());
                    }
                    writer.push(row)?;
                }
            }
            Found::Array(array, rows) => array.write(&self.map, rows, writer, progress)?,
        }
        Ok(())
    }
}

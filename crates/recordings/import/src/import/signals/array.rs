//! Signals in an array of another file, read in blocks of rows.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use taceva_core::{Progress, single};

use crate::error::{ImportError, table_error};
use crate::foreign::{OneArray, stated};
use crate::import::map::SignalsMap;
use crate::import::resolve::{place_first, problem_of_names, problem_of_signals};
use crate::source_folder::SourceFolder;
use taceva_dataset::DatasetError;
use taceva_dataset::internal::{SignalsWriter, guarded};

/// Number of values per read: 8 MiB as `f64`.
const READ_VALUES: u64 = 1 << 20;

/// Array of signals.
#[derive(Debug)]
pub(super) struct ArraySignals {
    array: OneArray,
    rows: u64,
    length: u64,
}

impl ArraySignals {
    /// Opens the array `name` of the file at `path`, or its only array, and checks the axes against `map`.
    pub(super) fn open(
        path: &Path,
        name: Option<&str>,
        map: &SignalsMap,
    ) -> Result<ArraySignals, ImportError> {
        let wrong = |problem: String| ImportError::table(path, problem);
        let array = OneArray::open(path, name)?;
        let (rows, beside) = match array.shape() {
            [rows, beside @ ..] => (*rows, beside),
            [] => (0, &[][..]),
        };
        let shown_name = taceva_dataset::internal::shown(array.name());
        if rows == 0 {
            return Err(wrong(format!(
                "`{shown_name}` of shape {:?} has no row of signals",
                array.shape()
            )));
        }
        let of_file = guarded(|| stated(array.file(), array.name())).map_err(wrong)?;
        let contradicted = problem_of_signals(&of_file, &map.unit);
        // An array in a `.npy` file is named by the file.
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let named = match array.name() {
            "value" => stem.as_ref(),
            name => name,
        };
        if let Some(problem) = contradicted.or_else(|| problem_of_names([named], &map.unit)) {
            return Err(wrong(format!("`{shown_name}`: {problem}")));
        }
        map.check_axes(beside)
            .map_err(|problem| wrong(format!("`{shown_name}`: {problem}")))?;
        Ok(ArraySignals {
            rows,
            length: map.spec.info.len() as u64,
            array,
        })
    }

    pub(super) fn check_row(&self, row: u64) -> Result<(), ImportError> {
        match row < self.rows {
            true => Ok(()),
            false => Err(table_error!(
                self.array.path(),
                "{} rows of signals, and the table has more",
                self.rows
            )),
        }
    }

    /// Checks that the array has `rows` rows, the number of rows of all tables.
    pub(super) fn check_rows(&self, rows: u64) -> Result<(), ImportError> {
        match rows == self.rows {
            true => Ok(()),
            false => Err(table_error!(
                self.array.path(),
                "{} rows of signals for {rows} rows of the table",
                self.rows
            )),
        }
    }

    /// Adds the number of unwritten chunks of the array to `into`.
    pub(super) fn count_absent_chunks(
        &self,
        folder: &SourceFolder,
        into: &mut BTreeMap<String, u64>,
    ) -> Result<(), ImportError> {
        let count = self.array.absent_chunks()?;
        if count > 0 {
            into.insert(folder.inside(self.array.path(), self.array.name()), count);
        }
        Ok(())
    }

    /// Rows that contain a number that means "not measured".
    pub(super) fn placeholders(&self, map: &SignalsMap) -> Result<BTreeSet<u64>, ImportError> {
        let step = (READ_VALUES / self.length).max(1);
        let length = usize::try_from(self.length).unwrap_or(usize::MAX);
        let mut found = BTreeSet::new();
        let mut first = 0;
        while first < self.rows {
            let end = (first + step).min(self.rows);
            let values = self.array.read(first..end)?;
            let rows = (first..end).zip(values.chunks(length));
            let held = rows.filter(|(_, row)| row.iter().any(|value| map.is_placeholder(*value)));
            found.extend(held.map(|(row, _)| row));
            first = end;
        }
        Ok(found)
    }

    /// Writes the signals of `rows`, which must be ascending.
    pub(super) fn write(
        &self,
        map: &SignalsMap,
        rows: &[u64],
        writer: &mut SignalsWriter,
        progress: &dyn Progress,
    ) -> Result<(), ImportError> {
        let step = (READ_VALUES / self.length).max(1);
        for chunk in rows.chunk_by(|left, right| left / step == right / step) {
            if progress.is_cancelled() {
                return Err(DatasetError::Cancelled.into());
            }
            let (Some(first), Some(last)) = (chunk.first(), chunk.last()) else {
                continue;
            };
            let values = self.array.read(*first..last + 1)?;
            for row in chunk {
                let at = usize::try_from((row - first) * self.length).unwrap_or(usize::MAX);
                let length = usize::try_from(self.length).unwrap_or(0);
                let own = values.get(at..).and_then(|own| own.get(..length));
                let own =
                    own.ok_or_else(|| table_error!(self.array.path(), "row {row} is missing"))?;
                let kept: Vec<f32> = own.iter().map(|value| kept(*value, map)).collect();
                if let Some(position) = kept.iter().position(|value| !value.is_finite()) {
                    return Err(table_error!(
                        self.array.path(),
                        "row {row}: number {position} of its signals is {}, expected a finite number",
                        own[position]
                    ));
                }
                let ordered: Vec<f32> = place_first(map, &kept).collect();
                writer.push(&ordered)?;
            }
        }
        Ok(())
    }
}

/// Converts a number to the stored unit.
fn kept(value: f64, map: &SignalsMap) -> f32 {
    single(map.unit.convert(value))
}

//! Signals in an array of another file, read in blocks of rows.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use taceva_arrays::{ArrayFile, ArrayFormat};
use taceva_core::{Progress, single};

use crate::error::{ImportError, table_error};
use crate::foreign::stated;
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
    path: PathBuf,
    file: ArrayFile,
    name: String,
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
        let format = ArrayFormat::of(path).ok_or_else(|| {
            wrong(
                "not a file of arrays by its name: expected .npy, .npz, .h5, .hdf5, .zarr, .mat or .pkl"
                    .to_owned(),
            )
        })?;
        let opened = guarded(|| ArrayFile::open(path, format)).map_err(wrong)?;
        let file = opened.map_err(|error| wrong(error.to_string()))?;
        let names = file.names();
        let name = match (name, &names[..]) {
            (Some(name), _) => name.to_owned(),
            (None, [only]) => only.clone(),
            (None, _) => {
                let some: Vec<&str> = names.iter().take(16).map(String::as_str).collect();
                return Err(wrong(format!(
                    "{} arrays ({}): name one by `from = {{ file = …, path = … }}`",
                    names.len(),
                    taceva_dataset::internal::shown(&some.join(", "))
                )));
            }
        };
        let info = file.info(&name);
        let info = info.ok_or_else(|| {
            wrong(format!(
                "no array `{}`",
                taceva_dataset::internal::shown(&name)
            ))
        })?;
        let (rows, beside) = match &info.shape[..] {
            [rows, beside @ ..] => (*rows, beside),
            [] => (0, &[][..]),
        };
        let array = taceva_dataset::internal::shown(&name);
        if rows == 0 {
            return Err(wrong(format!(
                "`{array}` of shape {:?} has no row of signals",
                info.shape
            )));
        }
        let of_file = guarded(|| stated(&file, &name)).map_err(wrong)?;
        let contradicted = problem_of_signals(&of_file, &map.unit);
        // An array in a `.npy` file is named by the file.
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let named = match name.as_str() {
            "value" => stem.as_ref(),
            name => name,
        };
        if let Some(problem) = contradicted.or_else(|| problem_of_names([named], &map.unit)) {
            return Err(wrong(format!("`{array}`: {problem}")));
        }
        map.check_axes(beside)
            .map_err(|problem| wrong(format!("`{array}`: {problem}")))?;
        Ok(ArraySignals {
            path: path.to_owned(),
            file,
            name,
            rows,
            length: map.spec.info.len() as u64,
        })
    }

    pub(super) fn check_row(&self, row: u64) -> Result<(), ImportError> {
        match row < self.rows {
            true => Ok(()),
            false => Err(table_error!(
                &self.path,
                "{} rows of signals, and the table has more",
                self.rows
            )),
        }
    }

    /// Checks that the array has `rows` rows, as many as the table.
    pub(super) fn check_rows(&self, rows: u64) -> Result<(), ImportError> {
        match rows == self.rows {
            true => Ok(()),
            false => Err(table_error!(
                &self.path,
                "{} rows of signals for {rows} rows of the table",
                self.rows
            )),
        }
    }

    /// Counts the unwritten chunks of the array.
    pub(super) fn count_absent_chunks(
        &self,
        folder: &SourceFolder,
        into: &mut BTreeMap<String, u64>,
    ) -> Result<(), ImportError> {
        let wrong = |problem: String| ImportError::table(&self.path, problem);
        let counted = guarded(|| self.file.absent_chunks(&self.name)).map_err(wrong)?;
        let count = counted.map_err(|error| wrong(error.to_string()))?;
        if count > 0 {
            into.insert(folder.inside(&self.path, &self.name), count);
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
            let values = self.read(first..end)?;
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
            let values = self.read(*first..last + 1)?;
            for row in chunk {
                let at = usize::try_from((row - first) * self.length).unwrap_or(usize::MAX);
                let length = usize::try_from(self.length).unwrap_or(0);
                let own = values.get(at..).and_then(|own| own.get(..length));
                let own = own.ok_or_else(|| table_error!(&self.path, "row {row} is missing"))?;
                let kept: Vec<f32> = own.iter().map(|value| kept(*value, map)).collect();
                if let Some(position) = kept.iter().position(|value| !value.is_finite()) {
                    return Err(table_error!(
                        &self.path,
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

    fn read(&self, rows: std::ops::Range<u64>) -> Result<Vec<f64>, ImportError> {
        let wrong = |problem: String| ImportError::table(&self.path, problem);
        let read = guarded(|| self.file.read(&self.name, rows)).map_err(wrong)?;
        let read = read.map_err(|error| wrong(error.to_string()))?;
        let numbers = read.values.to_f64();
        numbers.ok_or_else(|| {
            wrong(format!(
                "`{}` holds no numbers, or numbers that 64 bits of floating point cannot represent",
                taceva_dataset::internal::shown(&self.name)
            ))
        })
    }
}

/// Converts a number to the stored unit.
fn kept(value: f64, map: &SignalsMap) -> f32 {
    single(map.unit.convert(value))
}

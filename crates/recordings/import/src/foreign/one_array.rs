//! Reads one array of a file of arrays by rows.

use std::ops::Range;
use std::path::{Path, PathBuf};

use taceva_arrays::{ArrayFile, ArrayFormat};

use crate::error::ImportError;
use taceva_dataset::internal::{guarded, shown};

/// Array of numbers in a file.
#[derive(Debug)]
pub(crate) struct OneArray {
    path: PathBuf,
    file: ArrayFile,
    name: String,
    shape: Vec<u64>,
}

impl OneArray {
    /// Opens the array `name` of the file at `path`, or its only array.
    pub(crate) fn open(path: &Path, name: Option<&str>) -> Result<OneArray, ImportError> {
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
                    "{} arrays ({}): name one by `{{ file = …, path = … }}`",
                    names.len(),
                    shown(&some.join(", "))
                )));
            }
        };
        let info = file.info(&name);
        let info = info.ok_or_else(|| wrong(format!("no array `{}`", shown(&name))))?;
        let shape = info.shape.clone();
        Ok(OneArray {
            path: path.to_owned(),
            file,
            name,
            shape,
        })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    pub(crate) fn file(&self) -> &ArrayFile {
        &self.file
    }

    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    pub(crate) fn shape(&self) -> &[u64] {
        &self.shape
    }

    /// Reads the numbers of the array in `rows`, in row order.
    pub(crate) fn read(&self, rows: Range<u64>) -> Result<Vec<f64>, ImportError> {
        let wrong = |problem: String| ImportError::table(&self.path, problem);
        let read = guarded(|| self.file.read(&self.name, rows)).map_err(wrong)?;
        let read = read.map_err(|error| wrong(error.to_string()))?;
        let numbers = read.values.to_f64();
        numbers.ok_or_else(|| {
            wrong(format!(
                "`{}` holds no numbers, or numbers that 64 bits of floating point cannot represent",
                shown(&self.name)
            ))
        })
    }

    /// Number of unwritten chunks of the array.
    pub(crate) fn absent_chunks(&self) -> Result<u64, ImportError> {
        let wrong = |problem: String| ImportError::table(&self.path, problem);
        let counted = guarded(|| self.file.absent_chunks(&self.name)).map_err(wrong)?;
        counted.map_err(|error| wrong(error.to_string()))
    }
}

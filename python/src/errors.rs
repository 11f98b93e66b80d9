//! Errors as Python exceptions.

use std::path::{Path, PathBuf};

use pyo3::create_exception;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use taceva_core::ErrorKind;
use taceva_evaluate::EvaluateError;
use taceva_import::ImportError;

create_exception!(
    taceva,
    DatasetError,
    PyValueError,
    "A recording cannot be read or written. If known, `path` is the faulty file, `row` the row of the recording from 0, and `line` the line of a table."
);
create_exception!(
    taceva,
    ModelError,
    PyValueError,
    "A model does not match the recording, or cannot be fitted to it."
);

/// `error` as a `ValueError`.
pub(crate) fn value_error(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// `error` of a recording as a `DatasetError`.
pub(crate) fn dataset_error(error: &taceva_dataset::DatasetError) -> PyErr {
    dataset_error_at(error, None)
}

/// `problem` of the recording at `path` as a `DatasetError`.
pub(crate) fn dataset_error_of(path: &Path, problem: &str) -> PyErr {
    let message = format!("{}: {problem}", taceva_core::shown(path));
    placed(message, Some(path.to_owned()), None, None)
}

/// `error` of a recording as a `DatasetError`, with the row at fault if known.
pub(crate) fn dataset_error_at(error: &taceva_dataset::DatasetError, row: Option<usize>) -> PyErr {
    let (path, own, line) = location(error);
    let row = own.or(row.and_then(|row| u64::try_from(row).ok()));
    placed(error.to_string(), path.cloned(), row, line)
}

/// `error` of an import, an export or a table as a `DatasetError`.
pub(crate) fn import_error(error: &ImportError) -> PyErr {
    let (path, row, line) = match error {
        ImportError::Table { place, .. } => (Some(&place.path), place.row, place.line),
        other => other.dataset().map_or((None, None, None), location),
    };
    placed(error.to_string(), path.cloned(), row, line)
}

/// File, row and line at fault, as far as `error` states them.
fn location(error: &taceva_dataset::DatasetError) -> (Option<&PathBuf>, Option<u64>, Option<u64>) {
    use taceva_dataset::DatasetError as Of;
    match error {
        Of::Text { place, .. } => (Some(&place.path), place.row, place.line),
        Of::Io { path, .. }
        | Of::Image { path, .. }
        | Of::TargetExists { path }
        | Of::Busy { path }
        | Of::NoDataset { path, .. }
        | Of::Version { path, .. }
        | Of::Digest { path, .. }
        | Of::Seal { path, .. }
        | Of::Damaged { path, .. }
        | Of::Journal { path, .. }
        | Of::Request { path, .. } => (Some(path), None, None),
        _ => (None, None, None),
    }
}

fn placed(message: String, path: Option<PathBuf>, row: Option<u64>, line: Option<u64>) -> PyErr {
    let raised = DatasetError::new_err(message);
    let set = Python::attach(|py| {
        let value = raised.value(py);
        value.setattr("path", path)?;
        value.setattr("row", row)?;
        value.setattr("line", line)
    });
    match set {
        Ok(()) => raised,
        Err(error) => error,
    }
}

/// `error` of a study as a Python exception; a cancellation by Ctrl-C is a `KeyboardInterrupt`.
pub(crate) fn study_error(error: &EvaluateError) -> PyErr {
    match error {
        error if error.kind() == ErrorKind::Interrupted => PyKeyboardInterrupt::new_err(()),
        EvaluateError::Dataset(error) => dataset_error(error),
        EvaluateError::Table(error) => import_error(error),
        EvaluateError::Model(error) => ModelError::new_err(error.to_string()),
        error => value_error(error),
    }
}

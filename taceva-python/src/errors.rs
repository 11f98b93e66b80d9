//! What goes wrong, as exceptions of Python.

use pyo3::create_exception;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use taceva_core::ErrorKind;
use taceva_study::StudyError;

create_exception!(
    taceva,
    DatasetError,
    PyValueError,
    "A recording that cannot be read; the message names the file, and the row where one is at fault."
);
create_exception!(
    taceva,
    ModelError,
    PyValueError,
    "A model that does not fit the recording, or cannot be fitted to it."
);

/// `error` as a `ValueError`.
pub(crate) fn value_error(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// `error` of a recording as a `DatasetError`.
pub(crate) fn dataset_error(error: impl std::fmt::Display) -> PyErr {
    DatasetError::new_err(error.to_string())
}

/// `error` of a study as what a Python program catches; what stopped because Ctrl-C was pressed is a `KeyboardInterrupt`.
pub(crate) fn study_error(error: &StudyError) -> PyErr {
    match error {
        error if error.kind() == ErrorKind::Interrupted => PyKeyboardInterrupt::new_err(()),
        StudyError::Dataset(error) => dataset_error(error),
        StudyError::Model(error) => ModelError::new_err(error.to_string()),
        error => value_error(error),
    }
}

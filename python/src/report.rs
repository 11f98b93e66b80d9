//! Report of a result by the command of the program.

use std::ffi::OsString;
use std::path::PathBuf;

use pyo3::prelude::*;

use crate::errors::value_error;

/// Path of the page that `taceva report` writes for `arguments`, which begin with the program name.
#[pyfunction]
pub(crate) fn write_report(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<PathBuf> {
    let page = py.detach(|| taceva_cli::write_report(arguments));
    page.map_err(|error| value_error(taceva_cli::one_line(&error)))
}

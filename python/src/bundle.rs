//! Verification of bundles by `taceva bundle verify`.

use std::ffi::OsString;

use pyo3::prelude::*;

use crate::errors::value_error;

/// Result of a verification, as Python receives it.
#[derive(IntoPyObject)]
pub(crate) struct Verified {
    document: String,
    text: String,
    is_verified: bool,
}

/// Result of `taceva bundle verify` with `arguments`, which begin with the program name.
#[pyfunction]
pub(crate) fn verify_bundle(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<Verified> {
    let found = py.detach(|| taceva_cli::verify_bundle(arguments));
    let found = found.map_err(|error| value_error(taceva_cli::one_line(&error)))?;
    Ok(Verified {
        document: found.document,
        text: found.text,
        is_verified: found.is_verified,
    })
}

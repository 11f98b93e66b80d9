//! Gauge studies, calibration curves and budgets by the commands of the program.

use std::ffi::OsString;

use pyo3::prelude::*;
use taceva_evaluate::EvaluateError;
use taceva_import::ImportError;

use crate::errors::{import_error, study_error, value_error};
use crate::results::rendered;

/// Result of a gauge study, a curve or a budget, as Python receives it.
#[derive(IntoPyObject)]
pub(crate) struct Computed {
    documents: Vec<String>,
    text: String,
    html: String,
    latex: String,
    numbers: String,
}

/// Result of `taceva gauge`, `curve` or `budget` with `arguments`, which begin with the program name.
#[pyfunction]
pub(crate) fn metrology(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<Computed> {
    let found = py.detach(|| taceva_cli::metrology(arguments));
    let found = found.map_err(|error| {
        // The error of a table has its place.
        for cause in error.chain() {
            if let Some(of_study) = cause.downcast_ref::<EvaluateError>() {
                return study_error(of_study);
            }
            if let Some(of_table) = cause.downcast_ref::<ImportError>() {
                return import_error(of_table);
            }
        }
        value_error(taceva_cli::one_line(&error))
    })?;
    Ok(Computed {
        text: rendered(&found.table, "text")?,
        html: rendered(&found.table, "html")?,
        latex: rendered(&found.table, "tex")?,
        numbers: rendered(&found.numbers, "csv")?,
        documents: found.documents,
    })
}

//! Module `taceva._taceva`: functions of the crates for the Python package, without its own logic.
//!
//! Input arrays arrive through the buffer protocol as native float32 or float64; the Python side has converted them. Output arrays are buffers that
//! numpy wraps without a copy. The interpreter lock is released during sums, decoding and fits.

mod arrays;
mod arrow;
mod buffer;
mod bundle;
mod columns;
mod dataset;
mod errors;
mod evaluate;
mod inventory;
mod metrics;
mod metrology;
mod monitor;
mod plugin;
mod python_model;
mod record;
mod report;
mod results;
mod tasks;
mod worker;

use pyo3::prelude::*;

#[pymodule(gil_used = false)]
mod _taceva {
    use std::ffi::OsString;

    use pyo3::prelude::*;

    #[pymodule_export]
    use super::buffer::Buffer;
    #[pymodule_export]
    use super::bundle::verify_bundle;
    #[pymodule_export]
    use super::dataset::Recording;
    #[pymodule_export]
    use super::errors::{DatasetError, ModelError};
    #[pymodule_export]
    use super::evaluate::{evaluate_named, score_tables};
    #[pymodule_export]
    use super::inventory::{found_plugins, metric_titles, model_names};
    #[pymodule_export]
    use super::metrics::{Sums, channel_order, unit_of};
    #[pymodule_export]
    use super::metrology::metrology;
    #[pymodule_export]
    use super::monitor::PictureMonitor;
    #[pymodule_export]
    use super::plugin::{Deadline, Interrupted, Training};
    #[pymodule_export]
    use super::plugin::{plugin_log, plugin_manifest, serve_plugin, wire};
    #[pymodule_export]
    use super::python_model::{Given, features};
    #[pymodule_export]
    use super::record::{import_recording, record};
    #[pymodule_export]
    use super::report::write_report;
    #[pymodule_export]
    use super::results::{
        comparison, figure_pdf, figures, keeps_samples, not_measured, read_result, score_table,
    };

    #[pymodule_export]
    use super::tasks::{compare_tasks, merge_tasks, task_scores};

    /// Gives the class `DatasetError` the attributes `path`, `row` and `line`, which are `None` for unknown locations.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let error = module.py().get_type::<super::errors::DatasetError>();
        ["path", "row", "line"]
            .into_iter()
            .try_for_each(|name| error.setattr(name, module.py().None()))
    }

    /// Runs the command in `arguments`, which begin with the program name, and returns the exit code. The command handles signals from then on, and
    /// plugins run in new processes of this interpreter.
    #[pyfunction]
    fn command(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<u8> {
        super::plugin::within(py)?;
        Ok(py.detach(|| taceva_cli::main_with(arguments)))
    }

    /// Version of the crates in the module.
    #[pyfunction]
    fn version() -> &'static str {
        env!("CARGO_PKG_VERSION")
    }
}

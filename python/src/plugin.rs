//! Plugins written in Python: its objects as devices and estimators, and the process that serves them.
//!
//! The objects implement the traits of core as a library's devices do, and are offered to the child's side of the host through the tables of
//! the interface. So there is one wire, one sandbox and one set of checks, whatever a plugin is written in.

mod changer;
mod drivers;
mod estimator;
mod failure;
mod force;
mod lighting;
mod objects;
mod offered;
mod poses;
mod robot;
mod sensor;
mod training;
mod waiting;

use std::path::PathBuf;

use pyo3::prelude::*;
use taceva_conformance::serve_as_child;
use taceva_host::{Linked, ModuleToImport, run_within};
use taceva_plugin::Level;

use self::offered::Offered;
use crate::errors::value_error;

pub(crate) use self::training::Training;
pub(crate) use self::waiting::{Deadline, Interrupted};

/// Becomes the process of a plugin: confines it, has `import_module(folder, name, preload)` import the module and give its plugin, serves that
/// until the host is gone, and returns the code to end with. Called first of all, before anything is imported that begins threads.
#[pyfunction]
pub(crate) fn serve_plugin(py: Python<'_>, import_module: Py<PyAny>) -> i32 {
    py.detach(|| {
        serve_as_child(|module| {
            Python::attach(|py| {
                let imported = imported(py, &import_module, module);
                imported.map_err(|error| failure::words(py, &error))
            })
        })
    })
}

fn imported(
    py: Python<'_>,
    import_module: &Py<PyAny>,
    module: &ModuleToImport,
) -> PyResult<Linked> {
    let ModuleToImport {
        folder,
        name,
        preload,
        ..
    } = module;
    let plugin = import_module.call1(py, (folder, name, preload.clone()))?;
    Ok(Offered::of(plugin.bind(py))?.linked(folder.clone()))
}

/// The text of a manifest of `plugin`, which the module `name` is: `text` with what the plugin says of itself.
#[pyfunction]
#[pyo3(signature = (plugin, name, text, license = None))]
pub(crate) fn plugin_manifest(
    plugin: &Bound<'_, PyAny>,
    name: &str,
    text: &str,
    license: Option<&str>,
) -> PyResult<String> {
    let linked = Offered::of(plugin)?.linked(PathBuf::from(name));
    let offer = plugin.py().detach(|| linked.offer()).map_err(value_error)?;
    let written = offer.manifest_of_module(text, name, license);
    written.map_err(|error| value_error(format_args!("plugin.toml, {error}")))
}

/// A line for the log of the host, `level` of `error`, `warn`, `info` and `debug`.
#[pyfunction]
pub(crate) fn plugin_log(level: &str, message: &str) -> PyResult<()> {
    let level = match level {
        "error" => Level::Error,
        "warn" => Level::Warn,
        "info" => Level::Info,
        "debug" => Level::Debug,
        other => {
            return Err(value_error(format_args!(
                "level: {other:?}, expected \"error\", \"warn\", \"info\" or \"debug\""
            )));
        }
    };
    taceva_plugin::log(level, message);
    Ok(())
}

/// Says that the processes of plugins are `interpreter`, with the package `taceva` that lies at `package`.
pub(crate) fn within(py: Python<'_>) -> PyResult<()> {
    let interpreter: PathBuf = py.import("sys")?.getattr("executable")?.extract()?;
    let files: Vec<PathBuf> = py.import("taceva")?.getattr("__path__")?.extract()?;
    if let Some(package) = files.into_iter().next() {
        run_within(interpreter, package);
    }
    Ok(())
}

/// The version of what a host and the process of a plugin say to each other.
#[pyfunction]
pub(crate) fn wire() -> u32 {
    taceva_host::WIRE
}

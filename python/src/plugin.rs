//! Plugins written in Python: Python objects as devices and estimators, and the process that serves them.
//!
//! The objects implement the traits of core, like the devices of a library. The child process offers them to the host through the tables of the
//! interface. All plugins thus share one protocol, one sandbox and one set of checks, whatever their language.

mod changer;
mod drivers;
mod estimator;
mod failure;
mod force;
mod lighting;
mod objects;
mod offer;
mod poses;
mod robot;
mod sensor;
mod training;
mod waiting;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use pyo3::prelude::*;
use taceva_conformance::serve_as_child;
use taceva_host::{Linked, ModuleToImport, run_within};
use taceva_plugin::Level;

use self::offer::Offered;
use crate::errors::value_error;

pub(crate) use self::training::Training;
pub(crate) use self::waiting::{Deadline, Interrupted};

/// True in the process of a plugin.
static SERVES: AtomicBool = AtomicBool::new(false);

/// Runs the process of a plugin: confines it, calls `import_module(folder, name, preload)` for the plugin, serves it until the host ends, and returns
/// the exit code. Call this function first, before any import that starts threads.
#[pyfunction]
pub(crate) fn serve_plugin(py: Python<'_>, import_module: Py<PyAny>) -> i32 {
    SERVES.store(true, Ordering::Relaxed);
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

/// Manifest of `plugin`, imported from the module `name`: the manifest `text` with the entries that the code of the plugin determines.
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

/// Writes a line to the log of the host; `level` is `error`, `warn`, `info` or `debug`.
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

/// Starts the processes of plugins in this Python interpreter, with its installed package `taceva`.
///
/// # Errors
/// `ValueError` in the process of a plugin, which could otherwise start itself without end.
pub(crate) fn within(py: Python<'_>) -> PyResult<()> {
    if SERVES.load(Ordering::Relaxed) {
        return Err(value_error(
            "a plugin cannot use plugins or the command, since it could start itself without end",
        ));
    }
    let interpreter: PathBuf = py.import("sys")?.getattr("executable")?.extract()?;
    let files: Vec<PathBuf> = py.import("taceva")?.getattr("__path__")?.extract()?;
    if let Some(package) = files.into_iter().next() {
        run_within(interpreter, package);
    }
    Ok(())
}

/// Version of the protocol between a host and the process of a plugin.
#[pyfunction]
pub(crate) fn wire() -> u32 {
    taceva_host::WIRE
}

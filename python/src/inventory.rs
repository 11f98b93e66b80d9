//! Models, metrics and plugins for Python programs: the same as for the command line.

use std::collections::BTreeSet;
use std::io::Write as _;
use std::path::PathBuf;
use std::sync::Arc;

use pyo3::prelude::*;
use taceva_core::shown_lines;
use taceva_host::{
    Level, PluginConfig, PluginHost, PluginLog, Plugins, SearchPath, beside_this_program,
    user_config_file,
};
use taceva_metrics::catalogue;
use taceva_models::PRESETS;

use crate::dataset;
use crate::errors::value_error;
use crate::plugin::within;

/// A plugin that was found.
#[derive(IntoPyObject)]
pub(crate) struct FoundPlugin {
    id: String,
    name: String,
    version: String,
    place: String,
    folder: PathBuf,
    drivers: Vec<String>,
    estimators: Vec<String>,
}

/// Plugins in the folders and environments of the user, configured by the user's settings.
///
/// # Errors
/// `ValueError` if the user's settings cannot be read.
pub(crate) fn host(py: Python<'_>) -> PyResult<Arc<PluginHost>> {
    within(py)?;
    py.detach(|| {
        let config = match user_config_file() {
            Some(path) => PluginConfig::read(&path).map_err(value_error)?,
            None => PluginConfig::default(),
        };
        let mut interpreters = config.python.clone();
        interpreters.extend(beside_this_program());
        let mut known = BTreeSet::new();
        interpreters.retain(|interpreter| known.insert(interpreter.clone()));
        let path = SearchPath::of_process();
        let plugins = Plugins::search_with(path, &config.prefer, &interpreters);
        Ok(PluginHost::new(plugins, config, log()))
    })
}

/// Writes warnings and errors of plugins to standard error. Python receives no lines, because a waiting caller may hold the interpreter lock.
fn log() -> PluginLog {
    Arc::new(|id, level, target, message| {
        if level <= Level::Warn {
            let line = shown_lines(&format!("taceva: {id}: {target}: {message}\n"));
            // Ignores a closed standard error, because there is nowhere to report it.
            let _ = std::io::stderr().write_all(line.as_bytes());
        }
    })
}

/// Names of all models and presets, each with a one-line description; models of plugins last.
#[pyfunction]
pub(crate) fn model_names(py: Python<'_>) -> PyResult<Vec<(String, String)>> {
    let compiled = dataset::models();
    let mut names: Vec<(String, String)> = compiled
        .compiled()
        .map(|info| (info.name.to_owned(), info.about.to_owned()))
        .collect();
    names.extend(PRESETS.iter().map(|preset| {
        let about = format!("preset of {}", preset.model);
        (preset.name.to_owned(), about)
    }));
    let host = host(py)?;
    let offered = host.estimators().map(|(plugin, estimator)| {
        let about = format!("{}, of the plugin {}", estimator.title, plugin.id());
        (estimator.key.to_string(), about)
    });
    names.extend(offered);
    Ok(names)
}

/// Names of all metrics and groups, with their titles.
#[pyfunction]
pub(crate) fn metric_titles() -> Vec<(String, String)> {
    let metrics = catalogue::ALL.into_iter();
    let metrics = metrics.map(|metric| (metric.id.to_owned(), metric.title.to_owned()));
    let groups = catalogue::GROUPS.into_iter().map(|(name, members)| {
        let members: Vec<&str> = members.iter().map(|metric| metric.id).collect();
        (name.to_owned(), members.join(", "))
    });
    metrics.chain(groups).collect()
}

/// Found plugins, and a sentence for each unused plugin.
#[pyfunction]
pub(crate) fn found_plugins(py: Python<'_>) -> PyResult<(Vec<FoundPlugin>, Vec<String>)> {
    let host = host(py)?;
    let plugins = host.plugins();
    let found = plugins.iter().map(|plugin| {
        let manifest = &plugin.manifest;
        let drivers = manifest.drivers();
        let estimators = manifest.estimators();
        FoundPlugin {
            id: manifest.id.to_string(),
            name: manifest.name.clone(),
            version: manifest.version.clone(),
            place: plugin.place.to_string(),
            folder: plugin.folder.clone(),
            drivers: drivers
                .map(|descriptor| descriptor.key().to_string())
                .collect(),
            estimators: estimators
                .map(|estimator| estimator.key.to_string())
                .collect(),
        }
    });
    let refused = plugins.rejections.iter().map(ToString::to_string);
    Ok((found.collect(), refused.collect()))
}

//! A Python plugin and its interface table.

use std::path::PathBuf;
use std::sync::OnceLock;

use pyo3::prelude::*;
use taceva_host::{Linked, PluginId, Provided};
use taceva_plugin::abi::{Plugin, Text};
use taceva_plugin::{Driver, Export, Made, plugin};

use super::drivers::PythonDriver;
use super::estimator::PythonEstimator;
use crate::errors::value_error;

/// The only plugin of this process, set when it is linked.
static OFFERED: OnceLock<Offered> = OnceLock::new();

/// A plugin in a Python module: its identity and its device classes.
pub(super) struct Offered {
    id: String,
    version: String,
    needs: Vec<String>,
    classes: Vec<(Provided, Py<PyAny>)>,
}

impl Offered {
    /// Reads an object of the class `taceva.plugin.Plugin`.
    pub(super) fn of(plugin: &Bound<'_, PyAny>) -> PyResult<Offered> {
        let id: String = plugin.getattr("id")?.extract()?;
        let parsed: PluginId = id.parse().map_err(value_error)?;
        let tables: Vec<(String, Py<PyAny>)> = plugin.call_method0("tables")?.extract()?;
        let mut classes = Vec::with_capacity(tables.len());
        for (table, class) in tables {
            let provided = Provided::parse(&table, &parsed).map_err(|error| {
                value_error(format_args!("description of `{id}`, {error}:\n{table}"))
            })?;
            classes.push((provided, class));
        }
        Ok(Offered {
            id,
            version: plugin.getattr("version")?.extract()?,
            needs: plugin.getattr("needs")?.extract()?,
            classes,
        })
    }

    /// Interface table of the plugin, whose code is at `path`. A process serves only the first plugin that calls this function.
    pub(super) fn linked(self, path: PathBuf) -> Linked {
        let offered = OFFERED.get_or_init(|| self);
        let mut table: Plugin = plugin::<Offered>();
        table.id = Text::from(offered.id.as_str());
        table.version = Text::from(offered.version.as_str());
        let needs: &'static str = Box::leak(offered.needs.join("\n").into_boxed_str());
        table.needs = Text::from(needs);
        Linked::new(Box::leak(Box::new(table)), path)
    }
}

impl Export for Offered {
    /// Placeholder, which [`Offered::linked`] replaces by the id of the Python plugin.
    const ID: &'static str = "";
    const VERSION: &'static str = "";

    fn drivers() -> Vec<Driver> {
        let classes = OFFERED.get().map(|offered| offered.classes.as_slice());
        let made = classes
            .into_iter()
            .flatten()
            .filter_map(|(provided, class)| {
                let class = Python::attach(|py| class.clone_ref(py));
                match provided {
                    Provided::Driver { descriptor, .. } => {
                        PythonDriver::made((**descriptor).clone(), class)
                    }
                    Provided::Estimator(info) => {
                        let estimator = PythonEstimator::new(info.clone(), class);
                        Some(Made::Estimator(Box::new(estimator)))
                    }
                    _ => None,
                }
            });
        made.map(Driver::Made).collect()
    }
}

//! Plugins, as lists.

use std::io::{self, Write};

use serde::Serialize;
use taceva_core::counted;
use taceva_drivers::ListedDriver;
use taceva_host::{Delivery, Place, Plugin, PluginHost, PythonModule, ReasonKind, Rejection};

use super::{devices, json};
use crate::args::ListFormat;

/// Writes the list of found plugins. With `all`, also lists unused plugins.
pub(crate) fn list(
    host: &PluginHost,
    all: bool,
    format: ListFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    let plugins = host.plugins();
    let refused: &[Rejection] = if all { &plugins.rejections } else { &[] };
    if format == ListFormat::Json {
        let written = Written {
            schema: "taceva.plugins/1",
            plugins: plugins
                .iter()
                .map(|plugin| Listed::of(host, plugin))
                .collect(),
            rejected: refused.iter().map(Refused::of).collect(),
        };
        return json::write(&written, out);
    }
    if !plugins.is_empty() {
        columns(["id", "version", "runs-in", "found-by", "name"], out)?;
    }
    for plugin in plugins.iter() {
        line(&Listed::of(host, plugin), out)?;
    }
    for rejection in refused {
        let kind = rejection.reason.kind();
        writeln!(out, "not used  {kind:<14} {rejection}")?;
    }
    let (used, not) = (plugins.len(), plugins.rejections.len());
    let hint = if all || not == 0 {
        ""
    } else {
        ": --all prints the reasons"
    };
    writeln!(out, "{}, {not} not used{hint}", counted(used, "plugin"))
}

/// Writes the content of a manifest.
pub(crate) fn info(
    host: &PluginHost,
    plugin: &Plugin,
    format: ListFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    let listed = Listed::of(host, plugin);
    if format == ListFormat::Json {
        let written = Written {
            schema: "taceva.plugins/1",
            plugins: vec![listed],
            rejected: Vec::new(),
        };
        return json::write(&written, out);
    }
    line(&listed, out)?;
    writeln!(out, "    folder    {}", listed.folder)?;
    match &listed.module {
        None => writeln!(out, "    library   {} ({})", listed.library, listed.sha256)?,
        Some(module) => {
            let run = listed.interpreter.as_deref().unwrap_or("no interpreter");
            writeln!(
                out,
                "    module    {} ({}), run by {run}",
                module.name, module.profile
            )?;
            if !module.preload.is_empty() {
                writeln!(out, "    preload   {}", module.preload.join(", "))?;
            }
        }
    }
    writeln!(out, "    licence   {}", listed.license)?;
    writeln!(out, "    interface {}", listed.abi)?;
    for driver in &listed.drivers {
        devices::driver(driver, out)?;
    }
    for estimator in &listed.estimators {
        writeln!(out, "{:<22} estimator  {}", estimator.key, estimator.title)?;
    }
    Ok(())
}

/// Writes one line of the table of plugins.
fn columns([id, version, delivery, place, name]: [&str; 5], out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "{id:<30} {version:<10} {delivery:<14} {place:<12} {name}"
    )
}

fn line(plugin: &Listed, out: &mut dyn Write) -> io::Result<()> {
    let Listed {
        id, version, name, ..
    } = plugin;
    let (place, delivery) = (plugin.place.to_string(), plugin.delivery.to_string());
    columns([id, version, &delivery, &place, name], out)?;
    let runs = if plugin.can_run { "runs " } else { "" };
    writeln!(out, "    {runs}{}", plugin.isolation)?;
    if let Some(reason) = &plugin.quarantined {
        writeln!(
            out,
            "    in quarantine: {reason}; `taceva plugin release {id}` lets it start again"
        )?;
    }
    let drivers = plugin.drivers.iter().map(|driver| &driver.key);
    let estimators = plugin.estimators.iter().map(|estimator| &estimator.key);
    let keys: Vec<&str> = drivers.chain(estimators).map(String::as_str).collect();
    writeln!(out, "    {}", keys.join(", "))?;
    if !plugin.needs.is_empty() {
        let allowed = match plugin.allowed.as_slice() {
            [] => "none is allowed".to_owned(),
            allowed => format!("allowed: {}", allowed.join(", ")),
        };
        writeln!(out, "    needs {} ({allowed})", plugin.needs.join(", "))?;
        if let Some(remedy) = &plugin.remedy {
            writeln!(out, "    {remedy}")?;
        }
    }
    Ok(())
}

#[derive(Serialize)]
struct Written {
    schema: &'static str,
    plugins: Vec<Listed>,
    rejected: Vec<Refused>,
}

#[derive(Serialize)]
struct Listed {
    id: String,
    name: String,
    version: String,
    license: String,
    abi: String,
    place: Place,
    folder: String,
    /// Path of the library; empty for a Python module.
    library: String,
    /// Digest of the library that the manifest requires; empty if it requires none.
    sha256: String,
    /// Python module of the plugin; `None` for a library.
    #[serde(skip_serializing_if = "Option::is_none")]
    module: Option<PythonModule>,
    /// Interpreter that runs the module, with its version; `None` for a library.
    #[serde(skip_serializing_if = "Option::is_none")]
    interpreter: Option<String>,
    delivery: Delivery,
    /// Isolation from the rest of the machine, tested with a confined process that does not load the plugin.
    isolation: String,
    #[serde(skip)]
    can_run: bool,
    needs: Vec<String>,
    allowed: Vec<String>,
    /// Command that allows the remaining needs of the plugin; `None` if all are allowed.
    #[serde(skip_serializing_if = "Option::is_none")]
    remedy: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    quarantined: Option<String>,
    drivers: Vec<ListedDriver>,
    estimators: Vec<ListedEstimator>,
}

#[derive(Serialize)]
struct ListedEstimator {
    key: String,
    title: String,
}

impl Listed {
    fn of(host: &PluginHost, plugin: &Plugin) -> Listed {
        let manifest = &plugin.manifest;
        let words = |needs: std::collections::BTreeSet<taceva_host::Need>| {
            needs.iter().map(ToString::to_string).collect()
        };
        let keeping = host.keeping(plugin);
        Listed {
            id: manifest.id.to_string(),
            name: manifest.name.clone(),
            version: manifest.version.clone(),
            license: manifest.license.clone(),
            abi: format!("{}.{}", manifest.abi.major, manifest.abi.minor),
            place: plugin.place,
            folder: plugin.folder.display().to_string(),
            library: plugin
                .library()
                .map(|library| library.path.clone())
                .unwrap_or_default(),
            sha256: match plugin.library().and_then(|library| library.sha256) {
                Some(digest) => format!("sha256 {digest}"),
                None => "any build of it".to_owned(),
            },
            module: plugin.module().cloned(),
            interpreter: plugin.interpreter.as_ref().map(|interpreter| {
                format!(
                    "{} ({})",
                    interpreter.program().display(),
                    interpreter.version()
                )
            }),
            delivery: host.config().delivery(plugin),
            isolation: keeping.to_string(),
            can_run: keeping.is_possible(),
            needs: manifest.needs.iter().map(ToString::to_string).collect(),
            allowed: words(host.config().allowed(plugin)),
            remedy: remedy(host, plugin),
            quarantined: host.quarantined(plugin),
            drivers: manifest.drivers().map(ListedDriver::of).collect(),
            estimators: manifest
                .estimators()
                .map(|estimator| ListedEstimator {
                    key: estimator.key.to_string(),
                    title: estimator.title.clone(),
                })
                .collect(),
        }
    }
}

/// The command that allows the needs of `plugin` for any arguments; `None` if all are allowed.
pub(crate) fn remedy(host: &PluginHost, plugin: &Plugin) -> Option<String> {
    let withheld = host.withheld(plugin);
    (!withheld.needs().is_empty()).then(|| withheld.to_string())
}

#[derive(Serialize)]
struct Refused {
    path: String,
    place: Place,
    kind: ReasonKind,
    reason: String,
}

impl Refused {
    fn of(rejection: &Rejection) -> Refused {
        Refused {
            path: rejection.path.display().to_string(),
            place: rejection.place,
            kind: rejection.reason.kind(),
            reason: rejection.reason.to_string(),
        }
    }
}

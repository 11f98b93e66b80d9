//! Plugins of this program, and all drivers and models including drivers and models of plugins.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use taceva_core::shown;

use anyhow::Context as _;
use taceva_drivers::Drivers;
use taceva_host::{
    Level, PluginConfig, PluginHost, PluginLog, Plugins, SearchPath, beside_this_program,
    user_config_file,
};
use taceva_models::Models;

use super::Context;
use crate::stderr;

/// Built-in models.
fn compiled() -> Models {
    Models::builtin().with_libraries(taceva_models::library_models())
}

/// All models: built-in models, models of linked libraries, and models of the plugins of `host`.
pub(crate) fn models_with(host: &Arc<PluginHost>) -> Models {
    compiled().with(host.models())
}

impl Context {
    /// All drivers: built-in drivers and drivers of plugins, including plugins next to the scene at `scene`.
    pub(crate) fn drivers(&self, scene: Option<&Path>) -> anyhow::Result<Drivers> {
        let host = self.plugins(scene)?;
        Ok(Drivers::builtin()?.with_plugins(&host)?)
    }

    /// All models: built-in models, models of linked libraries, and models of plugins.
    pub(crate) fn models(&self) -> anyhow::Result<Models> {
        Ok(models_with(&self.plugins(None)?))
    }

    /// All drivers and models, including drivers and models of plugins next to the scene at `scene`.
    pub(crate) fn equipment(&self, scene: &Path) -> anyhow::Result<(Drivers, Models)> {
        let host = self.plugins(Some(scene))?;
        let drivers = Drivers::builtin()?.with_plugins(&host)?;
        Ok((drivers, models_with(&host)))
    }

    /// Plugins that were found, isolated by the settings of the user.
    pub(crate) fn plugins(&self, scene: Option<&Path>) -> anyhow::Result<Arc<PluginHost>> {
        let mut config = match user_config_file() {
            Some(path) => PluginConfig::read(&path)?,
            None => PluginConfig::default(),
        };
        config.trusted_now.extend(self.plugins.trusted.clone());
        // Only paths of arguments are relative to the working folder.
        let typed: Vec<PathBuf> = (self.plugins.folders.iter())
            .map(|folder| std::path::absolute(folder).with_context(|| shown(folder).to_string()))
            .collect::<Result<_, _>>()?;
        let mut path = SearchPath::of_process().given(typed);
        if let Some(folder) = scene.and_then(folder_of) {
            path = path.project(&folder);
        }
        let interpreters = self.interpreters(&config)?;
        let plugins = Plugins::search_with(path, &config.prefer, &interpreters);
        for rejection in &plugins.rejections {
            self.say_more(format_args!("plugin not used: {rejection}"));
        }
        Ok(PluginHost::new(plugins, config, self.plugin_log()))
    }

    /// Interpreters whose environments are searched for plugins: from arguments, from settings, and from the environment of this program.
    fn interpreters(&self, config: &PluginConfig) -> anyhow::Result<Vec<PathBuf>> {
        let typed = self
            .plugins
            .interpreters
            .iter()
            .map(|typed| std::path::absolute(typed).with_context(|| shown(typed).to_string()));
        let mut interpreters = typed.collect::<Result<Vec<PathBuf>, _>>()?;
        interpreters.extend(config.python.iter().cloned());
        interpreters.extend(beside_this_program());
        let mut known = BTreeSet::new();
        interpreters.retain(|interpreter| known.insert(interpreter.clone()));
        Ok(interpreters)
    }

    /// Callback that prints log lines of plugins on standard error: errors and warnings, only errors with `--quiet`, all lines with `-v`.
    fn plugin_log(&self) -> PluginLog {
        let least = match (self.quiet, self.verbose) {
            (true, _) => Level::Error,
            (false, false) => Level::Warn,
            (false, true) => Level::Debug,
        };
        Arc::new(move |id, level, target, message| {
            if level <= least {
                stderr::say(format_args!("{id}: {target}: {message}"));
            }
        })
    }
}

/// Folder of the scene file at `scene`; `None` for a built-in scene.
fn folder_of(scene: &Path) -> Option<PathBuf> {
    let file = scene.canonicalize().ok().filter(|path| path.is_file())?;
    file.parent().map(Path::to_owned)
}

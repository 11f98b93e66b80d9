//! User settings for plugins: the table `[plugins]` of the settings file, and command-line options.

mod edit;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::id::PluginId;
use crate::manifest::{ManifestError, Need};
use crate::search::{Place, Plugin};

/// The table `[plugins]` of the user's settings.
///
/// ```
/// use taceva_host::PluginConfig;
/// let config = PluginConfig::parse(r#"
///     [plugins]
///     trust_in_process = ["org.example.fast"]
///     prefer = ["/opt/taceva/digit"]
///     python = ["/opt/lab/venv/bin/python"]
///
///     [plugins.allow]
///     "org.example.digit" = ["usb"]
/// "#)?;
/// assert!(config.trust_in_process.contains("org.example.fast"));
/// # Ok::<(), taceva_host::ManifestError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PluginConfig {
    /// Plugins whose code may run in this process.
    #[serde(default)]
    pub trust_in_process: BTreeSet<PluginId>,
    /// Folders whose plugins have priority over other plugins with the same id.
    #[serde(default)]
    pub prefer: Vec<PathBuf>,
    /// Python interpreters whose environments are searched for plugins. The first interpreter also runs Python plugins that are found outside these
    /// environments.
    #[serde(default)]
    pub python: Vec<PathBuf>,
    /// Needs that the user allows, by plugin.
    #[serde(default)]
    pub allow: BTreeMap<PluginId, BTreeSet<Need>>,
    /// Plugins that the command line trusts.
    #[serde(skip)]
    pub trusted_now: BTreeSet<PluginId>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(default)]
    plugins: PluginConfig,
}

impl PluginConfig {
    /// Reads the settings from the file at `path`. A missing file gives the default settings.
    ///
    /// # Errors
    /// [`ConfigError`] for a file that cannot be read or has a mistake.
    pub fn read(path: &Path) -> Result<PluginConfig, ConfigError> {
        let text = match fs::read_to_string(path) {
            Ok(text) => text,
            // A home that is not a folder has no settings file either.
            Err(error)
                if matches!(
                    error.kind(),
                    io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
                ) =>
            {
                return Ok(PluginConfig::default());
            }
            Err(source) => {
                return Err(ConfigError::Read {
                    path: path.to_owned(),
                    source,
                });
            }
        };
        PluginConfig::parse(&text).map_err(|source| ConfigError::Text {
            path: path.to_owned(),
            source,
        })
    }

    /// Parses settings from `text`.
    ///
    /// # Errors
    /// [`ManifestError`] with the line.
    pub fn parse(text: &str) -> Result<PluginConfig, ManifestError> {
        let written: Result<Written, toml::de::Error> = toml::from_str(text);
        match written {
            Ok(written) => Ok(written.plugins),
            Err(error) => Err(ManifestError::of_parser(text, &error)),
        }
    }

    /// Chooses where the code of `plugin` runs.
    pub fn delivery(&self, plugin: &Plugin) -> Delivery {
        match self.trust(plugin) {
            Some(_) if plugin.library().is_some() => Delivery::InProcess,
            _ => Delivery::Child,
        }
    }

    /// Source of the trust that lets `plugin` run in this process; `None` if it is not trusted.
    ///
    /// Trust in the settings does not apply to plugins next to a scene: the author of a scene can put any plugin there, under any id.
    pub fn trust(&self, plugin: &Plugin) -> Option<Trust> {
        let id = plugin.id();
        let settings = self.trust_in_process.contains(id) && plugin.place != Place::Project;
        let now = self.trusted_now.contains(id);
        now.then_some(Trust::CommandLine)
            .or(settings.then_some(Trust::Settings))
    }

    /// Needs that `plugin` declares and the user allows.
    pub fn allowed(&self, plugin: &Plugin) -> BTreeSet<Need> {
        let Some(allowed) = self.allow.get(plugin.id()) else {
            return BTreeSet::new();
        };
        let needs = plugin.manifest.needs.iter();
        let given = needs.map(|need| match need.fixed() {
            Some(need) => need.given_by(allowed),
            None => {
                let asked = allowed.iter().filter(|given| need.asks_for(given));
                asked.cloned().collect()
            }
        });
        given.flatten().collect()
    }
}

/// Source of the trust that lets a plugin's code run in this process.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// The command line.
    CommandLine,
    /// The user's settings.
    Settings,
}

impl std::fmt::Display for Trust {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Trust::CommandLine => "trusted by `--trust`",
            Trust::Settings => "trusted by `trust_in_process` in the user's settings",
        })
    }
}

/// Process in which a plugin's code runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Delivery {
    /// This process, since the user trusts the plugin.
    InProcess,
    /// A confined child process.
    Child,
}

impl std::fmt::Display for Delivery {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Delivery::InProcess => "in process",
            Delivery::Child => "child process",
        })
    }
}

/// Failure to read the settings.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", taceva_core::shown(path))]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The file has a mistake.
    #[error("{}, {source}", taceva_core::shown(path))]
    Text {
        /// Path of the file.
        path: PathBuf,
        /// The mistake and its position.
        source: ManifestError,
    },
}

//! What the user decides about plugins: a part of the user's settings, and words on the command line.

mod edit;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::id::PluginId;
use crate::manifest::{ManifestError, Need};
use crate::search::{Place, Plugin};

/// The part `[plugins]` of the user's settings.
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
    /// The folders of plugins that are used where another has the same id.
    #[serde(default)]
    pub prefer: Vec<PathBuf>,
    /// Interpreters of environments that are asked for plugins; the first of them runs those that lie elsewhere.
    #[serde(default)]
    pub python: Vec<PathBuf>,
    /// What plugins may reach outside their process, of what their manifests ask for.
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
    /// The settings in the file at `path`; one that is not there decides nothing.
    ///
    /// # Errors
    /// [`ConfigError`] for a file that cannot be read, or with a mistake.
    pub fn read(path: &Path) -> Result<PluginConfig, ConfigError> {
        let text = match fs::read_to_string(path) {
            Ok(text) => text,
            // A home that is no folder has no settings either.
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

    /// The settings written as `text`.
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

    /// How `plugin` is delivered.
    pub fn delivery(&self, plugin: &Plugin) -> Delivery {
        match self.trust(plugin) {
            Some(_) if plugin.library().is_some() => Delivery::InProcess,
            _ => Delivery::Child,
        }
    }

    /// Who trusts `plugin` with this process, if anybody does.
    ///
    /// What the settings trust is not trusted beside a scene: whoever hands over a scene may put any plugin there, under any id.
    pub fn trust(&self, plugin: &Plugin) -> Option<Trust> {
        let id = plugin.id();
        let settings = self.trust_in_process.contains(id) && plugin.place != Place::Project;
        let now = self.trusted_now.contains(id);
        now.then_some(Trust::CommandLine)
            .or(settings.then_some(Trust::Settings))
    }

    /// What `plugin` may reach at most: what it asks for and the user allows.
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

/// Who lets the code of a plugin run in this process.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// Whoever typed the command.
    CommandLine,
    /// The user's settings.
    Settings,
}

impl std::fmt::Display for Trust {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Trust::CommandLine => "`--trust` says so",
            Trust::Settings => "`trust_in_process` of the user's settings says so",
        })
    }
}

/// Where the code of a plugin runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Delivery {
    /// In this process: the user trusts it.
    InProcess,
    /// In a confined child process.
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

/// Settings that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", taceva_core::shown(path))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file has a mistake.
    #[error("{}, {source}", taceva_core::shown(path))]
    Text {
        /// The file.
        path: PathBuf,
        /// What and where.
        source: ManifestError,
    },
}

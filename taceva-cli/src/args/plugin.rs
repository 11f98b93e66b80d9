//! What is typed of plugins.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use taceva_host::PluginId;
use taceva_template::{Kind, Name};

use super::Listing;

/// Where plugins are looked for, and which of them are trusted; understood by every command.
#[derive(Clone, Debug, Args)]
pub(crate) struct PluginArgs {
    /// Also look for plugins in this folder, before anywhere else; may be repeated
    #[arg(long = "plugin-dir", global = true, value_name = "DIR")]
    pub(crate) folders: Vec<PathBuf>,
    /// Let the code of this plugin run in this process instead of a confined one; may be repeated
    #[arg(long = "trust", global = true, value_name = "ID")]
    pub(crate) trusted: Vec<PluginId>,
}

/// Plugins add sensors, robots, force transducers, lightings and estimators in any language.
#[derive(Debug, Subcommand)]
pub(crate) enum Plugin {
    /// List the plugins that are found, and how each would be isolated; no code of theirs runs
    List(PluginList),
    /// Say everything that the manifest of a plugin says; no code of it runs
    Info(PluginInfo),
    /// Begin a plugin in Rust: a project that builds as it is, with one driver to be made one's own
    New(PluginNew),
    /// Write the headers for plugins in C and C++
    Headers(PluginHeaders),
    /// Check whether a plugin keeps its promises, each check in a confined process with a time limit
    Check(PluginCheck),
    /// Let a plugin that crashed start again
    Release(PluginRelease),
}

#[derive(Debug, Args)]
pub(crate) struct PluginList {
    /// Also list what was found and is not used, and why
    #[arg(long)]
    pub(crate) all: bool,
    #[command(flatten)]
    pub(crate) listing: Listing,
}

#[derive(Debug, Args)]
pub(crate) struct PluginInfo {
    /// The id of the plugin
    pub(crate) id: String,
    #[command(flatten)]
    pub(crate) listing: Listing,
}

#[derive(Debug, Args)]
pub(crate) struct PluginNew {
    /// What the plugin provides
    pub(crate) kind: NewKind,
    /// What it is called: lower-case letters, digits and `-`; a folder of that name is made here
    pub(crate) name: Name,
    /// Take the crates that it is built from out of the registry, by version, in the place of copies under vendor/
    #[arg(long)]
    pub(crate) registry: bool,
}

/// What a plugin can be begun as.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum NewKind {
    Sensor,
    Robot,
    Force,
    Lighting,
    Estimator,
}

impl From<NewKind> for Kind {
    fn from(kind: NewKind) -> Kind {
        match kind {
            NewKind::Sensor => Kind::Sensor,
            NewKind::Robot => Kind::Robot,
            NewKind::Force => Kind::Force,
            NewKind::Lighting => Kind::Lighting,
            NewKind::Estimator => Kind::Estimator,
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct PluginHeaders {
    /// The folder to make
    #[arg(value_name = "DIR", default_value = "include")]
    pub(crate) to: PathBuf,
}

/// Exit code 1 if a check fails.
#[derive(Debug, Args)]
pub(crate) struct PluginCheck {
    /// The id of the plugin
    pub(crate) id: String,
    /// What everything is drawn from: the same seed makes the same checks
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Make the checks whose names begin so, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) only: Vec<String>,
    /// What a driver is opened with, as DRIVER:KEY=VALUE;KEY=VALUE; may be repeated
    #[arg(long = "with", value_name = "DRIVER:ARGUMENTS")]
    pub(crate) arguments: Vec<String>,
    /// Let robots be moved that are no simulations: by up to 1 mm away from the gel, and back
    #[arg(long = "move")]
    pub(crate) moves: bool,
    /// How long a check may take, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    pub(crate) limit: u64,
    #[command(flatten)]
    pub(crate) listing: Listing,
}

#[derive(Debug, Args)]
pub(crate) struct PluginRelease {
    /// The id of the plugin, or the digest of its library
    pub(crate) id: String,
}

//! What is typed of plugins.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use taceva_host::PluginId;

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
    /// List the plugins that are found; no code of theirs runs
    List(PluginList),
    /// Say everything that the manifest of a plugin says; no code of it runs
    Info(PluginInfo),
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

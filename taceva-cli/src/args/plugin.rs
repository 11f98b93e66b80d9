//! Arguments of `taceva plugin`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use taceva_host::{Need, PluginId};
use taceva_template::{Kind, Name};

use super::{ListFormat, Output, SeedArgs};

/// Where plugins are searched for, and which of them are trusted; options of every command.
#[derive(Clone, Debug, Args)]
pub(crate) struct PluginArgs {
    /// Also search this folder for plugins, before all others; may be repeated
    #[arg(long = "plugin-dir", global = true, value_name = "DIR")]
    pub(crate) folders: Vec<PathBuf>,
    /// Ask this interpreter of Python for the plugins in its environment, and run plugins in Python by it; may be repeated
    #[arg(long = "python", global = true, value_name = "FILE")]
    pub(crate) interpreters: Vec<PathBuf>,
    /// Run the code of this plugin in this process instead of a sandboxed one; may be repeated
    #[arg(long = "trust", global = true, value_name = "ID")]
    pub(crate) trusted: Vec<PluginId>,
}

/// Plugins add sensors, robots, force transducers, lightings, changers and estimators in any language.
#[derive(Debug, Subcommand)]
pub(crate) enum Plugin {
    /// List the plugins that are found, and how each would be isolated; none of their code runs
    List(PluginList),
    /// Print the manifest of a plugin; none of its code runs
    Info(PluginInfo),
    /// Create a plugin in Rust or Python: a project that works as it is, with one driver to be replaced
    New(PluginNew),
    /// Write the headers for plugins in C and C++
    Headers(PluginHeaders),
    /// Check a plugin against its interface, each check in a process of its own with a time limit
    Check(PluginCheck),
    /// Write plugin.toml from what the library says of itself
    Manifest(PluginManifest),
    /// Pack a plugin into one file, to be handed on: its manifest, libraries, licences and their digests
    Pack(PluginPack),
    /// Copy or unpack a plugin to where every command finds it: ~/.local/share/taceva/plugins
    Install(PluginInstall),
    /// Remove a plugin that was installed
    Uninstall(PluginUninstall),
    /// Let a plugin reach what its manifest needs: a camera, a port, a machine, a file
    Allow(PluginAllow),
    /// Take back what a plugin may reach
    Deny(PluginDeny),
    /// Release a crashed plugin from quarantine
    Release(PluginRelease),
}

#[derive(Debug, Args)]
pub(crate) struct PluginList {
    /// Also list plugins that are not used, and why
    #[arg(long)]
    pub(crate) all: bool,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}

#[derive(Debug, Args)]
pub(crate) struct PluginInfo {
    /// The id of the plugin
    pub(crate) id: String,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}

#[derive(Debug, Args)]
pub(crate) struct PluginNew {
    /// What the plugin provides
    pub(crate) kind: NewKind,
    /// Its name: lower-case letters, digits and `-`; the project is written to a folder of that name
    pub(crate) name: Name,
    /// Depend on crates of the registry, by version, instead of copies under vendor/
    #[arg(long, conflicts_with = "language")]
    pub(crate) registry: bool,
    /// What it is written in
    #[arg(long, value_enum, default_value_t = Language::Rust)]
    pub(crate) language: Language,
}

/// What a new plugin is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Language {
    Rust,
    Python,
}

/// What a new plugin provides.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum NewKind {
    Sensor,
    Robot,
    Force,
    Lighting,
    Changer,
    Estimator,
}

impl From<NewKind> for Kind {
    fn from(kind: NewKind) -> Kind {
        match kind {
            NewKind::Sensor => Kind::Sensor,
            NewKind::Robot => Kind::Robot,
            NewKind::Force => Kind::Force,
            NewKind::Lighting => Kind::Lighting,
            NewKind::Changer => Kind::Changer,
            NewKind::Estimator => Kind::Estimator,
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct PluginHeaders {
    /// The folder to write [default: include]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

/// Each check runs in a sandboxed process that reaches what `taceva plugin allow` lets the plugin reach; with `--trust ID`, in one that
/// is not confined. A real device is opened at most three times a check, and what needs one that is not there is skipped. A cause for
/// which several checks fail is reported once. The exit code is 1 if a check fails.
#[derive(Debug, Args)]
pub(crate) struct PluginCheck {
    /// The id of the plugin
    pub(crate) id: String,
    #[command(flatten)]
    pub(crate) seed: SeedArgs,
    /// Make only the checks whose names begin so, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) only: Vec<String>,
    /// The arguments of a driver, as DRIVER:KEY=VALUE;KEY=VALUE; may be repeated
    #[arg(long = "with", value_name = "DRIVER:ARGUMENTS")]
    pub(crate) arguments: Vec<String>,
    /// Allow moving real robots, by up to 1 mm away from the gel and back, and real changers, to each thing that they hold
    #[arg(long = "move")]
    pub(crate) moves: bool,
    /// The time limit of each check, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    pub(crate) limit: u64,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}

/// Its manifest is read first, and its library loaded in a sandboxed process: one that is not what its manifest says is not installed.
/// The manifest, the library for this machine and the licences beside them are copied.
///
/// Of a file that `taceva plugin pack` wrote every part is compared with its digest, and whatever its manifest does not name is refused.
#[derive(Debug, Args)]
pub(crate) struct PluginInstall {
    /// The folder of its plugin.toml, or the file into which it was packed
    #[arg(value_name = "DIR|FILE.tar")]
    pub(crate) plugin: PathBuf,
    /// Replace a plugin of that id that is installed already
    #[arg(long)]
    pub(crate) force: bool,
}

/// The library is loaded in a sandboxed process that reaches nothing, and asked for its id, its version, its drivers and what it needs.
/// Comments stay, and so does `usb`. Without --write the manifest is printed, and the exit code is 1 if the file says
/// otherwise.
#[derive(Debug, Args)]
pub(crate) struct PluginManifest {
    /// The folder of plugin.toml
    #[arg(default_value = ".", value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// The library, below that folder; as plugin.toml names it unless it is given
    #[arg(long, value_name = "FILE")]
    pub(crate) library: Option<PathBuf>,
    /// The licence of a manifest that is new, such as MIT
    #[arg(long, value_name = "SPDX")]
    pub(crate) license: Option<String>,
    /// Write plugin.toml instead of printing it
    #[arg(long)]
    pub(crate) write: bool,
}

/// The library is loaded in a sandboxed process first: one that is not what its manifest says is not packed. Whatever the manifest does not
/// name is left out, but for licences. The same plugin gives the same bytes.
#[derive(Debug, Args)]
pub(crate) struct PluginPack {
    /// The folder of its plugin.toml
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// The file to write [default: ID-VERSION.tar]
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace a file that is there
    #[arg(long)]
    pub(crate) force: bool,
}

/// A plugin runs in a process that reaches nothing of the machine but what its manifest needs and its user allows. This writes into
/// the user's settings, `~/.config/taceva/config.toml`; comments and everything else in there stay.
///
/// usb, camera, hid           devices on USB, cameras (/dev/video*), scales and pedals (/dev/hidraw*)
/// serial:/dev/ttyUSB*        serial ports; `*` stands for anything but `/`
/// device:/dev/spidev0.0      another character device
/// tcp:10.0.0.5:502           connections to one machine and port; `tcp:10.0.0.*:502` to all of a network
/// udp:10.0.0.5:49152         messages to and from a machine
/// listen:5025                a TCP port on which it waits for connections
/// read:/run/scale            a file or all in a folder, to be read only
#[derive(Debug, Args)]
#[command(verbatim_doc_comment)]
pub(crate) struct PluginAllow {
    /// The id of the plugin
    pub(crate) id: String,
    /// What it may reach, of what its manifest needs
    #[arg(required = true, value_name = "NEED")]
    pub(crate) needs: Vec<Need>,
}

/// What it may reach stays in the settings, for another version of it.
#[derive(Debug, Args)]
pub(crate) struct PluginUninstall {
    /// The id of the plugin
    pub(crate) id: PluginId,
}

/// Without NEED, everything is taken back that it may reach.
#[derive(Debug, Args)]
pub(crate) struct PluginDeny {
    /// The id of the plugin
    pub(crate) id: PluginId,
    /// What it may not reach any more, as it was allowed
    #[arg(value_name = "NEED")]
    pub(crate) needs: Vec<Need>,
}

#[derive(Debug, Args)]
pub(crate) struct PluginRelease {
    /// The id of the plugin, or the digest of its library
    pub(crate) id: String,
}

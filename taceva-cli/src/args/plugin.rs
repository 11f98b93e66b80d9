//! Arguments of `taceva plugin`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use taceva_host::{Need, PluginId};
use taceva_template::{Kind, Name};

use super::{ListFormat, Output, SeedArgs};

/// Search path of plugins, and trusted plugins; options of every command.
#[derive(Clone, Debug, Args)]
pub(crate) struct PluginArgs {
    /// Also search this folder for plugins, before all others; may be repeated
    #[arg(long = "plugin-dir", global = true, value_name = "DIR")]
    pub(crate) folders: Vec<PathBuf>,
    /// Ask this Python interpreter for the plugins in its environment, and run Python plugins with it; may be repeated
    #[arg(long = "python", global = true, value_name = "FILE")]
    pub(crate) interpreters: Vec<PathBuf>,
    /// Run this plugin without confinement: a library runs in this process, Python in its own process; may be repeated
    #[arg(long = "trust", global = true, value_name = "ID")]
    pub(crate) trusted: Vec<PluginId>,
}

/// Plugins add sensors, robots, force transducers, lighting devices, changers and estimators in any language.
#[derive(Debug, Subcommand)]
pub(crate) enum Plugin {
    /// List the plugins that are found, and their isolation; runs none of their code
    List(PluginList),
    /// Print the manifest of a plugin; runs none of its code
    Info(PluginInfo),
    /// Create a plugin in Rust, Python or C: a working project with one driver to be replaced
    New(PluginNew),
    /// Write the headers for plugins in C and C++
    Headers(PluginHeaders),
    Check(PluginCheck),
    Manifest(PluginManifest),
    Pack(PluginPack),
    Install(PluginInstall),
    Uninstall(PluginUninstall),
    Allow(PluginAllow),
    Deny(PluginDeny),
    /// Release a crashed plugin from quarantine
    Release(PluginRelease),
}

#[derive(Debug, Args)]
pub(crate) struct PluginList {
    /// Also list unused plugins, with the reason
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
    /// The kind of plugin
    pub(crate) kind: NewKind,
    /// The name: lower-case letters, digits and `-`; the project is written to a folder of that name
    pub(crate) name: Name,
    /// Depend on crates of the registry, by version, instead of copies under vendor/
    #[arg(long, conflicts_with = "language")]
    pub(crate) registry: bool,
    /// The programming language
    #[arg(long, value_enum, default_value_t = Language::Rust)]
    pub(crate) language: Language,
    /// Begin with a network of this library; for an estimator in Python
    #[arg(long = "with", value_enum)]
    pub(crate) library: Option<NewLibrary>,
}

/// Library of a new estimator in Python.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum NewLibrary {
    Torch,
}

/// Programming language of a new plugin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Language {
    Rust,
    Python,
    C,
}

/// Kind of a new plugin.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum NewKind {
    #[value(alias = "camera")]
    Sensor,
    Robot,
    #[value(alias = "transducer")]
    Force,
    Lighting,
    Changer,
    #[value(alias = "model")]
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

/// Check a plugin against its interface, in separate processes with a time limit
///
/// Each check runs in a sandboxed process with the access that `taceva plugin allow` grants; with `--trust ID`, the process is not confined. A
/// real device is opened at most three times for each check, and checks of a missing device are skipped. A common cause of several failures is
/// reported once. The exit code is 1 if a check fails.
#[derive(Debug, Args)]
pub(crate) struct PluginCheck {
    /// The id of the plugin
    pub(crate) id: String,
    #[command(flatten)]
    pub(crate) seed: SeedArgs,
    /// Run only the checks whose names begin with these, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) only: Vec<String>,
    /// The arguments of a driver, as DRIVER:KEY=VALUE;KEY=VALUE; may be repeated
    #[arg(long = "with", value_name = "DRIVER:ARGUMENTS")]
    pub(crate) arguments: Vec<String>,
    /// Allow moving real robots, by up to 1 mm away from the gel and back, and real changers, to each of their specimens or units
    #[arg(long = "move")]
    pub(crate) moves: bool,
    /// The time limit of each check, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    pub(crate) limit: u64,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}

/// Copy or unpack a plugin to the search path of every command: ~/.local/share/taceva/plugins
///
/// Reads the manifest first, and loads the library in a sandboxed process: a library that differs from its manifest is not installed. The
/// manifest, the library for this machine and the licences beside them are copied.
///
/// Every part of a file from `taceva plugin pack` is compared with its digest; files that its manifest does not name are rejected.
#[derive(Debug, Args)]
pub(crate) struct PluginInstall {
    /// The folder of its plugin.toml, or the packed file
    #[arg(value_name = "DIR|FILE.tar")]
    pub(crate) plugin: PathBuf,
    /// Replace an installed plugin with the same id
    #[arg(long)]
    pub(crate) force: bool,
}

/// Write plugin.toml from the data in the library
///
/// The library is loaded in a sandboxed process without any access, and asked for its id, its version, its drivers and its needs. Comments
/// and the key `usb` are kept. Without --write the manifest is printed, and the exit code is 1 if the file differs.
#[derive(Debug, Args)]
pub(crate) struct PluginManifest {
    /// The folder of plugin.toml
    #[arg(default_value = ".", value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// The library, below that folder [default: as plugin.toml names it]
    #[arg(long, value_name = "FILE")]
    pub(crate) library: Option<PathBuf>,
    /// The licence of a new manifest, such as MIT
    #[arg(long, value_name = "SPDX")]
    pub(crate) license: Option<String>,
    /// Write plugin.toml instead of printing it
    #[arg(long)]
    pub(crate) write: bool,
}

/// Pack a plugin into one file for distribution: its manifest, libraries, licences and their digests
///
/// The library is loaded in a sandboxed process first: a library that differs from its manifest is not packed. Files that the manifest does
/// not name are left out, except licences. The same plugin gives the same bytes.
#[derive(Debug, Args)]
pub(crate) struct PluginPack {
    /// The folder of its plugin.toml
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// The file to write [default: ID-VERSION.tar]
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    pub(crate) force: bool,
}

/// Grant a plugin access that its manifest requests: to a camera, a port, a machine, a file
///
/// A plugin runs in its own process, with access only to resources that its manifest lists under `needs` and the user allows. This command
/// writes to the user's settings, `~/.config/taceva/config.toml`, and keeps everything else in that file.
///
/// usb, camera, hid           devices on USB, cameras (/dev/video*), scales and pedals (/dev/hidraw*)
/// serial:/dev/ttyUSB*        serial ports; `*` stands for anything but `/`
/// device:/dev/spidev0.0      another character device
/// tcp:10.0.0.5:502           connections to one machine and port; `tcp:10.0.0.*:502` to every machine of a network
/// udp:10.0.0.5:49152         messages to and from a machine
/// listen:5025                a TCP port on which the plugin waits for connections
/// read:/run/scale            a file, or every file in a folder, read-only
#[derive(Debug, Args)]
#[command(verbatim_doc_comment)]
pub(crate) struct PluginAllow {
    /// The id of the plugin
    pub(crate) id: String,
    /// Access to grant, each as `needs` of the manifest states it
    #[arg(required = true, value_name = "NEED")]
    pub(crate) needs: Vec<Need>,
}

/// Remove an installed plugin
///
/// The granted access stays in the settings, for another version of the plugin.
#[derive(Debug, Args)]
pub(crate) struct PluginUninstall {
    /// The id of the plugin
    pub(crate) id: PluginId,
}

/// Revoke access of a plugin
///
/// Without NEED, all access is revoked.
#[derive(Debug, Args)]
pub(crate) struct PluginDeny {
    /// The id of the plugin
    pub(crate) id: PluginId,
    /// Access to revoke, as it was granted
    #[arg(value_name = "NEED")]
    pub(crate) needs: Vec<Need>,
}

#[derive(Debug, Args)]
pub(crate) struct PluginRelease {
    /// The id of the plugin, or the digest of its library
    pub(crate) id: String,
}

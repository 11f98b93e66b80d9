//! Rejected plugins and folders, with the reasons.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use taceva_core::shown;

use serde::Serialize;

use super::Place;
use crate::id::PluginId;
use crate::manifest::{AbiVersion, ManifestError};
use crate::python::other_wire;

/// A rejected folder or manifest.
#[derive(Debug)]
pub struct Rejection {
    /// Path of the manifest, or of the folder if the folder is the cause.
    pub path: PathBuf,
    /// Search place of the path.
    pub place: Place,
    /// Reason of the rejection.
    pub reason: Reason,
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", shown(&self.path), self.reason)
    }
}

/// Reason of a rejection.
#[derive(Debug)]
#[non_exhaustive]
pub enum Reason {
    /// The folder path is relative, so it depends on the working directory.
    Relative,
    /// Every user of the machine may write to the path or to a folder above it.
    WorldWritable {
        /// The writable file or folder.
        path: PathBuf,
    },
    /// The file or folder cannot be read.
    Unreadable(io::Error),
    /// The path is not a regular file.
    NotAFile,
    /// The text is not UTF-8 or exceeds the maximum length of a manifest.
    NotText,
    /// The manifest has a mistake.
    Manifest(ManifestError),
    /// The plugin uses another major version of the interface.
    Abi {
        /// Version of the plugin.
        found: AbiVersion,
    },
    /// The manifest has no library for this platform.
    Platform {
        /// Name of this platform.
        platform: String,
        /// Platforms with a library.
        has: Vec<String>,
    },
    /// The library is missing or not a file.
    Library {
        /// Path of the library.
        library: PathBuf,
        /// Description of the fault.
        problem: String,
    },
    /// An interpreter, an environment or a Python package is unsuitable. The text names the fault and the remedy.
    Python(String),
    /// The Python module uses another wire version.
    Wire {
        /// Version of the plugin.
        found: u32,
    },
    /// Another plugin has the same id.
    Duplicate {
        /// The shared id.
        id: PluginId,
        /// Manifest of the other plugin.
        other: PathBuf,
    },
}

/// Kind of a [`Reason`], for lists and scripts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ReasonKind {
    /// [`Reason::Relative`]
    Relative,
    /// [`Reason::WorldWritable`]
    WorldWritable,
    /// [`Reason::Unreadable`]
    Unreadable,
    /// [`Reason::NotAFile`]
    NotAFile,
    /// [`Reason::NotText`]
    NotText,
    /// [`Reason::Manifest`]
    Manifest,
    /// [`Reason::Abi`]
    Abi,
    /// [`Reason::Platform`]
    Platform,
    /// [`Reason::Library`]
    Library,
    /// [`Reason::Python`]
    Python,
    /// [`Reason::Wire`]
    Wire,
    /// [`Reason::Duplicate`]
    Duplicate,
}

impl ReasonKind {
    /// All kinds.
    pub const ALL: [ReasonKind; 12] = [
        ReasonKind::Relative,
        ReasonKind::WorldWritable,
        ReasonKind::Unreadable,
        ReasonKind::NotAFile,
        ReasonKind::NotText,
        ReasonKind::Manifest,
        ReasonKind::Abi,
        ReasonKind::Platform,
        ReasonKind::Library,
        ReasonKind::Python,
        ReasonKind::Wire,
        ReasonKind::Duplicate,
    ];

    /// Name of the kind.
    pub const fn name(self) -> &'static str {
        match self {
            ReasonKind::Relative => "relative",
            ReasonKind::WorldWritable => "world-writable",
            ReasonKind::Unreadable => "unreadable",
            ReasonKind::NotAFile => "not-a-file",
            ReasonKind::NotText => "not-text",
            ReasonKind::Manifest => "manifest",
            ReasonKind::Abi => "abi",
            ReasonKind::Platform => "platform",
            ReasonKind::Library => "library",
            ReasonKind::Python => "python",
            ReasonKind::Wire => "wire",
            ReasonKind::Duplicate => "duplicate",
        }
    }
}

impl fmt::Display for ReasonKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl Reason {
    /// Kind of the reason.
    pub fn kind(&self) -> ReasonKind {
        match self {
            Reason::Relative => ReasonKind::Relative,
            Reason::WorldWritable { .. } => ReasonKind::WorldWritable,
            Reason::Unreadable(_) => ReasonKind::Unreadable,
            Reason::NotAFile => ReasonKind::NotAFile,
            Reason::NotText => ReasonKind::NotText,
            Reason::Manifest(_) => ReasonKind::Manifest,
            Reason::Abi { .. } => ReasonKind::Abi,
            Reason::Platform { .. } => ReasonKind::Platform,
            Reason::Library { .. } => ReasonKind::Library,
            Reason::Python(_) => ReasonKind::Python,
            Reason::Wire { .. } => ReasonKind::Wire,
            Reason::Duplicate { .. } => ReasonKind::Duplicate,
        }
    }

    pub(super) fn of(self, path: &Path, place: Place) -> Rejection {
        Rejection {
            path: path.to_owned(),
            place,
            reason: self,
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Relative => f.write_str("a relative folder, expected one that begins with `/`"),
            Reason::WorldWritable { path } => write!(
                f,
                "every user of this machine may write to {}, expected write access only for its owner",
                shown(path)
            ),
            Reason::Unreadable(error) => write!(f, "{error}"),
            Reason::NotAFile => f.write_str("not a regular file"),
            Reason::Python(why) => f.write_str(why),
            Reason::Wire { found } => f.write_str(&other_wire(*found)),
            Reason::NotText => f.write_str("not UTF-8, or longer than 1 MiB"),
            Reason::Manifest(error) => write!(f, "{error}"),
            Reason::Abi { found } => write!(
                f,
                "written for version {}.{} of the interface, but this TacEva has {}.{}",
                found.major,
                found.minor,
                taceva_abi::ABI_MAJOR,
                taceva_abi::ABI_MINOR
            ),
            Reason::Platform { platform, has } => {
                write!(f, "no library for {platform}, only for {}", has.join(", "))
            }
            Reason::Library { library, problem } => {
                write!(f, "its library {}: {problem}", shown(library))
            }
            Reason::Duplicate { id, other } => write!(
                f,
                "`{id}` is also found in {}; choose one by `prefer = [\"FOLDER\"]` under [plugins] in the settings",
                shown(other)
            ),
        }
    }
}

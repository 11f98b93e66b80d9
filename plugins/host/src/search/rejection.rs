//! What was found and is not used, and why.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use taceva_core::shown;

use serde::Serialize;

use super::Place;
use crate::id::PluginId;
use crate::manifest::{AbiVersion, ManifestError};
use crate::python::other_wire;

/// A folder or a manifest that is not used.
#[derive(Debug)]
pub struct Rejection {
    /// The manifest, or the folder if it is to blame.
    pub path: PathBuf,
    /// Who named the folder.
    pub place: Place,
    /// Why it is not used.
    pub reason: Reason,
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", shown(&self.path), self.reason)
    }
}

/// Why something that was found is not used.
#[derive(Debug)]
#[non_exhaustive]
pub enum Reason {
    /// A folder that is relative, and so would depend on where the program was started.
    Relative,
    /// Every user of the machine may write there.
    WorldWritable {
        /// The file or folder that they may write.
        path: PathBuf,
    },
    /// It cannot be read.
    Unreadable(io::Error),
    /// What should be a file is none.
    NotAFile,
    /// Not UTF-8, or longer than a manifest.
    NotText,
    /// A manifest with a mistake.
    Manifest(ManifestError),
    /// Written for another major version of the interface.
    Abi {
        /// Its version.
        found: AbiVersion,
    },
    /// No library for this platform.
    Platform {
        /// This platform.
        platform: String,
        /// Those it has a library for.
        has: Vec<String>,
    },
    /// Its library is not there, or is no file.
    Library {
        /// As the manifest names it.
        library: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// An interpreter, an environment or a package of Python that is none for plugins; what is wrong, and what helps.
    Python(String),
    /// A module that was written for another version of the wire.
    Wire {
        /// Its version.
        found: u32,
    },
    /// Another plugin has the same id.
    Duplicate {
        /// The id.
        id: PluginId,
        /// The manifest of the other.
        other: PathBuf,
    },
}

/// [`Reason`] without what it is about: for lists, and for scripts.
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
    /// Every kind.
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

    /// The word for it.
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
    /// Its kind.
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
                "every user of this machine may write to {}, expected one that only its owner may",
                shown(path)
            ),
            Reason::Unreadable(error) => write!(f, "{error}"),
            Reason::NotAFile => f.write_str("no regular file"),
            Reason::Python(why) => f.write_str(why),
            Reason::Wire { found } => f.write_str(&other_wire(*found)),
            Reason::NotText => f.write_str("not UTF-8, or longer than 1 MiB"),
            Reason::Manifest(error) => write!(f, "{error}"),
            Reason::Abi { found } => write!(
                f,
                "written for version {}.{} of the interface, this TacEva has {}.{}",
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
                "`{id}` is also {}; `prefer = [\"FOLDER\"]` under [plugins] in the settings chooses one",
                shown(other)
            ),
        }
    }
}

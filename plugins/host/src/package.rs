//! A plugin as one file: a tar archive of its manifest, the digests of everything else, its libraries and its licences, in that order.
//!
//! The manifest decides what belongs in it. Whatever else is in an archive is refused, so that nothing can be put beside a plugin by
//! whoever hands it on, and nothing outside the folder of the plugin is ever written.

mod read;
mod write;

use std::io;
use std::path::{Path, PathBuf};

pub use self::read::unpack;
pub use self::write::pack;
use crate::manifest::{Manifest, ManifestError};
use crate::search::{MANIFEST, Plugin};

/// The digests of all files but the manifest, as `sha256sum --check` reads them.
const DIGESTS: &str = "SHA256SUMS";
/// How the name of a licence begins.
const LICENCES: [&str; 4] = ["LICENSE", "LICENCE", "COPYING", "NOTICE"];
/// No licence is longer, in bytes.
const LICENCE_MAX: u64 = 1 << 20;
/// No plugin has more licences.
const LICENCES_MAX: usize = 32;

/// Why a plugin could not be packed or unpacked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PackageError {
    /// A file cannot be read or written.
    #[error("{}: {source}", taceva_core::shown(path))]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The archive cannot be read or written, or is none.
    #[error("the archive: {0}")]
    Archive(io::Error),
    /// A part of the archive is not what belongs in it.
    #[error("`{}` in the archive: {problem}", crate::text::shown(.name))]
    Entry {
        /// Its name.
        name: String,
        /// What is wrong, and what is expected.
        problem: String,
    },
    /// The manifest in the archive has a mistake.
    #[error("`plugin.toml` in the archive, {0}")]
    Manifest(ManifestError),
}

impl PackageError {
    fn entry(name: &str, problem: impl Into<String>) -> PackageError {
        PackageError::Entry {
            name: name.to_owned(),
            problem: problem.into(),
        }
    }

    fn file(path: &Path, source: io::Error) -> PackageError {
        PackageError::File {
            path: path.to_owned(),
            source,
        }
    }
}

impl Plugin {
    /// What belongs to it, relative to its folder: the manifest, its library for this machine, and its licences.
    ///
    /// # Errors
    /// If its folder cannot be read.
    pub fn files(&self) -> io::Result<Vec<PathBuf>> {
        let library = self.library().map(|library| PathBuf::from(&library.path));
        let mut files = vec![PathBuf::from(MANIFEST)];
        files.extend(library);
        files.extend(licences(&self.folder)?);
        Ok(files)
    }
}

/// The licences in `folder`, by name.
fn licences(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut licences = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        if name.to_str().is_some_and(is_licence) && entry.path().is_file() {
            licences.push(PathBuf::from(name));
        }
    }
    licences.sort();
    Ok(licences)
}

fn is_licence(name: &str) -> bool {
    !name.contains('/') && LICENCES.iter().any(|word| name.starts_with(word))
}

/// The paths of all libraries that `manifest` names.
fn libraries(manifest: &Manifest) -> impl Iterator<Item = &str> {
    let platforms = manifest.platforms();
    platforms.filter_map(|platform| Some(manifest.library(platform)?.path.as_str()))
}

#[cfg(test)]
mod tests;

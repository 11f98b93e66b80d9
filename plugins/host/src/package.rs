//! Plugin package: a tar archive of the manifest, the digests of all other files, the libraries and the licences, in that order.
//!
//! The manifest determines the contents. Any other entry is rejected, so no file can be added to a package. Nothing is written outside the plugin's
//! folder.

mod read;
mod write;

use std::io;
use std::path::{Path, PathBuf};

pub use self::read::unpack;
pub use self::write::pack;
use crate::manifest::{Manifest, ManifestError};
use crate::search::{MANIFEST, Plugin};

/// Name of the file with the digests of all other files except the manifest, in the format of `sha256sum --check`.
const DIGESTS: &str = "SHA256SUMS";
/// Prefixes of licence file names.
const LICENCES: [&str; 4] = ["LICENSE", "LICENCE", "COPYING", "NOTICE"];
/// Maximum length of a licence, bytes.
const LICENCE_MAX: u64 = 1 << 20;
/// Maximum number of licences.
const LICENCES_MAX: usize = 32;

/// Failure to pack or unpack a plugin.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PackageError {
    /// A file cannot be read or written.
    #[error("{}: {source}", taceva_core::shown(path))]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The archive cannot be read or written, or is not a tar archive.
    #[error("the archive: {0}")]
    Archive(io::Error),
    /// An entry of the archive is invalid.
    #[error("`{}` in the archive: {problem}", crate::text::shown(.name))]
    Entry {
        /// Name of the entry.
        name: String,
        /// The fault and the expected value.
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
    /// Files of the plugin, relative to its folder: manifest, library for this machine, and licences.
    ///
    /// # Errors
    /// If the folder cannot be read.
    pub fn files(&self) -> io::Result<Vec<PathBuf>> {
        let library = self.library().map(|library| PathBuf::from(&library.path));
        let mut files = vec![PathBuf::from(MANIFEST)];
        files.extend(library);
        files.extend(licences(&self.folder)?);
        Ok(files)
    }
}

/// Licence files in `folder`, sorted by name.
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

/// Paths of all libraries in `manifest`.
fn libraries(manifest: &Manifest) -> impl Iterator<Item = &str> {
    let platforms = manifest.platforms();
    platforms.filter_map(|platform| Some(manifest.library(platform)?.path.as_str()))
}

#[cfg(test)]
mod tests;

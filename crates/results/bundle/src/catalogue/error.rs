//! Errors of a catalogue in a folder.

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_report::catalogue::CatalogueError;

use crate::error::BundleError;

/// Reason why a catalogue cannot be read, or refuses a bundle.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueFolderError {
    /// A file cannot be read or written.
    #[error("{}: {source}", shown(path))]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A file or a bundle breaks a rule of the catalogue.
    #[error("{}: {}", shown(path), shown(problem))]
    Refused {
        /// Path of the file or of the bundle.
        path: PathBuf,
        /// The fault and the remedy.
        problem: String,
    },
    /// A number of the bundle differs from the number computed from its files, or cannot be computed.
    #[error("{}: not verified, {}", shown(path), shown(problem))]
    Unverified {
        /// Path of the bundle.
        path: PathBuf,
        /// The number, and the command that lists all unverified numbers.
        problem: String,
    },
    /// An entry is invalid.
    #[error(transparent)]
    Entry(#[from] CatalogueError),
    /// The bundle cannot be read.
    #[error(transparent)]
    Bundle(Box<BundleError>),
}

impl From<BundleError> for CatalogueFolderError {
    fn from(error: BundleError) -> CatalogueFolderError {
        CatalogueFolderError::Bundle(Box::new(error))
    }
}

impl CatalogueFolderError {
    pub(super) fn file(path: &Path) -> impl FnOnce(io::Error) -> CatalogueFolderError {
        let path = path.to_owned();
        move |source| CatalogueFolderError::File { path, source }
    }

    pub(super) fn refused(path: &Path, problem: impl Into<String>) -> CatalogueFolderError {
        CatalogueFolderError::Refused {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }
}

//! Errors of bundles.

use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;
use taceva_core::shown;
use taceva_evaluate::EvaluateError;
use taceva_results::ResultsError;

/// Reason why a bundle cannot be made or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BundleError {
    /// A file cannot be read or written.
    #[error("{}: {source}", shown(path))]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The bundle is damaged, or the path is not a bundle.
    #[error("{0}")]
    Damaged(Damage),
    /// The results are refused.
    #[error("{}: {source}", shown(path))]
    Results {
        /// Path of the results.
        path: PathBuf,
        /// Reason for the refusal.
        source: ResultsError,
    },
    /// A state or a table is refused.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    /// A file of the request does not belong to the other files.
    #[error("{}: {problem}", shown(path))]
    Input {
        /// Path of the file.
        path: PathBuf,
        /// The fault and the remedy.
        problem: String,
    },
}

/// Finding that makes a bundle unusable.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("{}: {}", shown(path), shown(problem))]
#[non_exhaustive]
pub struct Damage {
    /// File in the bundle, or the bundle itself.
    pub path: String,
    /// Rule that the file breaks.
    pub rule: &'static str,
    /// Value found and value expected.
    pub problem: String,
}

impl Damage {
    pub(crate) fn new(path: &str, rule: &'static str, problem: impl Into<String>) -> Damage {
        Damage {
            path: path.to_owned(),
            rule,
            problem: problem.into(),
        }
    }
}

impl BundleError {
    pub(crate) fn file(path: &Path) -> impl FnOnce(io::Error) -> BundleError {
        let path = path.to_owned();
        move |source| BundleError::File { path, source }
    }

    pub(crate) fn input(path: &Path, problem: impl Into<String>) -> BundleError {
        BundleError::Input {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }
}

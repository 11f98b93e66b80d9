//! Request to add a bundle to a catalogue.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use crate::layout::MOST_BYTES;

/// Request to add a bundle to a catalogue.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct AddRequest {
    /// The bundle: a folder, or a `.tar.gz`.
    pub bundle: PathBuf,
    /// Folder of the catalogue, created if missing.
    pub catalogue: PathBuf,
    /// Public URL of the bundle; `None` if not given.
    pub url: Option<String>,
    /// Maximum size of all files of the bundle together, bytes.
    pub most: u64,
    /// Number of threads.
    pub jobs: NonZeroUsize,
}

impl AddRequest {
    /// Request to add the bundle at `bundle` to the catalogue at `catalogue`, on one thread.
    pub fn new(bundle: &Path, catalogue: &Path) -> AddRequest {
        AddRequest {
            bundle: bundle.to_owned(),
            catalogue: catalogue.to_owned(),
            url: None,
            most: MOST_BYTES,
            jobs: NonZeroUsize::MIN,
        }
    }
}

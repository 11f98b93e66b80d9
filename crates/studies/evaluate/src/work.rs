//! Threads, progress and cache of a stage; none of them changes its result.

use std::num::NonZeroUsize;

use taceva_core::Progress;

use crate::cache::Cache;

/// Threads, progress and cache of a stage.
#[derive(Clone, Copy)]
pub struct Work<'a> {
    /// Number of worker threads.
    pub jobs: NonZeroUsize,
    /// Receives progress, and may cancel the work.
    pub progress: &'a dyn Progress,
    /// Cache for features of frames, if any.
    pub cache: Option<&'a Cache>,
}

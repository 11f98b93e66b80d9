//! Threads, progress and cache of a stage. They do not affect its result.

use std::num::NonZeroUsize;

use taceva_core::Progress;

use crate::cache::Cache;

/// Threads, progress and cache of a stage.
#[derive(Clone, Copy)]
pub struct Work<'a> {
    /// Number of worker threads.
    pub jobs: NonZeroUsize,
    /// Observer that receives progress, and can cancel the work.
    pub progress: &'a dyn Progress,
    /// Cache for features of frames, if any.
    pub cache: Option<&'a Cache>,
}

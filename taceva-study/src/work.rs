//! With what a stage is carried out; nothing of it changes what comes out.

use std::num::NonZeroUsize;

use taceva_core::Progress;

use crate::cache::Cache;

/// Threads, listener and cache of a stage.
#[derive(Clone, Copy)]
pub struct Work<'a> {
    /// Worker threads.
    pub jobs: NonZeroUsize,
    /// Who listens, and may ask to stop.
    pub progress: &'a dyn Progress,
    /// Where features of frames are found and kept; nowhere if absent.
    pub cache: Option<&'a Cache>,
}

//! What the stages of a study share.

use std::path::Path;

use taceva_models::Models;

use taceva_evaluate::StudyCache;
use taceva_evaluate::Work;

/// What the stages of a study are carried out with: threads and progress, the cache, and the known models.
#[derive(Clone, Copy)]
pub(crate) struct RunContext<'a> {
    pub(crate) work: Work<'a>,
    pub(crate) cache: StudyCache<'a>,
    pub(crate) models: &'a Models,
    /// Where the checkpoint of a long training is.
    pub(crate) checkpoint: &'a Path,
}

//! State that the stages of a study share.

use std::path::Path;

use taceva_models::Models;

use taceva_evaluate::StudyCache;
use taceva_evaluate::Work;

/// Resources of the stages of a study: threads, progress display, cache, and the models that the program knows.
#[derive(Clone, Copy)]
pub(crate) struct RunContext<'a> {
    pub(crate) work: Work<'a>,
    pub(crate) cache: StudyCache<'a>,
    pub(crate) models: &'a Models,
    /// File for the checkpoint of an unfinished training.
    pub(crate) checkpoint: &'a Path,
    /// Common prefix of the names of the state files.
    pub(crate) states: &'a Path,
    /// File for the fitted model; `None` if the scene does not store models.
    pub(crate) model: Option<&'a Path>,
}

//! File names in the folder of a run.

/// Name of the file with a copy of the scene as the user wrote it.
pub(super) const SCENE: &str = "scene.toml";
/// Name of the folder of the reports.
pub(super) const REPORTS: &str = "reports";
/// Name of the folder of the figures.
pub(super) const FIGURES: &str = "figures";
/// Name of the folder of the errors of models under faults of pictures.
pub(super) const STRESS: &str = "stress";
/// Name of the file that lists the stages, and states for each if it was reused from the cache.
pub(super) const STAGES: &str = "stages.json";

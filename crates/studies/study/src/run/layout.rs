//! File names in the folder of a run.

/// Copy of the scene as the user wrote it.
pub(super) const SCENE: &str = "scene.toml";
/// Folder of the reports.
pub(super) const REPORTS: &str = "reports";
/// Folder of the figures.
pub(super) const FIGURES: &str = "figures";
/// Folder of the errors with faults.
pub(super) const STRESS: &str = "stress";
/// List of the stages and whether each was reused from the cache.
pub(super) const STAGES: &str = "stages.json";

//! File names in the folder of a run.

/// The scene as written.
pub(super) const SCENE: &str = "scene.toml";
/// The reports of studies.
pub(super) const REPORTS: &str = "reports";
/// The figures.
pub(super) const FIGURES: &str = "figures";
/// The list of stages, with those found in the cache.
pub(super) const STAGES: &str = "stages.json";

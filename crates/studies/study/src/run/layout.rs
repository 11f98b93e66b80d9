//! The names in the folder of a run.

/// The scene as it was written.
pub(super) const SCENE: &str = "scene.toml";
/// The reports of studies.
pub(super) const REPORTS: &str = "reports";
/// The figures.
pub(super) const FIGURES: &str = "figures";
/// Which stages were found rather than carried out.
pub(super) const STAGES: &str = "stages.json";

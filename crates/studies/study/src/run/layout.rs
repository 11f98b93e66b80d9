//! The names in the folder of a run.

/// The plans of the run; a folder that has them is known to be one.
pub(crate) const PLANS: &str = "plans.json";
/// The scene as it was written.
pub(super) const SCENE: &str = "scene.toml";
/// The recordings, a folder a study.
pub(crate) const RECORDINGS: &str = "recordings";
/// The reports of studies.
pub(super) const REPORTS: &str = "reports";
/// The figures.
pub(super) const FIGURES: &str = "figures";
/// Which stages were found rather than carried out.
pub(super) const STAGES: &str = "stages.json";

//! File names in the folder of a run by which a recording of it is recognised.

/// The plans of the run; a folder that has them is a run.
pub const PLANS: &str = "plans.json";
/// The recordings, a folder a study.
pub const RECORDINGS: &str = "recordings";

//! The names in the folder of a run by which a recording of it is known.

/// The plans of the run; a folder that has them is known to be one.
pub const PLANS: &str = "plans.json";
/// The recordings, a folder a study.
pub const RECORDINGS: &str = "recordings";

//! File names that identify the folder of a run.

/// File with the plans of the run; a folder with this file is a run.
pub const PLANS: &str = "plans.json";
/// Folder of the recordings, with one folder for each study.
pub const RECORDINGS: &str = "recordings";

//! File names that identify the folder of a run.

/// File with the plans of the run; a folder with this file is a run.
pub const PLANS: &str = "plans.json";
/// Folder of the recordings, with one folder for each study.
pub const RECORDINGS: &str = "recordings";
/// Folder of the states behind the scores, whose names begin with the number of the study.
pub const STATES: &str = "states";
/// Folder of the models that the scene keeps, whose names begin with the number of the study.
pub const MODELS: &str = "models";

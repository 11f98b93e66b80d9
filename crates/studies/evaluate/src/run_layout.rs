//! File names that identify the folder of a run.

/// Name of the file with the plans of the run. A folder with this file is a run.
pub const PLANS: &str = "plans.json";
/// Name of the folder of the recordings, which has one folder for each study.
pub const RECORDINGS: &str = "recordings";
/// Name of the folder of the state files behind the scores. File names begin with the number of the study.
pub const STATES: &str = "states";
/// Name of the folder of the models that the scene stores. File names begin with the number of the study.
pub const MODELS: &str = "models";

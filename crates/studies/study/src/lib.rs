#![doc = include_str!("../README.md")]

pub mod bench;
mod classifier;
mod error;
mod finished;
mod models;
mod run;
mod scored_width;
mod settings;
mod stage;

pub use error::StudyError;
pub use finished::{FinishedStudy, FittedStudy};
pub use models::check_models;
pub use run::{Existing, RunFolder, RunSetup, acquire_scene, run_scene};
pub use scored_width::{NoWidth, ScoredWidth, TestedPoints};

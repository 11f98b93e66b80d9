#![doc = include_str!("../README.md")]

mod acquire;
pub mod bench;
pub mod check;
mod error;
mod evaluate;
mod facts;
mod features;
mod fit;
mod plan;
mod predict;
mod provenance;
mod report;
mod rows;
mod run;
mod scene;
mod score;
mod stage;
mod state_file;
mod subject;
mod tally;

pub use acquire::{Surroundings, SurroundingsOf, Upcoming, Workshop};
pub use check::{CheckReport, CheckRequest, Finding, Severity, check, check_plan};
pub use error::StudyError;
pub use evaluate::{EvaluateRequest, Evaluated, ModelChoice, evaluate, evaluate_plan};
pub use fit::{FitRequest, Fitted, fit};
pub use plan::{Plan, Step};
pub use predict::{Predicted, predict};
pub use provenance::{ModelProvenance, Provenance};
pub use report::{EVALUATION_SCHEMA, EvaluationReport};
pub use rows::{Divided, Part};
pub use run::{Existing, RunFolder, run_scene};
pub use scene::{PlannedScene, PlannedStudy, SceneText};
pub use score::{ScoreRequest, Scored, Scoring};
pub use state_file::{STATE_SCHEMA, StateFile, merge};
pub use subject::Subject;

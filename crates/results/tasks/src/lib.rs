#![doc = include_str!("../README.md")]

mod classes;
mod clusters;
pub mod depth;
mod error;
mod estimate;
pub mod events;
mod evidence;
mod names;
pub mod pose;
mod probabilities;
mod public_definitions;
mod public_number;
mod quotient;
mod ranking;
mod report;
mod score;
pub mod shape;
mod share_of_sets;
mod state;
mod top_k;
mod totals;
mod undefined;
mod vector;

pub use classes::{Classes, ConfusionCell};
pub use error::TaskError;
pub use estimate::Estimate;
pub use evidence::{CurvePoint, TaskEvidence, WorstSample};
pub use probabilities::Probabilities;
pub use public_number::{PublicNumber, PublicProgram};
pub use ranking::Ranking;
pub use report::{ConfusionCount, TASKS_SCHEMA, TaskReport, TaskScores};
pub use score::{ScoreFlag, TaskScore};
pub use share_of_sets::PublishedShare;
pub use state::TaskState;
pub use top_k::TopK;
pub use undefined::Undefined;

#![doc = include_str!("../README.md")]

mod classes;
mod clusters;
mod error;
mod estimate;
mod names;
mod probabilities;
mod published;
mod quotient;
mod report;
mod ranking;
mod score;
mod top_k;
mod undefined;

pub use classes::{Classes, ConfusionCell};
pub use error::TaskError;
pub use estimate::Estimate;
pub use report::{ConfusionCount, TASKS_SCHEMA, TaskReport, TaskScores};
pub use probabilities::Probabilities;
pub use published::PublishedShare;
pub use ranking::Ranking;
pub use score::{ScoreFlag, TaskScore};
pub use top_k::TopK;
pub use undefined::Undefined;

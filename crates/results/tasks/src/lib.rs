#![doc = include_str!("../README.md")]

mod classes;
mod clusters;
pub mod depth;
mod error;
mod estimate;
mod names;
pub mod pose;
mod quotient;
mod score;
mod totals;
mod undefined;
mod vector;

pub use classes::{Classes, ConfusionCell};
pub use error::TaskError;
pub use estimate::Estimate;
pub use score::{ScoreFlag, TaskScore};
pub use undefined::Undefined;

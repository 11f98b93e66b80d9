#![doc = include_str!("../README.md")]

mod classes;
mod clusters;
mod error;
mod estimate;
mod names;
mod quotient;
mod score;
mod undefined;

pub use classes::{Classes, ConfusionCell};
pub use error::TaskError;
pub use estimate::Estimate;
pub use score::{ScoreFlag, TaskScore};
pub use undefined::Undefined;

#![doc = include_str!("../README.md")]

mod classes;
mod clusters;
pub mod depth;
mod error;
mod estimate;
pub mod events;
mod names;
pub mod pose;
mod quotient;
mod score;
pub mod shape;
mod totals;
mod undefined;
mod vector;

pub use classes::{Classes, ConfusionCell};
pub use error::TaskError;
pub use estimate::Estimate;
pub use score::{ScoreFlag, TaskScore};
pub use undefined::Undefined;

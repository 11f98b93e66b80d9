//! Evaluation of samples: plans, accumulators, states and finished scores.

pub(crate) mod accumulator;
#[cfg(feature = "ndarray")]
mod arrays;
pub(crate) mod batch_clusters;
pub(crate) mod entry;
pub(crate) mod evaluation;
pub(crate) mod evaluator;
pub(crate) mod family;
pub(crate) mod metric;
pub(crate) mod number;
#[cfg(feature = "rayon")]
mod parallel;
pub(crate) mod plan;
pub(crate) mod rows;
pub(crate) mod sample_clusters;
pub(crate) mod settings;
pub(crate) mod state;
pub(crate) mod verdicts;

pub use evaluation::Evaluation;
pub use evaluator::Evaluator;
pub use metric::{Metric, ScoreUnit};
pub use number::Number;
pub use plan::MetricPlan;
pub use rows::Rows;
pub use settings::Settings;
pub use state::State;

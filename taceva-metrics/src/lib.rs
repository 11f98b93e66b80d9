#![doc = include_str!("../README.md")]

mod accumulator;
mod accuracy;
pub mod catalogue;
mod clusters;
mod error;
mod evaluate;
mod evaluation;
mod exact;
mod merge;
mod metric;
mod pair_sums;
mod paired;
mod plan;
mod plane_sums;
mod score;
mod state;
mod stats;
mod streams;
mod value;

pub use accuracy::EPSILON;
pub use clusters::{Clusters, HASHED_CLUSTERS, NAMED_CLUSTERS};
pub use error::{MetricError, UnknownMetric};
pub use evaluate::Evaluator;
pub use evaluation::Evaluation;
pub use exact::{Canonical, CanonicalError, ExactSum, Isa, IsaError};
pub use metric::{Better, Metric, ScoreUnit};
pub use pair_sums::{PairSpec, PairSums};
pub use paired::{GREATEST, Paired};
pub use plan::MetricPlan;
pub use plane_sums::PlaneSums;
pub use score::{Interval, Parameter, Score};
pub use state::{Record, State};
pub use stats::{
    BootstrapEnds, ClusterSum, ClusterSums, ComparisonError, Difference, DifferenceTest, Estimate,
    IntervalMethod, PoissonBootstrap, Question, Side, Sides, SignFlip, Verdict, holm, welch,
};
pub use streams::{Stream, Streams};
pub use value::{InapplicableReason, UndefinedReason, Value};

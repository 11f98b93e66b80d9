#![doc = include_str!("../README.md")]

#[cfg(feature = "bench")]
pub mod bench;
pub mod catalogue;
mod count;
pub mod distributions;
pub mod elementary;
mod error;
mod evaluate;
mod exact;
mod families;
mod geometry;
mod pair;
mod score;
mod stats;

pub use catalogue::UnknownMetric;
pub use error::MetricError;
pub use evaluate::{
    Evaluation, Evaluator, Metric, MetricPlan, Number, Rows, ScoreUnit, Settings, State,
};
pub use exact::{
    Canonical, CanonicalError, Dyadic, ExactSum, Fraction, Moments, Record, Stream, Streams,
};
pub use families::accuracy::pair_sums::{PairSpec, PairSums};
pub use families::accuracy::plane::{PLANES, plane_axes, plane_of};
pub use families::intrinsic::times::STREAM_S;
pub use geometry::{Nearest, NearestPoints};
pub use pair::{EPSILON, GREATEST, Paired};
pub use score::curve::{Band, Curve};
pub use score::direction::Better;
pub use score::flag::Flag;
pub use score::least::LEAST_CLUSTERS;
pub use score::map::Map;
pub use score::matrix::Matrix;
pub use score::range::Range;
pub use score::theme::Theme;
pub use score::value::{InapplicableReason, UndefinedReason, Value};
pub use score::verdict_standing::Standing;
pub use score::{
    BootstrapEnds, ClusteredBy, Count, Fact, Interval, Parameter, Scale, Score, SensorFacts,
    Variant,
};
pub use stats::{
    ClusterSum, ClusterSums, Clusters, ComparisonError, Difference, DifferenceLine, DifferenceTest,
    Estimate, HASHED_CLUSTERS, IntervalMethod, LeftOut, NAMED_CLUSTERS, NormalSample, OneWay,
    OneWaySums, PoissonBootstrap, Proportional, Question, Repeats, Side, Sides, SignFlip,
    StatedInterval, TrainingSpread, Verdict, by_intervals, decide, holm, p_value, p_words,
    paired_over_trainings,
};
// Types in these signatures, so that a caller needs no other crate.
pub use taceva_core::{
    Batch, BatchBuilder, Channel, ChannelError, Channels, Column, Field, FieldSet, Footprint,
    FootprintError, GratingKind, Isa, IsaError, Labels, Nanometre, Needs, Newton, Phase, Readings,
    Sample, SampleSink, SinkError, SkipReason, Skipped, Stamp, Unit,
};

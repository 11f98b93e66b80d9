#![doc = include_str!("../README.md")]

mod accumulator;
mod accuracy;
#[cfg(feature = "ndarray")]
mod arrays;
mod better;
mod bias_level;
pub mod catalogue;
mod cells;
mod channelwise;
mod clusters;
mod crosstalk;
mod curve;
mod detection;
mod drift;
mod error;
mod evaluate;
mod evaluation;
mod exact;
mod exactly;
mod facts;
mod flag;
mod geometry;
mod hysteresis;
mod independent;
mod inter_sensor;
mod intrinsic;
#[cfg(feature = "bench")]
pub mod kernels;
mod level;
mod lighting;
mod linearity;
mod map;
mod matrix;
mod merge;
mod metric;
mod moments;
mod number;
mod ordered;
mod pair_sums;
mod paired;
#[cfg(feature = "rayon")]
mod parallel;
mod plan;
mod plane_sums;
mod range;
mod repeatability;
mod resolution;
mod rows;
mod score;
mod settings;
mod spatial;
mod spread;
mod standing;
mod state;
mod stats;
mod streams;
mod surface;
mod tolerance;
mod value;

pub use accuracy::EPSILON;
pub use better::Better;
pub use clusters::{Clusters, HASHED_CLUSTERS, NAMED_CLUSTERS};
pub use curve::{Band, Curve};
pub use error::{MetricError, UnknownMetric};
pub use evaluate::Evaluator;
pub use evaluation::Evaluation;
pub use exact::{Canonical, CanonicalError, ExactSum};
pub use facts::{Fact, SensorFacts};
pub use flag::Flag;
pub use map::Map;
pub use matrix::Matrix;
pub use metric::{Metric, ScoreUnit};
pub use number::Number;
pub use pair_sums::{PairSpec, PairSums};
pub use paired::{GREATEST, Paired};
pub use plan::MetricPlan;
pub use plane_sums::PlaneSums;
pub use range::Range;
pub use rows::Rows;
pub use score::{ClusteredBy, Count, Interval, Parameter, Score, Variant};
pub use settings::Settings;
pub use standing::{GREATEST_BOUNDED_SHARE, Standing};
pub use state::{Record, State};
pub use stats::{
    BootstrapEnds, ClusterSum, ClusterSums, ComparisonError, Difference, DifferenceTest, Estimate,
    IntervalMethod, PoissonBootstrap, Question, Repeats, Scale, Side, Sides, SignFlip, Verdict,
    decide, holm, welch,
};
pub use streams::{Stream, Streams};
// What signatures here name, so that a caller needs no other crate.
pub use taceva_core::{
    Batch, BatchBuilder, Channel, ChannelError, Channels, Column, Field, FieldSet, Footprint,
    FootprintError, GratingKind, Isa, IsaError, Labels, Nanometre, Needs, Phase, Readings, Sample,
    SampleSink, SinkError, SkipReason, Skipped, Stamp, Unit,
};
pub use value::{InapplicableReason, UndefinedReason, Value};

#![doc = include_str!("../README.md")]

mod channels;
mod error;
mod folds;
mod formula;
mod group_errors;
mod interval;
mod ordered_map;
mod origin;
mod provenance;
mod report;
mod samples;
mod schema;
mod score;
mod seeds;
mod subject;
mod task;
mod value;

pub use error::ResultsError;
pub use folds::kept_together;
pub use formula::{escape_csv, unescape_csv};
pub use group_errors::{GroupError, GroupErrors, group_errors};
pub use interval::{Interval, described_method};
pub use origin::not_measured;
pub use provenance::{ModelProvenance, OPTIMISTIC, Provenance, RecordingProvenance};
pub use report::{EVALUATION_SCHEMA, EvaluationReport, RecordingScores, Skip};
pub use samples::{DominantSample, SampleChannel, Samples, SamplesError};
pub use schema::{RUN_SCHEMA, RunReport, read, sealed};
pub use score::{Score, ScoreLine, Variant, by_metric, full_name, scores};
pub use seeds::{OverSeeds, SeedScore};
pub use subject::Subject;
pub use task::{StudyTask, TaskNumber};
pub use value::Value;

//! Benchmarks of `taceva bench`: run time compared with error.

mod front;
mod kernels;
mod machine;
mod models;
mod paired_errors;
mod stopwatch;
mod studies;
mod study_coverage;
mod study_grid;

pub use kernels::{Floor, InputDigits, KernelBench, KernelRequest, KernelRow, kernels};
pub use machine::Machine;
pub use models::{ModelRace, ModelTrial, ModelTrials, TrialError, models};
pub use stopwatch::{Spread, Stopwatch};
pub use studies::{STUDY_CHANNELS, StudyBench, StudyChannel, StudyTrial, studies};
pub use study_coverage::StudyCoverage;
pub use study_grid::{StudyEntry, StudyGrid, StudyVariant};

/// Schema of every benchmark as JSON.
pub const BENCH_SCHEMA: &str = "taceva.bench/1";

//! Benchmarks of `taceva bench`: run time against error.

mod front;
mod kernels;
mod machine;
mod models;
mod paired_errors;
mod stopwatch;

pub use kernels::{Floor, InputDigits, KernelBench, KernelRequest, KernelRow, kernels};
pub use machine::Machine;
pub use models::{ModelRace, ModelTrial, ModelTrials, TrialError, models};
pub use stopwatch::{Spread, Stopwatch};

/// Schema of every benchmark as JSON.
pub const BENCH_SCHEMA: &str = "taceva.bench/1";

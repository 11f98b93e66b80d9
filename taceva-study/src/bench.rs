//! Run time against error: what `taceva bench` measures, as data.

mod machine;
mod stopwatch;

pub use machine::Machine;
pub use stopwatch::{Spread, Stopwatch};

/// The schema of every benchmark as JSON.
pub const BENCH_SCHEMA: &str = "taceva.bench/1";

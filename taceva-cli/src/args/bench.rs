//! What is typed of benchmarks.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::Output;

#[derive(Debug, Args)]
pub(crate) struct Bench {
    #[command(subcommand)]
    pub(crate) subject: BenchSubject,
}

/// What to benchmark.
#[derive(Debug, Subcommand)]
pub(crate) enum BenchSubject {
    /// The ways to sum: nanoseconds for each pair of values against digits that are right
    Kernels(BenchKernels),
}

/// Naive, two-pass, pairwise, Kahan, Neumaier and Welford sums and ours on every instruction set, over inputs that tell them
/// apart; beside them what reading the columns takes. TACEVA_ISA=avx512|avx2|portable forces the path of every other command.
#[derive(Debug, Args)]
pub(crate) struct BenchKernels {
    /// Rows of each of the six channels
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    pub(crate) rows: usize,
    /// How often each candidate is timed
    #[arg(long, value_name = "N", default_value_t = 15)]
    pub(crate) rounds: usize,
    /// The seed of columns and shuffles
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Draw time against digits as SVG
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) svg: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

//! What is typed of benchmarks.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::{Output, SplitArgs};

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
    /// JPEG at a fraction of its size: what decoding takes against how much further off a model is
    Decode(BenchDecode),
    /// The models: what fitting, predicting and one prediction take against how far off they are
    Models(BenchModels),
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

/// Fits every model on the training part of one recording and scores it on the test part of the same split: mean absolute errors with
/// intervals by contact point, beside seconds to fit, to predict, and from one frame to its prediction. A model that cannot be fitted on
/// the recording says why and the race goes on.
#[derive(Debug, Args)]
pub(crate) struct BenchModels {
    /// The dataset; without one the simulated bench presses a sensor first: 400 points of four presses
    #[arg(value_name = "DATASET")]
    pub(crate) dataset: Option<PathBuf>,
    /// A model, its settings after a colon: ridge, knn:size=16x16, cnn:epochs=20,batch=16; may be repeated
    /// [default: all but resnet10, resnet18, resnet34 and auto, which take long]
    #[arg(long = "model", value_name = "NAME[:KEY=VALUE,…]")]
    pub(crate) models: Vec<String>,
    /// How often each model is fitted, in turns; the least processor time counts
    #[arg(long, value_name = "N", default_value = "1")]
    pub(crate) rounds: NonZeroUsize,
    /// Few presses where the bench presses, and short trainings where no model is named
    #[arg(long)]
    pub(crate) quick: bool,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    /// Draw time against error as SVG, the Pareto front marked
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) svg: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Decodes every frame at full size, 1/2, 1/4 and 1/8, fits a model on the training part at each and scores it on the test part of the same
/// split: milliseconds to read, verify and decode a frame beside mean absolute errors, and how much more they are than at full size, with
/// intervals by contact point. Only JPEG can be decoded so; a dataset of PNG is refused.
#[derive(Debug, Args)]
pub(crate) struct BenchDecode {
    /// The dataset, of JPEG frames; without one the simulated bench presses a sensor first, 400 points of four presses, whose frames are then
    /// rounded to 8 bits and encoded as JPEG of quality 95 among temporary files
    #[arg(value_name = "DATASET")]
    pub(crate) dataset: Option<PathBuf>,
    /// The model, its settings after a colon: ridge:size=16x16
    #[arg(long, value_name = "NAME[:KEY=VALUE,…]", default_value = "ridge")]
    pub(crate) model: String,
    /// Few presses where the bench presses
    #[arg(long)]
    pub(crate) quick: bool,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    /// Draw decode time against error as SVG, the Pareto front marked
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) svg: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

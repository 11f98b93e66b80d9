//! Arguments of benchmarks.

use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::{Output, SeedArgs, SplitArgs};

#[derive(Debug, Args)]
pub(crate) struct Bench {
    #[command(subcommand)]
    pub(crate) subject: BenchSubject,
}

/// Subject of a benchmark.
#[derive(Debug, Subcommand)]
pub(crate) enum BenchSubject {
    Kernels(BenchKernels),
    Models(BenchModels),
    Study(BenchStudy),
}

/// Summation kernels: nanoseconds for each pair of values against correct digits
///
/// Compares naive, two-pass, pairwise, Kahan, Neumaier and Welford sums with the sums of TacEva on every instruction set. The inputs are chosen
/// to show differences. The time to read the columns is the lower limit. TACEVA_ISA=avx512|avx2|portable forces the path of every other command.
#[derive(Debug, Args)]
pub(crate) struct BenchKernels {
    /// The number of rows of each of the six channels
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    pub(crate) rows: usize,
    /// Number of times each kernel is timed
    #[arg(long, value_name = "N", default_value_t = 15)]
    pub(crate) rounds: usize,
    #[command(flatten)]
    pub(crate) seed: SeedArgs,
    #[command(flatten)]
    pub(crate) figure: FigureArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Models: times of the fit, of all predictions and of one prediction, against the error
///
/// Fits every model on the training part of one recording and scores it on the test part of the same split. The table has mean absolute errors with
/// intervals by contact point, and the seconds to fit, to predict, and from one frame to its prediction. A model that cannot be fitted is listed with
/// the reason, and the others continue.
#[derive(Debug, Args)]
pub(crate) struct BenchModels {
    /// The dataset [default: a recording of the simulated bench, 400 contact points with four presses each]
    #[arg(value_name = "DATASET")]
    pub(crate) dataset: Option<PathBuf>,
    /// A model, its settings after a colon: ridge, knn:size=16x16, cnn:epochs=20,batch=16; may be repeated
    /// [default: all but resnet10, resnet18, resnet34, cnn-ensemble, smartcore/lasso, smartcore/gradient-boosting and auto, which take long]
    #[arg(long = "model", value_name = "NAME[:KEY=VALUE,…]")]
    pub(crate) models: Vec<String>,
    /// Number of fits of each model; the models take turns, and the shortest processor time is reported
    #[arg(long, value_name = "N", default_value = "1")]
    pub(crate) rounds: NonZeroUsize,
    /// Fewer simulated presses, and short trainings unless --model is given
    #[arg(long)]
    pub(crate) quick: bool,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    #[command(flatten)]
    pub(crate) figure: FigureArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Whole studies: processor time of presses, fits and scores against the widths of the intervals
///
/// Runs a study of the simulated bench for each combination of points, folds and models, without a cache. The table has the processor seconds of
/// this process, without those of plugin processes. Mean absolute errors have 95 % intervals by contact point. The width of an interval is
/// ln(upper end / lower end). A row is on the Pareto front if no other row has both less time and a lower mean width over the errors. With --seeds,
/// the table also has the coverage of the intervals: the share of repetitions whose interval contains the mean error of the other repetitions.
#[derive(Debug, Args)]
pub(crate) struct BenchStudy {
    /// A file, or the name of a built-in scene: quick, paper. All its devices must be simulated
    #[arg(value_name = "SCENE", default_value = "quick")]
    pub(crate) scene: String,
    /// The study of the scene [default: MagicTac, or the first study if the scene has no MagicTac]
    #[arg(long, value_name = "NAME")]
    pub(crate) study: Option<String>,
    /// Numbers of calibration points, separated by commas
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_values = ["100", "200", "400"])]
    pub(crate) points: Vec<u32>,
    /// Numbers of folds, separated by commas: none scores the test part by one model, 5 scores all points by five models
    #[arg(long, value_name = "K,…", value_delimiter = ',', value_parser = Folds::read, default_values = ["none", "3", "5"])]
    pub(crate) folds: Vec<Folds>,
    /// Models, separated by commas. The scene's own model has the settings of the scene, others their defaults. All use the split of the scene
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', default_values = ["ridge", "cnn"])]
    pub(crate) models: Vec<String>,
    /// The seed of all random numbers, instead of the scene's
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// Repetitions of each study with consecutive seeds, for the coverage; times and widths are their means
    #[arg(long, value_name = "N", default_value = "1")]
    pub(crate) seeds: NonZeroU32,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Number of folds; `None` for one test part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Folds(pub(crate) Option<u32>);

impl Folds {
    fn read(text: &str) -> Result<Folds, String> {
        match text {
            "none" => Ok(Folds(None)),
            _ => text
                .parse()
                .map(|folds| Folds(Some(folds)))
                .map_err(|_| "expected none or a whole number".to_owned()),
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct FigureArgs {
    /// Draw time against error as SVG, the Pareto front marked
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) svg: Option<PathBuf>,
}

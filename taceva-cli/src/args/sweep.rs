//! Arguments of `taceva sweep`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

use super::{CacheArgs, Output};

/// An example of a sweep file.
const FILE_HELP: &str = "\
The file:
  sweep_version = 1
  name = \"which network, which size\"
  datasets = [\"monday\", \"units/*\"]         # folders, relative to the file
  scenes = [\"quick\"]                       # beside or instead of datasets: scenes of the simulated bench, acquired first
  task = \"slip\"                            # scores a task of the recordings instead of channels; its models are classifiers
  models = [\"ridge\", { name = \"cnn\", set = { epochs = 60 } }]
  seeds = \"1-5\"                            # or [1, 2, 3]
  splits = [\"by-point\"]
  [vary]
  size = [\"32x32\", \"64x64\"]                # any setting
  [skip]
  where = [\"model = ridge and size = 64x64\"]
  [slurm]
  partition = \"main\"
  time = \"00:30:00\"
  memory = \"4G\"
  tasks_a_job = 8
  setup = [\"module load taceva\"]

Predictions of another program, in shards, instead of recordings and models:
  [score]
  truth = \"truth.parquet\"                  # CSV or Parquet
  pred = \"pred.parquet\"
  shards = 8

The same command continues a stopped sweep. `taceva sweep show FILE --by model,size` prints results.";

/// Evaluate many combinations of recordings, models, settings, splits and seeds, here or on a cluster
///
/// Every combination of recordings, models, settings, splits and seeds is a task; its result file is named by the digest of all its inputs. The
/// table, its digest and the page depend neither on the number of workers nor on where tasks ran. The exit code is 1 if a task failed or a limit was
/// missed.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true, after_help = FILE_HELP)]
pub(crate) struct Sweep {
    #[command(subcommand)]
    pub(crate) subject: Option<SweepSubject>,
    #[command(flatten)]
    pub(crate) run: SweepRun,
}

#[derive(Debug, Args)]
pub(crate) struct SweepRun {
    /// The file of the sweep
    #[arg(required = true, value_name = "FILE.toml")]
    pub(crate) file: Option<PathBuf>,
    /// The folder of results [default: FILE.sweep, beside the file]
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    /// Print the number of tasks and of results found, and the estimated cost of the rest; run nothing
    #[arg(long)]
    pub(crate) dry_run: bool,
    /// Retry tasks that failed before
    #[arg(long)]
    pub(crate) retry_failed: bool,
    /// Only matching tasks: those whose key begins with this text, or that meet terms such as "model = ridge and seed != 3"
    #[arg(long, value_name = "KEY|WHERE")]
    pub(crate) only: Option<String>,
    /// The engine that runs the tasks
    #[arg(long, value_enum, value_name = "ENGINE", default_value_t = SweepEngine::Here)]
    pub(crate) on: SweepEngine,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}

/// Engine that runs the tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SweepEngine {
    /// In workers of this process, as many as --jobs states
    Here,
    /// As jobs of Slurm; the command returns once they are submitted
    Slurm,
    /// By another engine: writes the list of tasks, and prints the command of a task
    List,
}

/// Operation on a sweep.
#[derive(Debug, Subcommand)]
pub(crate) enum SweepSubject {
    /// Print means of a metric over tasks, grouped by any key that varies
    Show(SweepShow),
    /// Print the number of finished tasks, and the jobs of the scheduler
    Status(SweepFolderArgs),
    /// Cancel the jobs of a sweep; results are kept
    Cancel(SweepFolderArgs),
    /// Make the table and the pages of the existing results; the exit code is 1 if a result is missing or a limit was missed
    Collect(SweepCollect),
    /// Run some tasks of a list, as a job of a scheduler does
    Task(SweepTask),
}

#[derive(Debug, Args)]
pub(crate) struct SweepFolderArgs {
    /// The file of the sweep, or the folder of its results
    #[arg(value_name = "FILE|FOLDER")]
    pub(crate) sweep: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct SweepShow {
    #[command(flatten)]
    pub(crate) of: SweepFolderArgs,
    /// Keys that group the rows, separated by commas: model, dataset, task, split, seed, or a setting
    #[arg(
        long,
        value_name = "WORDS",
        value_delimiter = ',',
        default_value = "model"
    )]
    pub(crate) by: Vec<String>,
    /// The metric whose means are printed
    #[arg(long, value_name = "METRIC", default_value = "mae")]
    pub(crate) metric: String,
    #[command(flatten)]
    pub(crate) output: Output,
}

#[derive(Debug, Args)]
pub(crate) struct SweepCollect {
    #[command(flatten)]
    pub(crate) of: SweepFolderArgs,
    /// The list of tasks [default: the list of the last call]
    #[arg(long, value_name = "TASKS.json")]
    pub(crate) tasks: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct SweepTask {
    /// The folder of results
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
    /// The list of tasks
    #[arg(long, value_name = "TASKS.json")]
    pub(crate) tasks: PathBuf,
    /// Positions in the list, from 0, separated by commas
    #[arg(long, value_name = "N,…", value_delimiter = ',', required = true)]
    pub(crate) at: Vec<usize>,
    /// Retry tasks that failed before
    #[arg(long)]
    pub(crate) retry_failed: bool,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}

//! What was typed. Meaning is given to it in `cmd/`; nothing here has a side effect.

mod bench;
mod cache;
mod plugin;
mod results;
mod shared;
mod study;

use std::path::PathBuf;

use clap::{ArgGroup, Args, Parser, Subcommand};
use taceva_models::Checkpoints;

pub(crate) use self::bench::{Bench, BenchDecode, BenchKernels, BenchModels, BenchSubject};
pub(crate) use self::cache::{CacheCommand, CacheList, CachePrune, CacheSubject};
pub(crate) use self::plugin::{
    Plugin, PluginArgs, PluginCheck, PluginHeaders, PluginInfo, PluginList, PluginNew,
    PluginRelease,
};
pub(crate) use self::results::{
    Accept, CatalogueArgs, CatalogueShow, CatalogueSite, CatalogueSubject, Choose, Compare,
};
pub(crate) use self::shared::{
    CacheArgs, Format, ModelArgs, OptionalModelArgs, Output, PartArg, SettingArgs, SplitArgs,
};
pub(crate) use self::study::{ListFormat, Listing, PlanArgs, Run, SceneArgs};

const AFTER_HELP: &str = "\
Start here:
  taceva run                                           four sensors on the simulated bench, every metric
  taceva import FOLDER --map MAP.toml --to DATASET     a lab's folder becomes a dataset
  taceva evaluate DATASET --model ridge                how well does the sensor measure?

Exit codes:
  0 done   1 done, but a check failed   2 usage   3 bad input   4 a device failed
  5 stopped by a signal   70 a bug of ours";

/// How well does a vision-based tactile sensor measure?
#[derive(Debug, Parser)]
#[command(name = "taceva", version, after_help = AFTER_HELP, max_term_width = 110)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
    #[command(flatten)]
    pub(crate) everywhere: Everywhere,
}

/// What every command understands.
#[derive(Debug, Args)]
pub(crate) struct Everywhere {
    /// Worker threads; the result does not depend on it [default: all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) jobs: Option<u16>,
    /// Print results and errors only
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Say more on standard error
    #[arg(long, short, global = true, action = clap::ArgAction::Count)]
    pub(crate) verbose: u8,
    #[command(flatten)]
    pub(crate) plugins: PluginArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Turn a lab's folder of pictures and labels into a dataset
    Import(Import),
    /// Look for what spoils a recording, before any number is computed
    Check(Check),
    /// Fit a model on the training part of a dataset and write it to a file
    Fit(Fit),
    /// Fit or take a model, and say how well it measures on data it has not seen
    Evaluate(Evaluate),
    /// Write a model's predictions as a table
    Predict(Predict),
    /// Score someone else's predictions: no pictures, no model
    Score(Score),
    /// Join what shards have kept; the scores equal those of one unsharded run, bit for bit
    Merge(Merge),
    /// Accept a deliberate edit of a sealed file, and write it with its reason into the file's history
    Reseal(Reseal),
    /// Say which of several sensors or models is better, by how much, and how sure that is
    Compare(Compare),
    /// Find sensors for a task, with the numbers that decided
    Choose(Choose),
    /// Hold a result to limits, and write its data sheet
    Accept(Accept),
    /// What was published of sensors, each number with its source
    Catalogue(CatalogueArgs),
    /// List what is kept for later runs, or remove what is old or too much
    Cache(CacheCommand),
    /// Run time against error, with the Pareto front marked
    Bench(Bench),
    /// Plan, acquire, fit, evaluate and report a scene; without one, four sensors on the simulated bench
    Run(Run),
    /// Say what `run` would do with a scene, keep and skip, and why; opens no device
    Plan(PlanArgs),
    /// List every driver, what it can do and what it may be told, and the devices that are present
    Devices(Listing),
    /// List plugins, look at one closely, check whether it keeps its promises, or begin one
    #[command(subcommand)]
    Plugin(Plugin),
    /// Look at this machine: what a rig could use, what stands in the way, and what to do about it
    Doctor(Listing),
    /// Print a script that completes taceva's arguments in a shell
    Completions(Completions),
}

/// The map says, in TOML, which column is which channel, in which unit, and where the pictures are.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("layout").required(true).args(["map", "preset"]))]
pub(crate) struct Import {
    /// The folder that holds the table and the pictures
    pub(crate) source: PathBuf,
    /// The map; see the documentation of taceva-dataset for its keys
    #[arg(long, value_name = "MAP.toml")]
    pub(crate) map: Option<PathBuf>,
    /// A layout that is known already: bristol, py3dcal
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    /// The dataset to write: a new folder
    #[arg(long, value_name = "DATASET", required_unless_present = "explain")]
    pub(crate) to: Option<PathBuf>,
    /// Say what would be read, converted and dropped, and stop
    #[arg(long)]
    pub(crate) explain: bool,
    /// Replace a dataset that stands there already
    #[arg(long)]
    pub(crate) force: bool,
}

/// Files that decide a number or a claim are sealed: dataset.toml, results, states and models. One that was changed is refused until the edit
/// is accepted here; reports show the history. A model is not edited but fitted again.
#[derive(Debug, Args)]
pub(crate) struct Reseal {
    /// The dataset, or the file: dataset.toml, results or a state
    #[arg(value_name = "FILE|DATASET")]
    pub(crate) file: PathBuf,
    /// Why it was changed; reports show it
    #[arg(long, value_name = "TEXT")]
    pub(crate) reason: String,
}

/// Every finding has a stable code and a hint. Exit code 1 if there is an error among them.
#[derive(Debug, Args)]
pub(crate) struct Check {
    /// The dataset to look at
    pub(crate) dataset: PathBuf,
    /// Look for these codes only, separated by commas
    #[arg(long, value_name = "CODES", value_delimiter = ',')]
    pub(crate) only: Vec<String>,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    /// Say what is looked for, and stop
    #[arg(long)]
    pub(crate) explain: bool,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// A network that is trained is put aside every half a minute, and when it is stopped, in the file MODEL.checkpoint; the same command
/// goes on from it, ends with the same bytes as one that nobody stopped, and removes it.
#[derive(Debug, Args)]
pub(crate) struct Fit {
    /// The dataset to learn from
    pub(crate) dataset: PathBuf,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    /// The model file to write
    #[arg(long, value_name = "MODEL")]
    pub(crate) out: PathBuf,
    /// Write the ids of the training, validation and test samples as JSON
    #[arg(long, value_name = "SPLIT.json")]
    pub(crate) split_out: Option<PathBuf>,
    /// Put a training aside after so many seconds, 0 for after each step
    #[arg(long, value_name = "SECONDS", default_value_t = Checkpoints::EVERY.as_secs())]
    pub(crate) checkpoint_every: u64,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    /// Replace a file that stands there already, and the checkpoint of another training
    #[arg(long)]
    pub(crate) force: bool,
}

/// With --model, the model is fitted on the training part, its settings are chosen on the validation part, and the test
/// part is scored. With --with, a fitted model is used: on its own dataset only the part it has not seen is scored.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("which").required(true).args(["with", "name"]))]
pub(crate) struct Evaluate {
    /// The dataset to evaluate
    pub(crate) dataset: PathBuf,
    /// A fitted model file
    #[arg(long, value_name = "MODEL")]
    pub(crate) with: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) model: OptionalModelArgs,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    /// Which samples to score [default: test, or all if the model was fitted on another dataset]
    #[arg(long, value_enum)]
    pub(crate) part: Option<PartArg>,
    /// Metrics, separated by commas: ids, or the groups accuracy and all
    #[arg(
        long,
        value_name = "METRICS",
        value_delimiter = ',',
        default_value = "all"
    )]
    pub(crate) metrics: Vec<String>,
    /// What is known of the sensor: footprint, greatest depth, opacity; metrics that need more than this has are skipped
    #[arg(long, value_name = "SENSOR.toml")]
    pub(crate) sensor: Option<PathBuf>,
    /// Write what was kept, for `taceva merge`
    #[arg(long, value_name = "STATE")]
    pub(crate) state_out: Option<PathBuf>,
    /// Write a page to look at, to print and to send: one file that needs no network
    #[arg(long, value_name = "FILE.html")]
    pub(crate) html: Option<PathBuf>,
    /// Write every figure into this folder, as SVG and PDF
    #[arg(long, value_name = "FOLDER")]
    pub(crate) figures: Option<PathBuf>,
    /// Write truth and prediction of every sample as CSV, for `taceva compare`
    #[arg(long, value_name = "SAMPLES.csv")]
    pub(crate) samples_out: Option<PathBuf>,
    /// Say what would be read, decoded, fitted and skipped, and stop
    #[arg(long)]
    pub(crate) explain: bool,
    /// Write the ids of the training, validation and test samples as JSON
    #[arg(long, value_name = "SPLIT.json")]
    pub(crate) split_out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

#[derive(Debug, Args)]
pub(crate) struct Predict {
    /// The dataset to predict
    pub(crate) dataset: PathBuf,
    /// A fitted model file
    #[arg(long, value_name = "MODEL")]
    pub(crate) with: PathBuf,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    /// Which samples to predict [default: test, or all if the model was fitted on another dataset]
    #[arg(long, value_enum)]
    pub(crate) part: Option<PartArg>,
    /// The table of predictions to write; `score --pred` reads it
    #[arg(long, value_name = "PRED.csv")]
    pub(crate) out: PathBuf,
    /// Write predictions as the model gives them, not brought back to its bounds: what robustness is formed from
    #[arg(long)]
    pub(crate) unbounded: bool,
    /// Also write the standard deviation of each prediction, of a model that knows it: gaussian-process
    #[arg(long, value_name = "DEVIATIONS.csv")]
    pub(crate) deviations_out: Option<PathBuf>,
    /// Also write what is true of the same samples; `score --truth` reads it
    #[arg(long, value_name = "TRUTH.csv")]
    pub(crate) truth_out: Option<PathBuf>,
    /// Replace files that stand there already
    #[arg(long)]
    pub(crate) force: bool,
}

/// Both tables have a header with channel names; rows are matched by `id` where both have one, else by order.
#[derive(Debug, Args)]
pub(crate) struct Score {
    /// What is true: a table with columns Px,Py,Pz (mm), Fx,Fy,Fz (N) or named others
    #[arg(long, value_name = "TRUTH.csv")]
    pub(crate) truth: PathBuf,
    /// What was predicted: a table with the same channels
    #[arg(long, value_name = "PRED.csv")]
    pub(crate) pred: PathBuf,
    /// Units of channels beside the six, as NAME=UNIT, separated by commas [default: 1]
    #[arg(long, value_name = "NAME=UNIT", value_delimiter = ',')]
    pub(crate) units: Vec<String>,
    /// Metrics, separated by commas: ids, or the groups accuracy and all
    #[arg(
        long,
        value_name = "METRICS",
        value_delimiter = ',',
        default_value = "all"
    )]
    pub(crate) metrics: Vec<String>,
    /// What is known of the sensor: footprint, greatest depth, opacity; metrics that need more than this has are skipped
    #[arg(long, value_name = "SENSOR.toml")]
    pub(crate) sensor: Option<PathBuf>,
    /// Write what was kept, for `taceva merge`
    #[arg(long, value_name = "STATE")]
    pub(crate) state_out: Option<PathBuf>,
    /// Write a page to look at, to print and to send: one file that needs no network
    #[arg(long, value_name = "FILE.html")]
    pub(crate) html: Option<PathBuf>,
    /// Write every figure into this folder, as SVG and PDF
    #[arg(long, value_name = "FOLDER")]
    pub(crate) figures: Option<PathBuf>,
    /// Write truth and prediction of every sample as CSV, for `taceva compare`
    #[arg(long, value_name = "SAMPLES.csv")]
    pub(crate) samples_out: Option<PathBuf>,
    /// Count NaN and infinite cells as n_invalid instead of refusing the file
    #[arg(long)]
    pub(crate) allow_invalid: bool,
    /// Say what would be read and computed, and stop
    #[arg(long)]
    pub(crate) explain: bool,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// States are what `evaluate` and `score` write with --state-out. They must be of the same metrics, channels and settings.
#[derive(Debug, Args)]
pub(crate) struct Merge {
    /// The states to join
    #[arg(required = true, value_name = "STATE")]
    pub(crate) states: Vec<PathBuf>,
    /// Write the joined state, to be joined again
    #[arg(long, value_name = "STATE")]
    pub(crate) state_out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn evaluate_needs_a_model_or_a_name_but_not_both() {
        let parse = |words: &str| Cli::try_parse_from(words.split(' '));
        assert!(parse("taceva evaluate d").is_err());
        assert!(parse("taceva evaluate d --model ridge").is_ok());
        assert!(parse("taceva evaluate d --with m").is_ok());
        assert!(parse("taceva evaluate d --with m --model ridge").is_err());
    }
}

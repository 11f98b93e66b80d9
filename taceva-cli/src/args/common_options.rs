//! Options that several commands share, each described once.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::FigureArgs;

/// Help for names of models, for both options that accept a model.
const MODEL_HELP: &str = "\
The model to fit. Begin with ridge, which takes seconds, or fast, a small network for pictures. All: \
baseline, ridge, pls, elastic-net, kernel-ridge, gaussian-process, knn, lda, random-forest, \
gradient-boosting, cnn, resnet10, resnet18, resnet34, cnn-ensemble; fast: cnn with size=up-to-80x60 epochs=170 color=auto difference=in-color appearance=auto; \
default: cnn with size=up-to-128x96 color=auto difference=in-color appearance=auto; \
best: cnn-ensemble with size=up-to-128x96 color=auto difference=in-color appearance=auto, the mean of two cnn; \
auto: tries models on held-out samples while the expected gain is worth the time, for at most budget_s=1800, and keeps one; of a library: \
linfa/linear, linfa/pls, linfa/elastic-net, linfa/svr, linfa/logistic, smartcore/ridge, smartcore/lasso, smartcore/svr, \
smartcore/knn, smartcore/knn-classifier, smartcore/random-forest, smartcore/extra-trees, smartcore/gradient-boosting, which can be stopped only between two \
fits of the library; or of a plugin, ID/KEY";

/// A model to fit, and its settings.
#[derive(Debug, Args)]
pub(crate) struct ModelArgs {
    #[arg(long = "model", value_name = "NAME", help = MODEL_HELP)]
    pub(crate) name: String,
    #[command(flatten)]
    pub(crate) settings: SettingArgs,
}

/// Model to fit, and its settings, for a command that also accepts a fitted model.
#[derive(Debug, Args)]
pub(crate) struct OptionalModelArgs {
    #[arg(long = "model", value_name = "NAME", help = MODEL_HELP)]
    pub(crate) name: Option<String>,
    #[command(flatten)]
    pub(crate) settings: SettingArgs,
}

#[derive(Debug, Args)]
pub(crate) struct SettingArgs {
    /// A setting of the features or of the model, such as size=32x32, color=gray, difference=true or strength=0.1. features= accepts
    /// pixels, markers, gradients, statistics, or several joined by +. input=signals is for a recording that also has frames, and device=wgpu
    /// for networks in a program built for GPUs; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// Channels to predict, separated by commas; main tables then have a row for each channel, instead of rows for planes [default: all]
    #[arg(long, value_name = "CHANNELS", value_delimiter = ',')]
    pub(crate) channels: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct ViewArgs {
    /// The view, such as left, of recordings whose samples have several pictures; left+right joins two views side by side [default: the only
    /// picture, or the view that a fitted model was fitted on]
    #[arg(id = "view", long = "view", value_name = "VIEW")]
    pub(crate) name: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct SplitArgs {
    /// The division of samples: random, chronological, by-point, by-block, declared or by-column:NAME[=train:1,2;val:3;test:4]. Shares of training,
    /// validation and test follow a space: 'chronological 80/0/20' tests the last fifth of the samples in order of time. all trains on every sample,
    /// for a final model. cv:K and loo predict each sample once. The kind of their groups follows a space: 'cv:5 by-point', or random, by-block or
    /// by-column:NAME. Several recordings also accept by-recording[=train:A,B;test:C]. leave-one-recording-out fits a model without each recording
    /// in turn [default: by-point if points repeat, else by groups or blocks of time if neighbours resemble each other, else random. With 5 to 999
    /// groups `evaluate` uses cv:5 by these groups]
    #[arg(long, value_name = "SPLIT")]
    pub(crate) split: Option<String>,
    #[command(flatten)]
    pub(crate) seed: SeedArgs,
}

#[derive(Debug, Args)]
pub(crate) struct SeedArgs {
    /// The seed of all random numbers
    #[arg(id = "seed", long, value_name = "N", default_value_t = 0)]
    pub(crate) value: u64,
}

#[derive(Debug, Args)]
pub(crate) struct SplitOutArgs {
    /// Write the ids of the training, validation and test samples as JSON; with folds, also the ids of the test samples of each fold
    #[arg(id = "split_out", long = "split-out", value_name = "SPLIT.json")]
    pub(crate) path: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct PartArgs {
    /// The part of the dataset [default: test, or all if the model was fitted on another dataset; folds score every sample]
    #[arg(id = "part", long, value_enum)]
    pub(crate) name: Option<PartArg>,
}

#[derive(Debug, Args)]
pub(crate) struct CacheArgs {
    /// The folder for results of earlier commands: features of frames, and simulated recordings, models and predictions of runs [default:
    /// taceva in the user's cache folder]
    #[arg(long, value_name = "DIR", conflicts_with = "no_cache")]
    pub(crate) cache: Option<PathBuf>,
    /// Compute everything again, and store nothing
    #[arg(long)]
    pub(crate) no_cache: bool,
}

/// Options of scoring, and of the files beside the scores.
#[derive(Debug, Args)]
pub(crate) struct ScoringArgs {
    /// Metrics, separated by commas: ids, or the groups accuracy and all
    #[arg(
        long,
        value_name = "METRICS",
        value_delimiter = ',',
        default_value = "all"
    )]
    pub(crate) metrics: Vec<String>,
    /// Treat each sample as independent of the others: intervals are then over samples instead of contact points.
    /// `evaluate` refuses this option if neighbouring samples resemble each other
    #[arg(long)]
    pub(crate) independent: bool,
    /// Facts about the sensor: footprint, greatest depth, opacity; metrics that need a missing fact are skipped
    #[arg(long, value_name = "SENSOR.toml")]
    pub(crate) sensor: Option<PathBuf>,
    /// Write the sums behind the scores, for `taceva merge`
    #[arg(long, value_name = "STATE")]
    pub(crate) state_out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) page: PageArgs,
    /// Write every figure into this folder, as SVG and PDF
    #[arg(long, value_name = "FOLDER")]
    pub(crate) figures: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) figure: FigureArgs,
    /// Write truth and prediction of every sample as CSV, with its group and fold, for `taceva compare`
    #[arg(long, value_name = "SAMPLES.csv")]
    pub(crate) samples_out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) explain: ExplainArgs,
}

#[derive(Debug, Args)]
pub(crate) struct PageArgs {
    /// Write the result as a page: one HTML file that needs no network
    #[arg(id = "html", long, value_name = "FILE.html")]
    pub(crate) path: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct ExplainArgs {
    /// Print what the command would do, and stop
    #[arg(id = "explain", long)]
    pub(crate) is_wanted: bool,
}

/// Format and path of a result; `F` lists the formats.
#[derive(Debug, Args)]
pub(crate) struct Output<F: ValueEnum + Default + Send + Sync + 'static = Format> {
    /// The format of the result
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: F,
    /// Write the result to a file instead of standard output
    #[arg(long = "out", value_name = "PATH")]
    pub(crate) path: Option<PathBuf>,
    /// Replace files that exist already
    #[arg(long)]
    pub(crate) force: bool,
}

/// The format of a table of results.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Text for people
    #[default]
    Text,
    /// JSON for programs, with the name of its schema in the key `schema`
    Json,
    /// One row for each score or finding
    Csv,
    /// A Markdown table
    #[value(alias = "markdown")]
    Md,
    /// A LaTeX table (booktabs)
    #[value(alias = "latex")]
    Tex,
}

/// The scores in the table of a result.
#[derive(Debug, Args)]
pub(crate) struct TableArgs {
    /// The scores in the table: main (MAE, R² and sMAPE, in LaTeX as wide as a column of a paper) or all [default: main with --format tex, else all]
    #[arg(id = "table", long, value_enum, value_name = "SCORES")]
    pub(crate) scores: Option<TableScores>,
}

/// The scores that a table holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableScores {
    /// MAE, R² and sMAPE
    Main,
    /// Every score and variant
    All,
}

impl TableScores {
    /// Default scores of a table: main scores for LaTeX, otherwise all.
    pub(crate) fn usual(format: Format) -> TableScores {
        match format {
            Format::Tex => TableScores::Main,
            _ => TableScores::All,
        }
    }
}

/// The format of a list or a plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ListFormat {
    /// Text for people
    #[default]
    Text,
    /// JSON for programs, with the name of its schema in the key `schema`
    Json,
}

/// The part of a dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PartArg {
    /// Samples that the model was fitted on
    Train,
    /// Samples on which the settings of the model were chosen
    Validation,
    /// Unseen samples
    Test,
    /// Every sample
    All,
}

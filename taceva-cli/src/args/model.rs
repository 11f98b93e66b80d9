//! Arguments of the commands that fit and use models.

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use taceva_evaluate::{RowKey, Shard};
use taceva_models::Checkpoints;

use super::{
    CacheArgs, ModelArgs, OptionalModelArgs, Output, PartArgs, ScoringArgs, SplitArgs,
    SplitOutArgs, TableArgs, TaskArgs, ViewArgs, WindowArgs,
};

/// Fit a model on the training part of a dataset and write it to a file
///
/// The file holds the model, its split and the digest of the dataset. `taceva evaluate DATASET --with MODEL` scores the samples that the model has
/// not seen, and `taceva predict` predicts. With --split all or cv:5 the model is fitted on every sample, so only another recording can test it.
/// cv:5 also stores the scores of its folds.
///
/// During the training of a network, a checkpoint is written to the file MODEL.checkpoint every 30 s, and when the training is
/// stopped. The same command resumes from the checkpoint, writes the same bytes as an uninterrupted training, and removes the checkpoint.
#[derive(Debug, Args)]
pub(crate) struct Fit {
    /// The dataset to train on; several recordings of one kind of sensor are joined
    #[arg(required = true, value_name = "DATASET")]
    pub(crate) datasets: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
    /// Fit a classifier to a task of the dataset instead of a model of channels: lda, linfa/logistic, smartcore/knn-classifier, cnn, resnet10,
    /// resnet18, resnet34, or auto. auto takes the best of the first three on the validation part. The split keeps clusters whole
    #[arg(long, value_name = "NAME")]
    pub(crate) task: Option<String>,
    #[command(flatten)]
    pub(crate) window: WindowArgs,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    /// The model file to write
    #[arg(long, value_name = "MODEL")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) split_out: SplitOutArgs,
    /// Seconds between two checkpoints of a training run, 0 for a checkpoint after each step
    #[arg(long, value_name = "SECONDS", default_value_t = Checkpoints::EVERY.as_secs())]
    pub(crate) checkpoint_every: u64,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    /// Replace a file that exists already, and the checkpoint of another training run
    #[arg(long)]
    pub(crate) force: bool,
}

/// Fit a model, or use a fitted one, and score it on unseen samples
///
/// Without --split, 5 to 999 groups of samples, such as contact points, are scored in five folds (cv:5). Each sample is predicted once, by a model
/// that has not seen its group. Otherwise the model is fitted on the training part, its settings are chosen on the validation part, and the test
/// part is scored. The default model is `fast`, a small network, or `ridge` for signals of taxels. With --with, a fitted model is used: on its own
/// dataset only the unseen part is scored.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("which").args(["with", "name"]))]
pub(crate) struct Evaluate {
    /// The dataset to evaluate; several recordings of one kind of sensor are joined
    #[arg(required = true, value_name = "DATASET")]
    pub(crate) datasets: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
    /// A fitted model file
    #[arg(long, value_name = "MODEL")]
    pub(crate) with: Option<PathBuf>,
    /// Fit a classifier to a task of the dataset instead of a model of channels: lda [default], linfa/logistic, smartcore/knn-classifier, cnn,
    /// resnet10, resnet18, resnet34, or auto, which takes the best of the first three on the validation part. For poses and depth maps, fit any model
    /// that predicts numbers. The split keeps clusters whole [default: cv:5 by the cluster of the task]
    #[arg(
        long,
        value_name = "NAME",
        conflicts_with_all = ["with", "metrics", "independent", "sensor", "figures", "samples_out", "table", "part", "split_out", "explain"]
    )]
    pub(crate) task: Option<String>,
    #[command(flatten)]
    pub(crate) window: WindowArgs,
    #[command(flatten)]
    pub(crate) model: OptionalModelArgs,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    #[command(flatten)]
    pub(crate) split_out: SplitOutArgs,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    #[command(flatten)]
    pub(crate) part: PartArgs,
    #[command(flatten)]
    pub(crate) scoring: ScoringArgs,
    #[command(flatten)]
    pub(crate) table: TableArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}

#[derive(Debug, Args)]
pub(crate) struct Predict {
    /// The dataset to predict; several recordings of one kind of sensor are joined
    #[arg(required = true, value_name = "DATASET")]
    pub(crate) datasets: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
    /// A fitted model file
    #[arg(long, value_name = "MODEL")]
    pub(crate) with: PathBuf,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    #[command(flatten)]
    pub(crate) part: PartArgs,
    /// The table of predictions to write; `score --pred` reads it. Its column `distance` holds the distance of each picture from the training
    /// pictures
    #[arg(long, value_name = "PRED.csv")]
    pub(crate) out: PathBuf,
    /// Write predictions without clamping them to the bounds of the model; robustness is computed from these
    #[arg(long)]
    pub(crate) unbounded: bool,
    /// Also write the standard deviation of each prediction, for a model that estimates it: gaussian-process
    #[arg(long, value_name = "DEVIATIONS.csv")]
    pub(crate) deviations_out: Option<PathBuf>,
    /// Also write the truth of the same samples; `score --truth` reads it
    #[arg(long, value_name = "TRUTH.csv")]
    pub(crate) truth_out: Option<PathBuf>,
    /// Replace files that exist already
    #[arg(long)]
    pub(crate) force: bool,
}

/// Score the predictions of another program: no pictures, no model
///
/// Both tables have a header with channel names. Rows are paired by `sample`, `id`, `sample_id` or `index` if both tables have it, else by
/// order. Rows that disagree in another key, in `t_s`, `point_id` or `frame_sha256` are rejected.
#[derive(Debug, Args)]
pub(crate) struct Score {
    /// The truth: a table, CSV or Parquet, with columns Px,Py,Pz (mm), Fx,Fy,Fz (N) or others; `id` pairs its rows, and `point_id` is the
    /// contact point of each press, without which no score has an interval
    #[arg(long, value_name = "TRUTH.csv")]
    pub(crate) truth: PathBuf,
    /// The predictions: a table with the same channels
    #[arg(long, value_name = "PRED.csv")]
    pub(crate) pred: PathBuf,
    /// Units of channels other than Px, Py, Pz, Fx, Fy and Fz, as NAME=UNIT, separated by commas [default: 1]
    #[arg(long, value_name = "NAME=UNIT", value_delimiter = ',')]
    pub(crate) units: Vec<String>,
    /// Periods of angles in the unit of the column, as NAME=360 or NAME=2pi, separated by commas: values that differ by a period are equal
    #[arg(long, value_name = "NAME=PERIOD", value_delimiter = ',')]
    pub(crate) periods: Vec<String>,
    /// Pair rows by this column of both tables, or by `order` [default: by sample, id, sample_id or index of both tables, else by order]
    #[arg(long, value_name = "NAME")]
    pub(crate) key: Option<RowKey>,
    /// Count NaN and infinite cells as n_invalid instead of rejecting the file (with --task, count their rows and leave them out)
    #[arg(long)]
    pub(crate) allow_invalid: bool,
    /// Score only shard K of N: one of N ranges of consecutive rows, or with --task of clusters in the order of names. `taceva merge` merges the
    /// states of --state-out to the scores of all rows
    #[arg(long, value_name = "K/N", conflicts_with_all = ["samples_out", "html", "figures"])]
    pub(crate) shard: Option<Shard>,
    #[command(flatten)]
    pub(crate) task: TaskArgs,
    #[command(flatten)]
    pub(crate) scoring: ScoringArgs,
    #[command(flatten)]
    pub(crate) table: TableArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Merge the states of shards; the scores equal those of one unsharded run, bit for bit
///
/// States are written by `evaluate` and `score` with --state-out, of channels or of tasks. They must have the same metrics, channels and settings, or
/// the same tasks with the same classes, rules and cluster column.
#[derive(Debug, Args)]
pub(crate) struct Merge {
    /// The states to merge
    #[arg(required = true, value_name = "STATE")]
    pub(crate) states: Vec<PathBuf>,
    /// Write the merged state, which can be merged again
    #[arg(long, value_name = "STATE")]
    pub(crate) state_out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) table: TableArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}

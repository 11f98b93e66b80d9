//! What several commands have in common: models, splits and the form of results.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// A model to fit, and its settings.
#[derive(Debug, Args)]
pub(crate) struct ModelArgs {
    /// The model: baseline, ridge, pls, elastic-net, kernel-ridge, svr, gaussian-process, knn, lda, random-forest,
    /// gradient-boosting, cnn, resnet10, resnet18, resnet34; auto: the one that does best on groups left out; one of a library:
    /// linfa/linear, linfa/pls, linfa/elastic-net, linfa/svr, linfa/logistic, smartcore/ridge, smartcore/lasso, smartcore/svr,
    /// smartcore/knn, smartcore/random-forest, smartcore/extra-trees, smartcore/gradient-boosting, which stop between two of the
    /// library's fits only; or that of a plugin, ID/KEY
    #[arg(long = "model", value_name = "NAME")]
    pub(crate) name: String,
    #[command(flatten)]
    pub(crate) settings: SettingArgs,
}

/// As [`ModelArgs`], where a fitted model may stand instead.
#[derive(Debug, Args)]
pub(crate) struct OptionalModelArgs {
    /// The model to fit: baseline, ridge, pls, elastic-net, kernel-ridge, svr, gaussian-process, knn, lda, random-forest,
    /// gradient-boosting, cnn, resnet10, resnet18, resnet34; auto: the one that does best on groups left out; one of a library:
    /// linfa/linear, linfa/pls, linfa/elastic-net, linfa/svr, linfa/logistic, smartcore/ridge, smartcore/lasso, smartcore/svr,
    /// smartcore/knn, smartcore/random-forest, smartcore/extra-trees, smartcore/gradient-boosting, which stop between two of the
    /// library's fits only; or that of a plugin, ID/KEY
    #[arg(long = "model", value_name = "NAME")]
    pub(crate) name: Option<String>,
    #[command(flatten)]
    pub(crate) settings: SettingArgs,
}

#[derive(Debug, Args)]
pub(crate) struct SettingArgs {
    /// A setting of the features or of the model, such as features=markers (pixels, markers, gradients, statistics, or several joined by +),
    /// size=32x32, color=gray, difference=true, strength=0.1, and device=wgpu for networks in a program built for GPUs; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// Channels to predict, separated by commas [default: all]
    #[arg(long, value_name = "CHANNELS", value_delimiter = ',')]
    pub(crate) channels: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct SplitArgs {
    /// How samples are divided: random, chronological, by-point, declared,
    /// by-column:NAME[=train:1,2;val:3;test:4], or all: every sample is learnt from, for a final model [default: by-point where points have repeats, else random]
    #[arg(long, value_name = "SPLIT")]
    pub(crate) split: Option<String>,
    /// The seed of everything that is drawn
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
}

#[derive(Debug, Args)]
pub(crate) struct CacheArgs {
    /// Where what was made before is found and kept: features of frames, and of a run its simulated recordings, models and predictions
    /// [default: taceva in the user's cache folder]
    #[arg(long, value_name = "DIR", conflicts_with = "no_cache")]
    pub(crate) cache: Option<PathBuf>,
    /// Make everything anew, and keep nothing
    #[arg(long)]
    pub(crate) no_cache: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Output {
    /// The form of the result
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
    /// Write the result to a file instead of standard output
    #[arg(long = "out", value_name = "PATH")]
    pub(crate) path: Option<PathBuf>,
    /// Replace a file that stands there already
    #[arg(long)]
    pub(crate) force: bool,
}

/// The form of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people
    Text,
    /// For programs; the key `schema` says which form it has
    Json,
    /// One row a score or finding
    Csv,
    /// A Markdown table
    Md,
    /// A LaTeX table (booktabs)
    Tex,
}

/// The part of a dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PartArg {
    /// What the model was fitted on
    Train,
    /// What its settings were chosen on
    Validation,
    /// What it has not seen
    Test,
    /// Every sample
    All,
}

//! Arguments of `taceva bundle`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use taceva_bundle::{Author, Level, MOST_BYTES, Organization, Redaction};

use super::{ListFormat, Output, PageArgs};

/// Pack results with the files that compute them again; verify and compare such bundles
///
/// A bundle holds results, the states and tables from which they were computed, and texts for readers; `taceva bundle verify` computes the
/// numbers again. States come from `--state-out`. Tables are the inputs of `score`, or the samples in the folder of a result (`--samples-out
/// NAME.samples.csv`), found by their digest. A seal is a digest, not a signature: it shows damage and careless edits, not fraud.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct Bundle {
    #[command(subcommand)]
    pub(crate) subject: Option<BundleSubject>,
    #[command(flatten)]
    pub(crate) make: BundleMake,
}

/// Operation on bundles.
#[derive(Debug, Subcommand)]
pub(crate) enum BundleSubject {
    /// Compute the numbers of a bundle again, at the deepest level that its files allow; exit code 1 if a claim differs, 3 if the bundle is damaged
    Verify(BundleVerify),
    /// Print the claims and definitions that differ between two bundles, and whether both have the same samples; verifies neither bundle
    Diff(BundleDiff),
}

#[derive(Debug, Args)]
pub(crate) struct BundleMake {
    /// The folder of a run, or the JSON of evaluate, score or merge
    #[arg(required = true, value_name = "RUN|RESULT.json")]
    pub(crate) result: Option<PathBuf>,
    /// The bundle to write: one file if the name ends in .tar.gz, else a folder
    #[arg(long, required = true, value_name = "BUNDLE[.tar.gz]")]
    pub(crate) out: Option<PathBuf>,
    /// A state of the result, as --state-out writes it; may be repeated
    #[arg(long = "state", value_name = "STATE")]
    pub(crate) states: Vec<PathBuf>,
    /// The table of the truth that was scored
    #[arg(long, value_name = "TABLE", requires = "prediction")]
    pub(crate) truth: Option<PathBuf>,
    /// The table of predictions that was scored
    #[arg(long = "pred", value_name = "TABLE", requires = "truth")]
    pub(crate) prediction: Option<PathBuf>,
    /// The `--key` with which `taceva score` paired the rows of both tables
    #[arg(long, value_name = "NAME|order", requires = "truth")]
    pub(crate) key: Option<String>,
    /// An evaluated recording, to add its dataset.toml, and its pictures by --with frames; not needed for a run; may be repeated
    #[arg(long = "dataset", value_name = "DATASET")]
    pub(crate) datasets: Vec<PathBuf>,
    /// A text file to add to the bundle: scene.toml, rig.toml, map.toml, limits.toml or tasks.toml. The scene of a run is added without it; may be
    /// repeated
    #[arg(long = "text", value_name = "FILE")]
    pub(crate) texts: Vec<PathBuf>,
    /// A model file of the result, as fit writes it; implies --with model; may be repeated
    #[arg(long = "model", value_name = "FILE")]
    pub(crate) models: Vec<PathBuf>,
    /// Add files that are left out by default, separated by commas; models and pictures of a run come from its folder
    #[arg(long, value_enum, value_name = "PART", value_delimiter = ',')]
    pub(crate) with: Vec<WithPart>,
    /// Leave files out, and state their digests: the bundle is then verified at the deepest level that the other files allow
    #[arg(long, value_enum, value_name = "PART")]
    pub(crate) without: Option<WithoutPart>,
    /// Redact texts: addresses of machines, serial numbers, absolute paths, separated by commas. Sealed files stay as they are
    #[arg(long, value_name = "hosts,serials,paths", value_delimiter = ',')]
    pub(crate) redact: Vec<Redaction>,
    /// The name of the bundle [default: the sensors of the results]
    #[arg(long, value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// An author, with an ORCID if there is one; may be repeated
    #[arg(long = "author", value_name = "NAME <ORCID>")]
    pub(crate) authors: Vec<Author>,
    /// The organization of the authors, which publishes the bundle
    #[arg(long, value_name = "NAME <URL>")]
    pub(crate) organization: Option<Organization>,
    /// The licence, as an SPDX identifier such as CC-BY-4.0
    #[arg(long, value_name = "SPDX", value_parser = licence)]
    pub(crate) licence: Option<String>,
    /// Make a draft without author or licence
    #[arg(long)]
    pub(crate) draft: bool,
    /// The day on which the bundle is made, such as 2026-11-28 [default: today]
    #[arg(long, value_name = "DATE", value_parser = date)]
    pub(crate) date: Option<String>,
    /// Replace a bundle that exists already
    #[arg(long)]
    pub(crate) force: bool,
}

/// Files that are added on request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum WithPart {
    /// Model files, so that the predictions can be computed again
    Model,
    /// The pictures whose predictions are claimed, so that the model predicts them again without --dataset: at most 3840 files and 2 GiB, with every
    /// label of their recording
    Frames,
}

/// Files that can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum WithoutPart {
    /// The tables of truth, of predictions and of samples
    Predictions,
}

#[derive(Debug, Args)]
pub(crate) struct BundleVerify {
    /// The bundle: a folder, or a .tar.gz
    pub(crate) bundle: PathBuf,
    /// The level to reach; the exit code is 1 if a claim does not reach it [default: the deepest that the files allow]
    #[arg(long, value_enum, value_name = "LEVEL")]
    pub(crate) level: Option<LevelArg>,
    /// An evaluated recording, which the model of the bundle predicts again; for the level fit, and for the level model if the bundle has no
    /// pictures; may be repeated
    #[arg(long = "dataset", value_name = "DATASET")]
    pub(crate) datasets: Vec<PathBuf>,
    /// The greatest difference between a claim and its recomputed number for the verdict `within`, in the unit of each score
    #[arg(long, value_name = "NUMBER", default_value_t = 0.0, value_parser = tolerance)]
    pub(crate) tolerance: f64,
    /// The maximum size of all files together, in bytes
    #[arg(long, value_name = "BYTES", default_value_t = MOST_BYTES)]
    pub(crate) most: u64,
    #[command(flatten)]
    pub(crate) page: PageArgs,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}

#[derive(Debug, Args)]
pub(crate) struct BundleDiff {
    /// One bundle
    pub(crate) one: PathBuf,
    /// The other bundle
    pub(crate) other: PathBuf,
    #[command(flatten)]
    pub(crate) output: Output<ListFormat>,
}

/// Level of a verification.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LevelArg {
    /// Files are equal to the files that bundle.json lists, byte for byte
    Files,
    /// Schemas, seals and generated files are valid, and the results contain the claims
    Form,
    /// States reproduce the scores
    Scores,
    /// Tables reproduce the states and the scores
    Predictions,
    /// The model reproduces the predictions on the recording that --dataset names
    Model,
    /// A fit with the settings of the model card reproduces the model, or gives scores within the intervals of the claims; takes as long as that fit
    Fit,
}

impl From<LevelArg> for Level {
    fn from(level: LevelArg) -> Level {
        match level {
            LevelArg::Files => Level::Files,
            LevelArg::Form => Level::Form,
            LevelArg::Scores => Level::Scores,
            LevelArg::Predictions => Level::Predictions,
            LevelArg::Model => Level::Model,
            LevelArg::Fit => Level::Fit,
        }
    }
}

fn licence(text: &str) -> Result<String, String> {
    match taceva_bundle::is_licence(text) {
        true => Ok(text.to_owned()),
        false => Err(taceva_bundle::expected_licence(text)),
    }
}

fn date(text: &str) -> Result<String, String> {
    crate::date::read(text).ok_or_else(|| "expected a date, such as 2026-11-28".to_owned())
}

fn tolerance(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    let number = number.filter(|number| *number >= 0.0);
    number.ok_or_else(|| "expected a number from 0".to_owned())
}

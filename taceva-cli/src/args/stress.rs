//! Arguments of `taceva stress`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use taceva_stress::{FAULTS, Fault, RECORDING_FAULTS, TAXEL_FAULTS, TIME_FAULTS};

use super::{ExplainArgs, Output, PageArgs, SeedArgs, ViewArgs};

/// Score a fitted model on pictures or signals with faults: blur, dead pixels, lost light, wear, dust, dead taxels
///
/// Faults are applied to the pictures or signals of the recording, and the model predicts them without being fitted again. Severities 1 to 5
/// change the untouched picture by 0.03, 0.1, 0.3, 1 and 3 times the change by contact, a mean over pictures. If the model reads an untouched
/// picture, a fault that is equal in all pictures has a second score, for an untouched picture with the fault. A fitted model is scored on samples
/// that it has not seen.
#[derive(Debug, Args)]
#[command(after_help = faults_help())]
pub(crate) struct Stress {
    /// The recording whose samples are predicted
    #[arg(value_name = "DATASET")]
    pub(crate) dataset: PathBuf,
    /// A fitted model file
    #[arg(long, value_name = "MODEL")]
    pub(crate) model: PathBuf,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
    /// Faults, separated by commas: gel-12 or all for pictures, recording-5 for files, markers, clocks and labels, taxel-3 for taxels, time-1 for
    /// times, ORG/NAME for a fault of a plugin [default: gel-12, or taxel-3 if the model reads signals]
    #[arg(long, value_name = "FAULTS", value_delimiter = ',')]
    pub(crate) faults: Vec<String>,
    /// A second fitted model: also prints the error that each fault adds, as a ratio to and a difference from the error that it adds to the
    /// second model
    #[arg(long, value_name = "MODEL")]
    pub(crate) reference: Option<PathBuf>,
    /// Severities, such as 3, 1,3,5 or 1-5
    #[arg(long, value_name = "SEVERITIES", default_value = "1-5")]
    pub(crate) severity: String,
    /// The quantity that severities set
    #[arg(long, value_enum, default_value_t)]
    pub(crate) by: StressBy,
    #[command(flatten)]
    pub(crate) seed: SeedArgs,
    /// Number of random draws of the places of dead pixels, scratches, tears, dust and taxels; scores are means over the draws
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100))]
    pub(crate) draws: u32,
    /// The samples on which the model is scored [default: test, or all if the model was fitted on another recording]
    #[arg(long, value_enum)]
    pub(crate) part: Option<StressPart>,
    /// Metrics of each fault and severity in addition to mae and skill, separated by commas: rmse, bias, r2, smape, smape_gated, mae_euclid
    #[arg(long, value_name = "METRICS", value_delimiter = ',')]
    pub(crate) metrics: Vec<String>,
    /// Skip the severities of a fault above the first at which no channel has skill; the pictures are then decoded once for each severity
    #[arg(long)]
    pub(crate) stop_at_no_skill: bool,
    #[command(flatten)]
    pub(crate) explain: ExplainArgs,
    /// An SVG file: the growth of each error by fault and severity
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) svg: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) page: PageArgs,
    /// A new folder: the picture of the greatest load with each fault and severity, as PNG, with digests
    #[arg(long, value_name = "DIR")]
    pub(crate) keep_frames: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Names of the faults, each with its appearance.
fn faults_help() -> String {
    let lines = |faults: &[&Fault]| -> String {
        let lines = faults.iter();
        lines
            .map(|fault| format!("\n  {:<15}{}", fault.id, fault.title))
            .collect()
    };
    format!(
        "Faults of gel-12:{}\n\nFaults of recording-5:{}\n\nFaults of taxel-3:{}\n\nFaults of time-1:{}",
        lines(&FAULTS),
        lines(&RECORDING_FAULTS),
        lines(&TAXEL_FAULTS),
        lines(&TIME_FAULTS)
    )
}

/// Samples that the model has not seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum StressPart {
    /// Unseen samples of the recording that the model was fitted on
    Test,
    /// Every sample of another recording
    All,
}

/// Quantity that severities set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum StressBy {
    /// The change that a fault makes in the picture without contact, relative to the change by contact
    #[default]
    Stimulus,
    /// The parameter of the fault, from a fixed table of parameters
    Parameter,
}

//! Arguments of `taceva wear`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Output, ViewArgs};

/// Compare the errors of a fitted model over the life of a gel: recordings of one unit, by presses or by date
///
/// Recordings of one unit are ordered by the presses on their gel, or by date. The model predicts each of them without being fitted again. For each
/// gel the table has the error of each recording, and the change of its untouched picture. Notes state the growth of each error and where a limit is
/// met. They name the earliest recording whose error is shown to differ from the error of the first recording.
///
/// The presses are `presses_since_gel` in [sensor] of a map or of dataset.toml; `taceva reseal` accepts the edit.
#[derive(Debug, Args)]
pub(crate) struct Wear {
    /// Two or more recordings of one unit, in any order
    #[arg(value_name = "DATASET", required = true)]
    pub(crate) datasets: Vec<PathBuf>,
    /// A fitted model file
    #[arg(long, value_name = "MODEL")]
    pub(crate) model: PathBuf,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
    /// The order of the recordings [default: presses if every recording states them, otherwise date]
    #[arg(long, value_enum)]
    pub(crate) by: Option<WearByArg>,
    /// The greatest mean absolute error of a channel, such as mae.Fz=0.1N; may be repeated
    #[arg(long, value_name = "mae.CHANNEL=AMOUNT")]
    pub(crate) limit: Vec<String>,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Order of recordings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum WearByArg {
    /// Presses on the gel before each recording
    Presses,
    /// Days from the first recording of the gel
    Date,
}

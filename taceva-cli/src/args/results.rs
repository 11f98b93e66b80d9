//! What is typed of results that are there already: compared, chosen from, held to limits; and of the catalogue.

use std::path::PathBuf;

use clap::{ArgGroup, Args, Subcommand};

use super::Output;

/// Results are JSON files of `evaluate` and `score`, folders of runs (or their results.json), or names of the catalogue. Where two of them
/// predict the same samples, mean absolute errors are compared sample by sample: the samples are looked for in `<name>.samples.csv` beside
/// `<name>.json` (`--samples-out` writes it) and in `reports/` of a run. All else is compared by Welch's test, with Holm's adjustment.
#[derive(Debug, Args)]
pub(crate) struct Compare {
    /// The results to compare
    #[arg(required = true, value_name = "RESULT", num_args = 1..)]
    pub(crate) results: Vec<PathBuf>,
    /// Metrics, separated by commas [default: all that are better on one side]
    #[arg(long, value_name = "METRICS", value_delimiter = ',')]
    pub(crate) metrics: Vec<String>,
    /// How far apart scores may be and still count as equal, such as mae.Fz=0.01; may be repeated
    #[arg(long = "margin", value_name = "METRIC[.CHANNEL]=NUMBER")]
    pub(crate) margins: Vec<String>,
    /// The seed of everything that is drawn
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Print every pair with both p values and its interval, and not only what decides; the other formats always have them
    #[arg(long)]
    pub(crate) all: bool,
    /// Write a page to look at, to print and to send: one file that needs no network
    #[arg(long, value_name = "FILE.html")]
    pub(crate) html: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Needs are words (shear, no shear, normal force, depth, deep contact, soft contact, firm contact, planar, fast, ambient light, …) and
/// numbers (rate >= 50 Hz, force <= 1 N, localisation 0.3 mm, …), separated by commas. Hard ones drop a sensor, soft ones rank.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("asked").required(true).args(["need", "needs"]))]
pub(crate) struct Choose {
    /// The needs; may be repeated
    #[arg(long, value_name = "NEEDS")]
    pub(crate) need: Vec<String>,
    /// A file with `needs = ["…", …]`
    #[arg(long, value_name = "NEEDS.toml")]
    pub(crate) needs: Option<PathBuf>,
    /// Choose among these results and not from the catalogue; may be repeated
    #[arg(long, value_name = "RESULT.json")]
    pub(crate) from: Vec<PathBuf>,
    /// Write a page to look at, to print and to send: one file that needs no network
    #[arg(long, value_name = "FILE.html")]
    pub(crate) html: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Limits as they are written in a file, one `[[limit]]` or more.
const LIMITS_HELP: &str = "\
Limits:
  name = \"line 3\"
  [[limit]]
  metric = \"mae\"            # or a variant, such as \"hysteresis.ratio\"
  channel = \"Fz\"
  unit = \"N\"
  most = 0.05               # or least; or both
  whole_interval = false    # true: the whole interval must keep to it, and not the value alone

A file to begin with, with what was measured beside each limit:
  taceva accept --template RESULT.json --out limits.toml";

/// Exit code 1 if a limit is not kept. A score that is missing or undefined keeps to none.
#[derive(Debug, Args)]
#[command(after_help = LIMITS_HELP)]
pub(crate) struct Accept {
    /// The result of one sensor: JSON of evaluate or score, or a report of a run
    #[arg(value_name = "RESULT.json", required_unless_present = "template")]
    pub(crate) result: Option<PathBuf>,
    /// The limits: `[[limit]]` with metric, channel, unit, and most or least
    #[arg(long, value_name = "LIMITS.toml", required_unless_present = "template")]
    pub(crate) limits: Option<PathBuf>,
    /// Write limits that this result keeps, to begin with: a fifth worse than measured, or the worse end of the interval
    #[arg(long, value_name = "RESULT.json", conflicts_with_all = ["result", "limits", "html", "date", "format"])]
    pub(crate) template: Option<PathBuf>,
    /// Write the data sheet: one page to look at, to print and to send
    #[arg(long, value_name = "FILE.html")]
    pub(crate) html: Option<PathBuf>,
    /// The date of the data sheet [default: today, in UTC]
    #[arg(long, value_name = "YYYY-MM-DD")]
    pub(crate) date: Option<String>,
    #[command(flatten)]
    pub(crate) output: Output,
}

#[derive(Debug, Args)]
pub(crate) struct CatalogueArgs {
    #[command(subcommand)]
    pub(crate) subject: CatalogueSubject,
}

/// What to do with the catalogue.
#[derive(Debug, Subcommand)]
pub(crate) enum CatalogueSubject {
    /// List every sensor
    List(Output),
    /// Show what was published of one sensor, each number with its source
    Show(CatalogueShow),
    /// Write the catalogue as pages: a list that filters and sorts, and a page a sensor
    Site(CatalogueSite),
}

#[derive(Debug, Args)]
pub(crate) struct CatalogueShow {
    /// The name of the sensor
    pub(crate) name: String,
    #[command(flatten)]
    pub(crate) output: Output,
}

#[derive(Debug, Args)]
pub(crate) struct CatalogueSite {
    /// The folder to write the pages into
    #[arg(long = "out", value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
    /// Results of this program to show apart from published ones; may be repeated
    #[arg(long, value_name = "RESULT.json")]
    pub(crate) with: Vec<PathBuf>,
    /// Replace pages that stand there already
    #[arg(long)]
    pub(crate) force: bool,
}

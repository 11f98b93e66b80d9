//! Arguments of `taceva budget`.

use std::path::PathBuf;

use clap::Args;
use taceva_core::Date;

use super::{Output, PageArgs};

/// Greatest number of draws that `--mc` accepts. All draws are stored in memory.
const MOST_DRAWS: u64 = 100_000_000;

/// An example of a file of sources.
const SOURCES_HELP: &str = "\
Sources:
  budget_version = 1
  measurand = \"Fz\"
  at = [\"0.5 N\"]            # one budget for each value
  coverage = 0.95
  [[source]]
  name = \"place to place\"
  from = \"error.between\"    # measured: also error.within, bias, repeatability, drift, r_light, certificate
  [[source]]
  name = \"unit to unit\"
  from = \"gauge.json#unit\"   # a component of a gauge study
  [[source]]
  name = \"lamp\"
  half_width = \"10 mN\"      # or u; U with k; s with dof; rows
  shape = \"rectangular\"

A file to start from, with every measured figure:
  taceva budget --template RESULT.json > budget.toml";

/// Combine measured and stated uncertainties into the uncertainty of a reading, and list effects without a source
///
/// The law of propagation combines the sources, and Monte Carlo draws check it. If the draws contradict the law, the interval of the draws is used.
/// Effects without a source are named. The exit code is 1 if an expanded uncertainty exceeds `--most-U`.
#[derive(Debug, Args)]
#[command(after_help = SOURCES_HELP)]
pub(crate) struct Budget {
    /// The file of sources: each `[[source]]` has a name, and an uncertainty or `from` with the name of a measured figure
    #[arg(value_name = "BUDGET.toml", required_unless_present = "template")]
    pub(crate) sources: Option<PathBuf>,
    /// The result of one sensor, for sources with `from`: JSON of evaluate or score, or a report of a run; the file of its samples is beside it
    #[arg(long, value_name = "RESULT")]
    pub(crate) results: Option<PathBuf>,
    /// A file with the certificate of the reference, instead of the certificate in the result: a table `[force.certificate]` or
    /// `[robot.certificate]`, as in a rig file
    #[arg(long, value_name = "CERTIFICATE.toml")]
    pub(crate) certificate: Option<PathBuf>,
    /// The day on which the certificate must be valid [default: the day of the recording, if the result states it]
    #[arg(long, value_name = "YYYY-MM-DD")]
    pub(crate) date: Option<Date>,
    /// The values of the measurand with their unit, separated by commas, such as 0.5N; only one with --format json [default: `at` of the file]
    #[arg(
        long,
        value_name = "VALUES",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub(crate) at: Vec<String>,
    /// The greatest number of Monte Carlo draws; drawing ends once two digits of the result are stable. 0: no draws
    #[arg(long = "mc", value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u64).range(..=MOST_DRAWS))]
    pub(crate) draws: u64,
    /// The seed of the draws
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// The greatest expanded uncertainty that is allowed, with its unit, such as 0.05N
    #[arg(long = "most-U", value_name = "U")]
    pub(crate) most: Option<String>,
    /// Write a file of sources with every figure that this result measures; other effects are listed as comments
    #[arg(long, value_name = "RESULT", conflicts_with_all = ["sources", "results", "at", "draws", "seed", "most", "html", "format"])]
    pub(crate) template: Option<PathBuf>,
    /// The channel of the template [default: Fz, or the first predicted channel]
    #[arg(long, value_name = "CHANNEL", requires = "template")]
    pub(crate) channel: Option<String>,
    #[command(flatten)]
    pub(crate) page: PageArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}

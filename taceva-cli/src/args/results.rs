//! Arguments of the commands that read results.

use std::path::PathBuf;

use clap::{ArgGroup, Args, ValueEnum};

use super::{FigureArgs, Format, Output, PageArgs, SeedArgs, TableArgs};

/// Compare sensors or models: which is better, by how much, and with what confidence
///
/// Text and Markdown show the values side by side, then the comparable results. Results are JSON files of `evaluate` and `score`, folders of
/// runs (or their results.json), or names of the catalogue. If two results predict the same samples, their mean absolute errors are compared
/// sample by sample. The samples are read from `<name>.samples.csv` beside `<name>.json` (`--samples-out` writes it) and from `reports/` of a
/// run. Other scores are compared by the intervals of both, with Holm's adjustment. Results of one dataset that were tested on different samples,
/// such as by another --seed or --split, are shown side by side and not ranked. Results of tasks are compared cluster by cluster, if they have the
/// same labels. Their states are read from the given state files, or from `NAME.state` beside `NAME.json`.
#[derive(Debug, Args)]
pub(crate) struct Compare {
    /// The results to compare; for a single run, the sensors of the run are compared
    #[arg(required = true, value_name = "RESULT", num_args = 1..)]
    pub(crate) results: Vec<PathBuf>,
    /// The folder of a catalogue, whose sensors can be named too; numbers of its bundles state the level of their verification
    #[arg(long, value_name = "DIR")]
    pub(crate) catalogue: Option<PathBuf>,
    /// Metrics, separated by commas: ids, or the groups accuracy and all [default: all for which less or more is better]
    #[arg(long, value_name = "METRICS", value_delimiter = ',')]
    pub(crate) metrics: Vec<String>,
    /// The channels and planes with a row in the tables, separated by commas, such as Fx,Fy,Fz [default: planes in place of their axes]
    #[arg(long, value_name = "CHANNELS", value_delimiter = ',')]
    pub(crate) channels: Vec<String>,
    /// The largest difference of scores that still counts as equal, such as mae.Fz=0.01; may be repeated
    #[arg(long = "margin", value_name = "METRIC[.CHANNEL]=NUMBER")]
    pub(crate) margins: Vec<String>,
    #[command(flatten)]
    pub(crate) seed: SeedArgs,
    /// Print every score and every pair with both p values and its interval, not only the main scores and pairs. Markdown, CSV and JSON have every
    /// pair in any case
    #[arg(long)]
    pub(crate) all: bool,
    #[command(flatten)]
    pub(crate) table: TableArgs,
    #[command(flatten)]
    pub(crate) page: PageArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Write the page, the figures and the tables of finished results again; nothing is acquired, fitted or scored
///
/// Results are the folder of a run, or the JSON of `run`, `evaluate` or `score`. The command writes `report.html`, every figure as SVG and PDF in
/// `figures/`, and the tables `scores.csv`, `scores.md`, `scores.tex` and `scores-main.tex`. Figures of samples need the samples beside the
/// results: `reports/` of a run, or `<name>.samples.csv` beside `<name>.json`.
#[derive(Debug, Args)]
pub(crate) struct ReportArgs {
    /// The results
    #[arg(value_name = "RESULT")]
    pub(crate) result: PathBuf,
    /// The folder to write into [default: the folder of the results]
    #[arg(long = "out", value_name = "FOLDER")]
    pub(crate) folder: Option<PathBuf>,
    /// The channels and planes to report, separated by commas, such as Fz [default: all]
    #[arg(long, value_name = "CHANNELS", value_delimiter = ',')]
    pub(crate) channels: Vec<String>,
    /// Also write the tables and figures in the form of a published study, with its numbers and the ratios to them, into `like-STUDY/`
    #[arg(long, value_enum, value_name = "STUDY")]
    pub(crate) like: Option<Like>,
    #[command(flatten)]
    pub(crate) figure: FigureArgs,
    #[command(flatten)]
    pub(crate) table: TableArgs,
    /// The format of the results on standard output
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
    /// Replace reports that exist already
    #[arg(long)]
    pub(crate) force: bool,
}

/// A published study in whose form results can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Like {
    /// Cong et al., TacEva, 2026: tables I to V and figures 3 to 8
    Taceva,
}

/// Find sensors for a task, with the numbers behind the ranking
///
/// Needs are words, such as shear or ambient light, and numbers, such as rate >= 50 Hz; all are listed below. Hard needs exclude a sensor, soft
/// needs rank the others. A sensor whose number is unknown is `open` instead of ranked. For each sensor without a rank, the reason names every need
/// that it does not meet and every unknown number.
#[derive(Debug, Args)]
#[command(after_help = needs_help(), group = ArgGroup::new("asked").required(true).args(["need", "needs"]))]
pub(crate) struct Choose {
    /// The needs; may be repeated
    #[arg(long, value_name = "NEEDS")]
    pub(crate) need: Vec<String>,
    /// A file with `needs = ["…", …]`
    #[arg(long, value_name = "NEEDS.toml")]
    pub(crate) needs: Option<PathBuf>,
    /// Choose among these results instead of the catalogue: the JSON of evaluate or score, or the folder of a run; may be repeated
    #[arg(long, value_name = "RESULT")]
    pub(crate) results: Vec<PathBuf>,
    /// The folder of a catalogue, whose measured numbers are included; each states the level of its verification, and numbers of different
    /// samples are not ranked
    #[arg(long, value_name = "DIR", conflicts_with = "results")]
    pub(crate) catalogue: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) page: PageArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Needs that `--need` accepts, as text for the help.
fn needs_help() -> String {
    format!(
        "Needs, separated by commas:\n{}\nA bound on the price names its currency, such as EUR; prices are not converted. \
         Other units are mN, cm, um and cm2.\n\
         A sensor whose number is unknown stays open. The exit code is 0 also if no sensor meets the needs.",
        taceva_report::Need::vocabulary()
    )
}

/// An example of a file of limits.
const LIMITS_HELP: &str = "\
Limits:
  limits_version = 2
  name = \"line 3\"
  [decision]
  rule = \"guarded\"          # simple, guarded, probability or shared
  r = 1.0                   # guarded: inside the limit by r times the expanded uncertainty
  [[limit]]
  metric = \"mae\"            # or a variant, such as \"hysteresis.ratio\"
  channel = \"Fz\"            # or the name of a task, with metric = \"f1\" and unit = \"1\"
  unit = \"N\"
  most = 0.05               # or least; or both

Rules, for the file or below one [[limit]]:
  simple       the value meets the limit; this is the rule if none is stated
  guarded      the value is inside the limit by r U, with U at `coverage` (0.95)
  probability  the probability of conformity is at least `p_conformity` (0.95)
  shared       the value meets the limit, and U is at most `most_uncertainty`
The verdict is pass, conditional pass, conditional fail, fail or, without an interval, undecided.
Limits of version 1 are read too: `whole_interval = true` compares the whole interval with the limit.

A file to start from, with the measured value beside each limit:
  taceva accept --template RESULT.json --out limits.toml";

/// Kind of conditional verdict that `--conditional` counts as met.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Conditional {
    /// Conditional pass: the value is within the limit, but the decision rule does not accept it
    Pass,
}

/// Test a result against limits, and write its data sheet
///
/// The exit code is 0 if every verdict is a pass, else 1. A missing or undefined score meets no limit.
#[derive(Debug, Args)]
#[command(after_help = LIMITS_HELP)]
pub(crate) struct Accept {
    /// The result of one sensor: JSON of evaluate or score, a report of a run, or a state of tasks
    #[arg(value_name = "RESULT.json", required_unless_present = "template")]
    pub(crate) result: Option<PathBuf>,
    /// The limits: `[[limit]]` with metric, channel, unit, and most or least
    #[arg(long, value_name = "LIMITS.toml", required_unless_present = "template")]
    pub(crate) limits: Option<PathBuf>,
    /// Write limits that this result meets, as a starting point: a fifth worse than measured, or the worse end of the interval
    #[arg(long, value_name = "RESULT.json", conflicts_with_all = ["result", "limits", "html", "date", "format", "conditional", "process"])]
    pub(crate) template: Option<PathBuf>,
    /// Write the data sheet: one HTML file that needs no network
    #[arg(long, value_name = "FILE.html")]
    pub(crate) html: Option<PathBuf>,
    /// Results of other units of the same make, five or more: print consumer's and producer's risk of each limit; may be repeated
    #[arg(long, value_name = "UNITS.json")]
    pub(crate) process: Vec<PathBuf>,
    /// Print the acceptance limit for this consumer's risk, such as 0.005: the share of units that are accepted and do not meet the limit
    #[arg(long, value_name = "SHARE", requires = "process")]
    pub(crate) target_risk: Option<f64>,
    /// Count a conditional pass as met: the value is within the limit, but its rule does not accept it
    #[arg(long, value_name = "VERDICT")]
    pub(crate) conditional: Option<Conditional>,
    /// The date of the data sheet [default: today, in UTC]
    #[arg(long, value_name = "YYYY-MM-DD")]
    pub(crate) date: Option<String>,
    #[command(flatten)]
    pub(crate) output: Output,
}

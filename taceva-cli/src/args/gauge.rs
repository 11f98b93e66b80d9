//! Arguments of `taceva gauge`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::Output;

/// Study a measuring system: shares of the variation of readings due to units, gels, days or persons
///
/// A part is a contact condition, and a trial is a repeat. An operator is the factor that differs between the measurements of a part: unit, gel,
/// day, person or laboratory. Every operator measures every part equally often, or with `--nested` its own parts. The table is CSV or Parquet:
/// `--samples-out` of `evaluate` writes one; to join the tables of several units, keep the header once. A column `source` with words such as
/// recorded or simulated, or the result `<name>.json` beside `<name>.samples.csv`, states the origin of the samples. Fewer than five operators
/// give wide intervals.
#[derive(Debug, Args)]
pub(crate) struct Gauge {
    /// The table of readings
    #[arg(value_name = "TABLE")]
    pub(crate) table: PathBuf,
    /// The columns whose cells name a part, separated by commas
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',', default_values = ["point_id", "depth_step"])]
    pub(crate) part: Vec<String>,
    /// The columns whose cells name an operator, separated by commas
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',', default_values = ["unit_id"])]
    pub(crate) by: Vec<String>,
    /// The columns whose cells name a trial, separated by commas
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',', default_values = ["repeat"])]
    pub(crate) trial: Vec<String>,
    /// Each part is measured by one operator; the same name under two operators means two parts
    #[arg(long)]
    pub(crate) nested: bool,
    /// The estimator of the variance components
    #[arg(long, value_enum, default_value_t)]
    pub(crate) method: GaugeMethod,
    /// The quantity that counts as a reading [default: error if the table has the truth, else prediction]
    #[arg(long, value_enum)]
    pub(crate) response: Option<GaugeResponse>,
    /// The width of the tolerance with its unit, such as 0.1N: adds the ratio of six standard deviations to the tolerance
    #[arg(long, value_name = "WIDTH")]
    pub(crate) tolerance: Option<String>,
    /// Pool the interaction of parts and operators with repeatability if its p value is above this number
    #[arg(long, value_name = "P", default_value_t = 0.25)]
    pub(crate) pool: f64,
    /// The channels to study, separated by commas, such as Fz; only one channel with --format json [default: all with a prediction, in the unit
    /// of the tolerance]
    #[arg(long, value_name = "CHANNELS", value_delimiter = ',')]
    pub(crate) channels: Vec<String>,
    /// Leave out parts with a missing or surplus reading, and count them, instead of refusing the table
    #[arg(long)]
    pub(crate) drop_incomplete: bool,
    #[command(flatten)]
    pub(crate) output: Output,
}

/// Estimator of the variance components.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum GaugeMethod {
    /// Analysis of variance
    #[default]
    Anova,
    /// Average and range
    Range,
}

/// Quantity of a channel that counts as a reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GaugeResponse {
    /// The predictions, or the column of the channel itself if the table has no predictions
    Prediction,
    /// Prediction minus truth
    Error,
}

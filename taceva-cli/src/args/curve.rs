//! Arguments of `taceva curve`.

use std::path::PathBuf;

use clap::Args;

use super::Output;

/// Fit a calibration curve; print its confidence and prediction bands, the reference value of a reading, and limits of detection
///
/// The table is CSV or Parquet: `--samples-out` of `evaluate` writes one. A polynomial is fitted by least squares to readings y over reference values
/// x. Rows of one contact point are not independent. With five or more points, a second band is computed from fits that leave out one point each.
/// The wider band is printed.
#[derive(Debug, Args)]
pub(crate) struct Curve {
    /// The table of readings
    #[arg(value_name = "TABLE")]
    pub(crate) table: PathBuf,
    /// The column of reference values, such as Fz; truth.Fz names the same column
    #[arg(long, value_name = "COLUMN")]
    pub(crate) x: String,
    /// The column of readings, such as `Fz_predicted`; prediction.Fz names the same column
    #[arg(long, value_name = "COLUMN")]
    pub(crate) y: String,
    /// The order of the polynomial, 1 to 3
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=3))]
    pub(crate) order: u8,
    /// The probability of bands and of intervals of inverted readings
    #[arg(long, value_name = "P", default_value_t = 0.95)]
    pub(crate) band: f64,
    /// Make the confidence band hold at all reference values together
    #[arg(long)]
    pub(crate) simultaneous: bool,
    /// The reference values at which bands are printed, separated by commas, in the unit of x [default: five from the least to the greatest]
    #[arg(
        long,
        value_name = "VALUES",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    pub(crate) at: Vec<f64>,
    /// The readings to invert, with their unit and separated by commas, such as 0.35N
    #[arg(long, value_name = "READINGS", value_delimiter = ',')]
    pub(crate) invert: Vec<String>,
    /// Also print the limits of detection as reference values: the critical and the detectable value
    #[arg(long)]
    pub(crate) detect: bool,
    /// Also give relative errors like those of ISO 7500-1, from a fifth of the greatest reference value on; no class is assigned
    #[arg(long)]
    pub(crate) iso7500: bool,
    /// Also print relative errors like those of ISO 376; the cells of this column name the series X1, X2, X3, X4', X5 or X6'. No class is assigned
    #[arg(long, value_name = "COLUMN")]
    pub(crate) iso376: Option<String>,
    /// The number of new readings whose mean is inverted, and for which bands and limits of detection hold
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) readings: u32,
    /// The column of contact points [default: `point_id` where the table has it]
    #[arg(long, value_name = "COLUMN", conflicts_with = "independent")]
    pub(crate) point: Option<String>,
    /// Treat each row as independent of the others
    #[arg(long)]
    pub(crate) independent: bool,
    #[command(flatten)]
    pub(crate) output: Output,
}

//! Requests to score two tables.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use taceva_core::Unit;

use super::period::Period;
use super::row_key::RowKey;

/// Request to score two tables.
#[derive(Clone, Debug)]
pub struct ScoreRequest {
    /// Path of the table of the truth.
    pub truth: PathBuf,
    /// Path of the table of the predictions.
    pub prediction: PathBuf,
    /// Units of channels other than the six standard channels; the default is 1.
    pub units: Vec<(String, Unit)>,
    /// Periods of angles. Values that differ by a period are equal. A channel named only here is in degrees, unless its name ends in `_rad` or its period is a
    /// multiple of π.
    pub periods: Vec<(String, Period)>,
    /// Key that pairs rows; `None` to detect the key by its name.
    pub key: Option<RowKey>,
    /// True if samples are independent. For intervals, each sample then counts as one contact point.
    pub is_independent: bool,
    /// Path of a file of sensor facts, if any: footprint, greatest depth, opacity.
    pub sensor: Option<PathBuf>,
    /// Names of metrics and of groups of metrics.
    pub metrics: Vec<String>,
    /// True to count and skip non-finite cells, false to reject them.
    pub allow_invalid: bool,
    /// Number of threads.
    pub jobs: NonZeroUsize,
}

impl ScoreRequest {
    /// Request for the tables `truth` and `prediction`, with all metrics and defaults.
    ///
    /// ```
    /// let request = taceva_evaluate::ScoreRequest::of_tables("truth.csv", "prediction.csv");
    /// assert_eq!(request.metrics, ["all"]);
    /// ```
    pub fn of_tables(truth: impl Into<PathBuf>, prediction: impl Into<PathBuf>) -> ScoreRequest {
        ScoreRequest {
            truth: truth.into(),
            prediction: prediction.into(),
            units: Vec::new(),
            periods: Vec::new(),
            key: None,
            is_independent: false,
            sensor: None,
            metrics: vec!["all".to_owned()],
            allow_invalid: false,
            jobs: NonZeroUsize::MIN,
        }
    }
}

//! Requests of scores.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use taceva_core::Unit;

use super::period::Period;
use super::row_key::RowKey;

/// Request of scores.
#[derive(Clone, Debug)]
pub struct ScoreRequest {
    /// The table of the truth.
    pub truth: PathBuf,
    /// The table of the predictions.
    pub prediction: PathBuf,
    /// Units of channels other than the six; the default is 1.
    pub units: Vec<(String, Unit)>,
    /// Periods of angles: values that differ by a period are equal. A channel named only here is in degrees, unless its name ends in `_rad` or its
    /// period is a multiple of π.
    pub periods: Vec<(String, Period)>,
    /// Key that pairs rows; `None` to find it by name.
    pub key: Option<RowKey>,
    /// True if samples are independent, so that each counts as one contact point in intervals.
    pub is_independent: bool,
    /// File of sensor facts: footprint, greatest depth, opacity.
    pub sensor: Option<PathBuf>,
    /// Names of metrics and of groups of metrics.
    pub metrics: Vec<String>,
    /// True if non-finite cells are counted instead of rejected.
    pub allow_invalid: bool,
    /// Number of threads.
    pub jobs: NonZeroUsize,
}

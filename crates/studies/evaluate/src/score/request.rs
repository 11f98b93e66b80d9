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
    /// Units of channels besides the six; others have the unit 1.
    pub units: Vec<(String, Unit)>,
    /// Periods of angles: values that differ by a period are equal. A channel named only here is in degrees, or in radians by its name (`_rad`)
    /// or by a multiple of π.
    pub periods: Vec<(String, Period)>,
    /// The key that pairs rows; `None` to find it by name.
    pub key: Option<RowKey>,
    /// True if samples are independent, so that each is a point of its own in intervals.
    pub is_independent: bool,
    /// File of sensor facts: footprint, greatest depth, opacity.
    pub sensor: Option<PathBuf>,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// True if cells that are not finite numbers are counted instead of rejected.
    pub allow_invalid: bool,
    /// Threads.
    pub jobs: NonZeroUsize,
}

//! What is to be scored.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use taceva_core::Unit;

use super::row_key::RowKey;

/// What to score.
#[derive(Clone, Debug)]
pub struct ScoreRequest {
    /// The table of what is true.
    pub truth: PathBuf,
    /// The table of what was predicted.
    pub prediction: PathBuf,
    /// Units of channels beside the six; those not named have the unit 1.
    pub units: Vec<(String, Unit)>,
    /// Periods of angles, degrees: values that differ by one say the same. A channel named here alone is in degrees.
    pub periods: Vec<(String, u16)>,
    /// The key by which rows are paired; found by its name if `None`.
    pub key: Option<RowKey>,
    /// True if samples do not depend on each other, so that each is a point of its own in intervals.
    pub is_independent: bool,
    /// What is known of the sensor: a file with footprint, greatest depth, opacity.
    pub sensor: Option<PathBuf>,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// Whether cells that are no finite number are counted instead of refused.
    pub allow_invalid: bool,
    /// Threads.
    pub jobs: NonZeroUsize,
}

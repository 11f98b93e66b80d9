//! Counts of the results of a sweep.

mod file;

use serde::{Deserialize, Serialize};

use crate::units::Unit;

/// Counts of the results of a sweep, with the digest of its table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Collected {
    /// Number of tasks with a result.
    pub scored: usize,
    /// Number of failed tasks.
    pub failed: usize,
    /// Number of tasks not run yet.
    pub missing: usize,
    /// Digest of the table of results. For shards of two tables, digest of the merged scores; empty while a shard is missing.
    pub digest: String,
    /// True if the tasks were shards of two tables, and their states were merged.
    #[serde(default)]
    pub is_of_tables: bool,
    /// Units checked against limits; empty if the sweep file names no limits.
    pub units: Vec<Unit>,
    /// Digest of all inputs of the results table.
    pub(crate) made_of: String,
}

impl Collected {
    /// True if every task has a result.
    pub fn is_whole(&self) -> bool {
        self.failed == 0 && self.missing == 0
    }
}

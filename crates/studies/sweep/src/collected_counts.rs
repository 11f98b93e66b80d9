//! Counts of the results of a sweep.

mod file;

use serde::{Deserialize, Serialize};

use crate::units::Unit;

/// Counts of the results of a sweep, with the digest of its table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Collected {
    /// Tasks with a result.
    pub scored: usize,
    /// Tasks that failed.
    pub failed: usize,
    /// Tasks that were not run yet.
    pub missing: usize,
    /// The digest of the table. For shards of two tables, the digest of their scores, or empty while a shard is missing.
    pub digest: String,
    /// True if tasks were shards of two tables, merged to their scores.
    #[serde(default)]
    pub is_of_tables: bool,
    /// Units checked against limits, if the file names limits.
    pub units: Vec<Unit>,
    /// Digest of the inputs of the table.
    pub(crate) made_of: String,
}

impl Collected {
    /// True if every task has a result.
    pub fn is_whole(&self) -> bool {
        self.failed == 0 && self.missing == 0
    }
}

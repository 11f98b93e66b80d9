//! Tally of the results of a sweep.

mod file;

use serde::{Deserialize, Serialize};

use crate::units::Unit;

/// Tally of the results of a sweep, with the digest of its table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Collected {
    /// Tasks with a result, tasks that failed, and tasks without either.
    pub scored: usize,
    /// Tasks that failed.
    pub failed: usize,
    /// Tasks that were not carried out yet.
    pub missing: usize,
    /// The digest of the table; of shards of two tables that of their scores, empty while one is missing.
    pub digest: String,
    /// Whether tasks were shards of two tables, joined to their scores.
    #[serde(default)]
    pub is_of_tables: bool,
    /// Units that were held to limits, where the file names limits.
    pub units: Vec<Unit>,
    /// What it was made of.
    pub(crate) made_of: String,
}

impl Collected {
    /// Whether every task has a result.
    pub fn is_whole(&self) -> bool {
        self.failed == 0 && self.missing == 0
    }
}

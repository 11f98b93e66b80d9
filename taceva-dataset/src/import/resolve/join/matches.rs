//! What joins matched, and which rows of joined tables belong to no row of any main table.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use crate::import::summary::JoinSummary;

/// What one main table found in a joined one.
pub(in crate::import) struct JoinMatches {
    pub(super) name: String,
    pub(super) matched: u64,
    pub(super) unmatched: u64,
    pub(super) greatest_gap_s: Option<f64>,
    /// Which rows belong to one, of each joined table.
    pub(super) tables: BTreeMap<PathBuf, TableUses>,
}

/// Which rows of a joined table belong to a row.
pub(super) struct TableUses {
    pub(super) candidates: usize,
    pub(super) skipped: usize,
    pub(super) used: BTreeSet<usize>,
}

impl JoinMatches {
    /// Adds what another main table found; a row of a joined table is unused only if it belongs to no row of any.
    pub(in crate::import) fn add(&mut self, other: JoinMatches) {
        self.matched += other.matched;
        self.unmatched += other.unmatched;
        let gaps = [self.greatest_gap_s, other.greatest_gap_s];
        self.greatest_gap_s = gaps.into_iter().flatten().reduce(f64::max);
        for (path, uses) in other.tables {
            match self.tables.get_mut(&path) {
                Some(known) => known.used.extend(uses.used),
                None => drop(self.tables.insert(path, uses)),
            }
        }
    }

    pub(in crate::import) fn name(&self) -> &str {
        &self.name
    }

    pub(in crate::import) fn summary(&self) -> JoinSummary {
        let sum = |count: fn(&TableUses) -> usize| -> u64 {
            self.tables.values().map(|uses| count(uses) as u64).sum()
        };
        JoinSummary {
            name: self.name.clone(),
            matched: self.matched,
            unmatched: self.unmatched,
            unused: sum(|uses| uses.candidates.saturating_sub(uses.used.len())),
            skipped: sum(|uses| uses.skipped),
            greatest_gap_s: self.greatest_gap_s,
        }
    }
}

//! What joins matched, and which rows of joined tables belong to no row of any main table.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::import::summary::JoinSummary;
use taceva_dataset::internal::shown_path;
use taceva_dataset::{DatasetError, Place};

/// What one main table found in a joined one.
pub(in crate::import) struct JoinMatches {
    pub(super) name: String,
    /// The frame that the map takes the rows of.
    pub(super) frame_id: Option<String>,
    /// The key of the map by which rows belong to those of the same number in each main table, if they do.
    pub(super) counted_by: Option<&'static str>,
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
    pub(super) in_other_frames: usize,
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

    /// Checks that no table whose rows are counted is joined to two main ones: each would begin with its first row again. `main` is the table
    /// that found `other`, one of `tables`; `are_files` where each of them is a file that is one row.
    pub(in crate::import) fn check_counted_once(
        &self,
        other: &JoinMatches,
        main: &Path,
        tables: usize,
        are_files: bool,
    ) -> Result<(), DatasetError> {
        let shared = other
            .tables
            .keys()
            .find(|path| self.tables.contains_key(*path));
        let (Some(key), Some(shared)) = (self.counted_by, shared) else {
            return Ok(());
        };
        let (each, remedy) = match are_files {
            true => (
                format!(
                    "{tables} files, of which each is a table of one row, and their order is no promise"
                ),
                "join by a number in the name, `on = { \"path.NAME\" = \"COLUMN\" }` with a part of [path] and a column of that table",
            ),
            false => (
                format!("{tables} tables"),
                "join by a column of both, `on = { COLUMN = \"COLUMN\" }`, or by time, or name a table for each with `{path.NAME}`",
            ),
        };
        Err(DatasetError::Table {
            place: Place::file(main),
            problem: format!(
                "join `{}`: with {key} the first row of {} would belong to the first row of each of the {each}: {remedy}",
                self.name,
                shown_path(shared)
            ),
        })
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
            frame_id: self.frame_id.clone(),
            in_other_frames: sum(|uses| uses.in_other_frames),
            greatest_gap_s: self.greatest_gap_s,
        }
    }
}

//! Counts the matches of joins, and the rows of joined tables that no main table uses.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::timing::Timing;
use crate::error::{ImportError, table_error};
use crate::import::summary::JoinSummary;
use crate::import::warning::ImportWarning;
use taceva_dataset::internal::shown_path;

/// Matches of one main table with a joined table.
pub(in crate::import) struct JoinMatches {
    pub(super) name: String,
    /// Coordinate frame to which the map restricts the rows.
    pub(super) frame_id: Option<String>,
    /// Map key that counts rows, for a join by row number; `None` for other joins.
    pub(super) counted_by: Option<&'static str>,
    pub(super) matched: u64,
    pub(super) unmatched: u64,
    /// Times of the rows in a join by time.
    pub(super) timing: Timing,
    /// Use of each joined table.
    pub(super) tables: BTreeMap<PathBuf, TableUses>,
}

/// Used and excluded rows of a joined table.
pub(super) struct TableUses {
    pub(super) candidates: usize,
    pub(super) skipped: usize,
    pub(super) in_other_frames: usize,
    pub(super) used: BTreeSet<usize>,
}

impl JoinMatches {
    /// Adds the matches of another main table. A row is unused only if no main table uses it.
    pub(in crate::import) fn add(&mut self, other: JoinMatches) {
        self.matched += other.matched;
        self.unmatched += other.unmatched;
        self.timing.add_table(other.timing);
        for (path, uses) in other.tables {
            match self.tables.get_mut(&path) {
                Some(known) => known.used.extend(uses.used),
                None => drop(self.tables.insert(path, uses)),
            }
        }
    }

    /// Checks that no two main tables use the same table, joined by row number. Both would begin with its first row. `main`, one of `tables` main
    /// tables, has the matches `other`. `are_files` is true if each main table is a file that forms one row.
    pub(in crate::import) fn check_counted_once(
        &self,
        other: &JoinMatches,
        main: &Path,
        tables: usize,
        are_files: bool,
    ) -> Result<(), ImportError> {
        let shared = other
            .tables
            .keys()
            .find(|path| self.tables.contains_key(*path));
        let (Some(key), Some(shared)) = (self.counted_by, shared) else {
            return Ok(());
        };
        let (each, remedy) = match are_files {
            true => (
                format!("{tables} files with one row each, in no reliable order"),
                "join by a number in the name, `on = { \"path.NAME\" = \"COLUMN\" }` with a part of [path] and a column of that table",
            ),
            false => (
                format!("{tables} tables"),
                "join by a column of both tables, `on = { COLUMN = \"COLUMN\" }`, or by time, or name a table for each with `{path.NAME}`",
            ),
        };
        Err(table_error!(
            main,
            "join `{}`: with {key} the first row of {} would belong to the first row of each of the {each}: {remedy}",
            self.name,
            shown_path(shared)
        ))
    }

    pub(in crate::import) fn name(&self) -> &str {
        &self.name
    }

    /// Warnings about a join by time, such as a wrong lag, matches across a pause, or few matches.
    pub(in crate::import) fn warnings(&self) -> Vec<ImportWarning> {
        let tables = self.tables.values();
        let used: usize = tables.clone().map(|uses| uses.used.len()).sum();
        let candidates: usize = tables.map(|uses| uses.candidates).sum();
        self.timing
            .warnings(&self.name, self.matched, 2 * used < candidates)
    }

    /// Time spans of both tables in words, if no row of a join by time has a match; otherwise `None`.
    pub(in crate::import) fn apart(&self) -> Option<String> {
        let spans = self.timing.spans(&self.name);
        spans.filter(|_| self.matched == 0)
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
            greatest_gap_s: self.timing.greatest_gap_s,
        }
    }
}

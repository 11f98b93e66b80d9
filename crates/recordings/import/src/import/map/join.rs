//! Joined tables, whose rows belong to rows of the main table.

use std::collections::BTreeMap;

use super::TimeMap;
use crate::foreign::TableForm;

/// Joined table. A map names its columns `NAME.column`, with the name of the join.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JoinMap {
    pub(crate) name: String,
    /// File relative to the source folder. A placeholder such as `{path.run}` stands for the part called `run` in the path of the main table. The
    /// main table is the table whose rows become samples.
    pub(crate) file: String,
    pub(crate) form: TableForm,
    pub(crate) by: JoinBy,
    pub(crate) unmatched: Unmatched,
    /// Pairs of a column and a number. A row with this number in the column is excluded from matching.
    pub(crate) skip: Vec<(String, f64)>,
    /// Coordinate frame to which candidate rows are restricted.
    pub(crate) frame_id: Option<String>,
}

/// Rule that matches a row of the joined table to a main row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum JoinBy {
    /// The single row with equal cells: pairs of a column of the main table and a column of the joined table.
    Columns(Vec<(String, String)>),
    /// Row with the same row number.
    Row,
    /// The only row of the table.
    All,
    /// Row at the same time.
    Time(TimeJoin),
    /// First row whose number in this column exceeds the row number of the main row, such as the end index of an episode.
    Until(String),
}

/// Matching of rows by time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TimeJoin {
    /// Time of the joined table.
    pub(crate) time: TimeMap,
    pub(crate) pick: Pick,
    /// Maximum time difference between matched rows, ms.
    pub(crate) tolerance_ms: f64,
    pub(crate) lag: Lag,
}

/// Offset of the clock of the joined table from the clock of the main table, ms.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Lag {
    /// Constant offset, ms.
    Fixed(f64),
    /// Offset for each file, ms, by the path of the main or the joined table.
    Files(BTreeMap<String, f64>),
    /// Column of the main table that contains the offset, ms.
    Column(String),
}

impl TimeJoin {
    /// Maximum time difference between matched rows, s.
    pub(crate) fn tolerance_s(&self) -> f64 {
        self.tolerance_ms / 1e3
    }
}

/// Rule that selects rows near a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Pick {
    /// Nearest row; of two equally near rows, the earlier.
    Nearest,
    /// Last row at or before the time.
    Before,
    /// Linear interpolation between the row before and the row after, each within the tolerance.
    Linear,
}

impl Pick {
    /// Name of the rule in a map.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Pick::Nearest => "nearest",
            Pick::Before => "before",
            Pick::Linear => "linear",
        }
    }
}

/// Handling of a main row without a match.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Unmatched {
    /// Leaves the main row out and counts it.
    Drop,
    /// Rejects the import.
    Refuse,
}

impl Unmatched {
    /// Name of the handling in a map.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Unmatched::Drop => "drop",
            Unmatched::Refuse => "refuse",
        }
    }
}

//! Other tables whose rows belong to those of the main one.

use std::collections::BTreeMap;

use super::TimeMap;
use crate::foreign::TableForm;

/// A table that is joined: its columns are called `NAME.column`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JoinMap {
    pub(crate) name: String,
    /// Its file relative to the source folder, in which `{path.PART}` stands for a part of the path of the main table.
    pub(crate) file: String,
    pub(crate) form: TableForm,
    pub(crate) by: JoinBy,
    pub(crate) unmatched: Unmatched,
    /// Rows that are no candidates: column, and the number that it has there.
    pub(crate) skip: Vec<(String, f64)>,
    /// The coordinate frame whose rows are candidates alone.
    pub(crate) frame_id: Option<String>,
}

/// Which row of a joined table belongs to a row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum JoinBy {
    /// The one row whose columns hold the same: column of the main table, column of the joined one.
    Columns(Vec<(String, String)>),
    /// That of the same number.
    Row,
    /// Its only row.
    All,
    /// That of the same time.
    Time(TimeJoin),
    /// The first whose number in this column is above that of the row: where episodes end, counted through.
    Until(String),
}

/// How times are compared.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TimeJoin {
    /// The time of the joined table.
    pub(crate) time: TimeMap,
    pub(crate) pick: Pick,
    /// The greatest distance in time, ms.
    pub(crate) tolerance_ms: f64,
    pub(crate) lag: Lag,
}

/// Delay of the clock of the joined table at one instant, ms.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Lag {
    /// The same in every row.
    Fixed(f64),
    /// By the path of the main table, or of the joined one.
    Files(BTreeMap<String, f64>),
    /// The number in this column of the main table.
    Column(String),
}

impl TimeJoin {
    /// The greatest distance in time, s.
    pub(crate) fn tolerance_s(&self) -> f64 {
        self.tolerance_ms / 1e3
    }
}

/// Which of the rows about a time it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Pick {
    /// The nearest; of two that are as near the earlier.
    Nearest,
    /// The last that is not later.
    Before,
    /// Between both neighbours, in proportion; both lie within the tolerance.
    Linear,
}

impl Pick {
    /// The word for it in a map.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Pick::Nearest => "nearest",
            Pick::Before => "before",
            Pick::Linear => "linear",
        }
    }
}

/// What becomes of a row to which none belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Unmatched {
    /// It is left out, and counted.
    Drop,
    /// The import is refused.
    Refuse,
}

impl Unmatched {
    /// The word for it in a map.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Unmatched::Drop => "drop",
            Unmatched::Refuse => "refuse",
        }
    }
}

//! Mapping of a joined table to the rows of the main table.

use serde::{Deserialize, Serialize};

use super::map_conflict::{Fact, number, or_none, quoted};

/// Mapping of a joined table by an import. A different lag or pick would select readings of other instants.
///
/// ```
/// let text = "name = \"ft\"\nby = \"time\"\ncolumn = \"t\"\nunit = \"s\"\npick = \"nearest\"\ntolerance_ms = 5.0\nlag_ms = 12.5\nunmatched = \"drop\"\n";
/// let join: taceva_dataset::MappedJoin = toml::from_str(text)?;
/// assert_eq!((join.name.as_str(), join.lag_ms), ("ft", Some(12.5)));
/// # Ok::<(), toml::de::Error>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MappedJoin {
    /// Prefix of the column names.
    pub name: String,
    /// Kind of the join: `columns`, `row`, `all`, `time` or `until`.
    pub by: String,
    /// Pairs for a join by columns: `column of the main table = column of this table`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub on: Vec<String>,
    /// Time column. For `until`, a row of this table applies to rows of the main table before the number in this column.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column: Option<String>,
    /// Unit of the time column; `None` unless the join is by time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Rule that picks a row by time: `nearest`, `before` or `linear`; `None` for other joins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pick: Option<String>,
    /// Maximum time difference of matching rows, ms; `None` unless the join is by time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance_ms: Option<f64>,
    /// Lead of this table's clock over the clock of the main table, ms. `None` if the lead differs by row, or for other joins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lag_ms: Option<f64>,
    /// Source of a lead that differs by row: the column that contains the lead, or `file = ms` for each file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lag_by: Vec<String>,
    /// Treatment of rows of the main table without a match: `drop` or `refuse`.
    pub unmatched: String,
    /// Conditions that exclude rows of this table: `column = number`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skip: Vec<String>,
}

impl MappedJoin {
    /// Join of the table `name`, of the kind `by`. A row of the main table without a match stops the import.
    pub fn new(name: &str, by: &str) -> MappedJoin {
        MappedJoin {
            name: name.to_owned(),
            by: by.to_owned(),
            on: Vec::new(),
            column: None,
            unit: None,
            pick: None,
            tolerance_ms: None,
            lag_ms: None,
            lag_by: Vec::new(),
            unmatched: "refuse".to_owned(),
            skip: Vec::new(),
        }
    }

    /// Settings that determine the matching of rows, by the keys of an import map.
    pub(super) fn facts(&self) -> Vec<Fact> {
        let name = &self.name;
        let key = |word: &str| format!("join.{name}.{word}");
        let column = match self.by.as_str() {
            "time" => "time.column",
            _ => "until",
        };
        vec![
            (format!("join.{name}"), format!("by {}", self.by)),
            (key("on"), quoted(&self.on)),
            (key(column), or_none(self.column.as_deref())),
            (key("time.unit"), or_none(self.unit.as_deref())),
            (key("pick"), or_none(self.pick.as_deref())),
            (key("tolerance_ms"), number(self.tolerance_ms)),
            (key("lag_ms"), number(self.lag_ms)),
            (key("lag_ms"), quoted(&self.lag_by)),
            (key("unmatched"), self.unmatched.clone()),
            (key("skip"), quoted(&self.skip)),
        ]
    }
}

//! Rules for table rows that an import leaves out.

/// Rules for rows that are left out; each rule counts its rows.
///
/// ```
/// use taceva_import::{DropRules, Placeholder};
///
/// let mut rules = DropRules::default();
/// rules.placeholders = vec![Placeholder::new("Fx", 0.0), Placeholder::new("Fz", 0.0)];
/// assert!(rules.quality_flags.is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct DropRules {
    /// Column of flags, separated by `;` or blanks.
    pub flag_column: String,
    /// Flags that exclude a row.
    pub quality_flags: Vec<String>,
    /// Names of frames that exclude a row.
    pub frames_named: Vec<String>,
    /// Placeholders that exclude a row if it contains all of them.
    pub placeholders: Vec<Placeholder>,
    /// Rows that are excluded by their number.
    pub rows: Vec<DroppedRow>,
}

/// Row of a main table that is left out by its number.
///
/// ```
/// use taceva_import::DroppedRow;
///
/// let mut row = DroppedRow::new(204);
/// row.reason = Some("the transducer was overloaded".to_owned());
/// assert_eq!((row.row, row.table), (204, None));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct DroppedRow {
    /// Number of the row, from 1: the first row below the header.
    pub row: u64,
    /// Table relative to the source folder; `None` if the map has only one table.
    pub table: Option<String>,
    /// Reason for the exclusion, stored in the summary and in the dataset; `None` if not stated.
    pub reason: Option<String>,
}

impl DroppedRow {
    /// Row `row`, from 1, of the only table.
    pub fn new(row: u64) -> DroppedRow {
        DroppedRow {
            row,
            table: None,
            reason: None,
        }
    }

    /// True if this entry excludes the row at `position`, from 0, of `table`.
    pub(crate) fn is_at(&self, position: usize, table: &str) -> bool {
        self.row == position as u64 + 1 && self.table.as_deref().is_none_or(|own| own == table)
    }

    /// Name of the rule under which the excluded row is counted.
    pub(crate) fn rule(&self) -> String {
        match &self.reason {
            None => "rows by number".to_owned(),
            Some(reason) => format!("rows by number ({reason})"),
        }
    }
}

/// Number that means "not measured".
///
/// ```
/// use taceva_import::Placeholder;
///
/// assert_eq!(Placeholder::new("Fz", -1.0).channel, "Fz");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Placeholder {
    /// Channel whose column contains the placeholder, such as `Fz`.
    pub channel: String,
    /// Number in the table, before conversion.
    pub number: f64,
}

impl Placeholder {
    /// Placeholder `number` in the column of `channel`.
    pub fn new(channel: impl Into<String>, number: f64) -> Placeholder {
        Placeholder {
            channel: channel.into(),
            number,
        }
    }
}

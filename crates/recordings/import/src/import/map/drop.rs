//! Rules for rows of a table that an import leaves out.

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
    /// Frame names that exclude a row.
    pub frames_named: Vec<String>,
    /// Placeholders that exclude a row if all of them match.
    pub placeholders: Vec<Placeholder>,
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
    /// Channel whose column holds it, such as `Fz`.
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

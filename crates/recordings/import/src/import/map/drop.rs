//! Which rows of a table an import leaves out.

/// Which rows are left out; each is counted.
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
    /// The column of flags, separated by `;` or blanks.
    pub flag_column: String,
    /// A row with one of these is left out.
    pub quality_flags: Vec<String>,
    /// A row whose frame is called one of these is left out.
    pub frames_named: Vec<String>,
    /// A row in which all these columns hold these numbers is left out.
    pub placeholders: Vec<Placeholder>,
}

/// A number that stands for "not measured".
///
/// ```
/// use taceva_import::Placeholder;
///
/// assert_eq!(Placeholder::new("Fz", -1.0).channel, "Fz");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Placeholder {
    /// The channel whose column holds it, such as `Fz`.
    pub channel: String,
    /// The number in the table, before it is converted.
    pub number: f64,
}

impl Placeholder {
    /// The number `number` in the column of `channel`.
    pub fn new(channel: impl Into<String>, number: f64) -> Placeholder {
        Placeholder {
            channel: channel.into(),
            number,
        }
    }
}

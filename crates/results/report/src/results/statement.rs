//! Source, conditions and definition of published numbers.

/// Text for a published number whose source states no definition.
pub(crate) const UNSTATED: &str = "definition not stated by the source";

/// Source, conditions and definition of a published number.
///
/// ```
/// let digit = taceva_report::catalogue::find("DIGIT").expect("there").as_study();
/// let rate = digit.statements.iter().find(|of| of.name == "intrinsic frame_rate").expect("known");
/// assert_eq!(rate.definition, "pictures a second");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Statement {
    /// Name of the quantity without its unit: `mae Fz`, `size`.
    pub name: String,
    /// Text of the source.
    pub source: String,
    /// Measurement conditions.
    pub conditions: String,
    /// Definition of the metric by the source.
    pub definition: String,
}

impl Statement {
    /// Creates the statement on the number called `name`.
    pub fn new(name: &str, source: &str, conditions: &str, definition: &str) -> Statement {
        Statement {
            name: name.to_owned(),
            source: source.to_owned(),
            conditions: conditions.to_owned(),
            definition: definition.to_owned(),
        }
    }
}
